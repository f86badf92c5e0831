"""The paper's 50 s in C written by hand (``cascade.c``), in turns with the compiled loop."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path
from statistics import median

import numpy as np

from benchmarks.rows import Row

SOURCE = Path(__file__).parent / "cascade.c"
FLAGS = ("-O3", "-march=native", "-std=c11", "-D_POSIX_C_SOURCE=199309L")
NODES, STEPS = 100, 50_000
GRIDS = (64, 16, 4)
"""Elements of the compiled loop: the preset's, and fewer."""
TOLERANCE = 1e-4
"""Of the peaks at ROV and midpoint, against four times the grid: a grid that is chosen for it comes first."""


def compiler() -> str | None:
    """The C compiler of this machine."""
    return next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)


def build(folder: Path) -> Path:
    """Compile the program into a folder."""
    program = folder / "cascade"
    subprocess.run([compiler() or "cc", *FLAGS, str(SOURCE), "-o", str(program), "-lm"], check=True)
    return program


def run(program: Path, nodes: int = NODES, steps: int = STEPS) -> tuple[float, np.ndarray]:
    """Milliseconds the 50 s take, and y(l,t), m, once a second."""
    words = [str(program), str(nodes), str(steps)]
    found = subprocess.run(words, capture_output=True, text=True, check=True).stdout.split()
    return float(found[0]), np.array(found[1:], dtype=float)


def c_rows(repeat: int) -> list[Row]:
    """Times in turns; none where there is no compiler.

    Args:
        repeat: rounds; a ratio is the median of those of the rounds.
    """
    if compiler() is None:
        return []
    from umbilical.engine.resolution import on_chosen_grid
    from umbilical.engine.simulate import measure, simulate
    from umbilical.library import load

    chosen, told = on_chosen_grid(load("paper", {"grid.tolerance": TOLERANCE}), measure)
    scenarios = {chosen.grid.elements: chosen} | {n: load("paper", {"grid.elements": n}) for n in GRIDS}
    with tempfile.TemporaryDirectory(prefix="umbilical-bench-") as folder:
        program = build(Path(folder))
        rounds = [
            (run(program)[0], *(1e3 * simulate(each).timing["simulate_s"] for each in scenarios.values()))
            for _ in range(repeat + 1)
        ][1:]  # the first one loads and warms up
    by_hand = median(times[0] for times in rounds)
    how = (
        f"cc {' '.join(FLAGS[:2])}; {NODES} nodes of second order, RK4 each ms; in turns with ours, median of {repeat}"
    )
    return [
        Row("hand-written C, 50 s", by_hand, "ms", 5e4 / by_hand, how),
        *(
            Row(
                f"  compiled loop over C, {elements} elements",
                median(times[k] / times[0] for times in rounds),
                "x",
                note="; ".join(told) if scenario is chosen else "",
            )
            for k, (elements, scenario) in enumerate(scenarios.items(), start=1)
        ),
    ]
