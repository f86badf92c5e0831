"""The rows of ``python3 do.py bench``, all measured in one go."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, Any

from benchmarks.by_hand import c_rows
from benchmarks.machine import machine, peak_of_children
from benchmarks.rope import rope_rows
from benchmarks.rows import Row
from benchmarks.study import memory_row, study_rows
from benchmarks.water import water_rows

if TYPE_CHECKING:
    from umbilical.scenario import Scenario

Progress = Callable[[float], None]
PYTHON_LOOP = 5.0
"""Seconds simulated in the Python loop; its time per simulated second does not change over a run."""
REFERENCE = 2.0
"""Seconds simulated by the plain script."""
VARIANTS: dict[str, dict[str, Any]] = {
    "full": {},
    "unstored": {"output.interval": 50.0},
    "ideal": {"ideal_thruster": True},
    "idle": {"control.law.kind": "none"},
    "bare": {"control.law.kind": "none", "ideal_thruster": True},
}
"""The paper's scenario with parts switched off: what a part costs is what its absence saves."""


@dataclass(frozen=True)
class Bench:
    """All rows, and the machine they belong to."""

    machine: Mapping[str, str | int]
    rows: tuple[Row, ...]

    @property
    def headline(self) -> str:
        """The machine in one line."""
        return ", ".join(f"{name} {value}" for name, value in self.machine.items())

    def document(self) -> dict[str, Any]:
        """As plain data."""
        return {"machine": dict(self.machine), "rows": [asdict(row) for row in self.rows]}


def measure_all(
    repeat: int = 15,
    *,
    members: int = 40,
    cold: bool = False,
    progress: Callable[[float], None] = lambda share: None,
) -> Bench:
    """Measure every row.

    Args:
        repeat: runs of each variant of the compiled loop; medians count.
        members: members of a study that are run; 0 leaves studies out.
        cold: also compile all kernels anew, in another process with an empty cache.
        progress: called with the share done, 0 to 1.

    Returns:
        The rows; nothing is stored.
    """
    # Processes come first: what they need of memory is read from this process's children, while it is still small.
    rows = _processes(cold) + ([memory_row(members)] if members else [])
    progress(0.2)
    rows = [
        *_compiled(repeat, progress),
        *c_rows(repeat),
        *_others(members),
        *water_rows(repeat),
        *rope_rows(repeat),
        *rows,
    ]
    progress(1.0)
    return Bench(machine(), tuple(rows))


def _compiled(repeat: int, progress: Progress) -> list[Row]:
    """The compiled loop as a whole, by its median, and in parts, by the fastest runs: differences need quiet."""
    from umbilical.library import load

    scenario = load("paper")
    taken = _take({name: scenario.replace(change) for name, change in VARIANTS.items()}, repeat, progress)
    whole = {key: median(times[key] for times in taken["full"]) for key in taken["full"][0]}
    parts = _parts({name: {key: min(t[key] for t in times) for key in times[0]} for name, times in taken.items()})
    total, fastest = whole["simulate_s"], sum(parts.values())
    note = f"median of {repeat}, {scenario.grid.elements} elements, period {1e3 * scenario.control.period:g} ms"
    return [
        Row("compiled loop, 50 s", 1e3 * total, "ms", 50.0 / total, note),
        *(_part_row(name, part, fastest) for name, part in parts.items()),
        Row("before it: admission, set-up", 1e3 * whole["prepare_s"], "ms"),
        Row("after it: arrays, energy audit", 1e3 * whole["assemble_s"], "ms"),
    ]


def _part_row(name: str, part: float, whole: float) -> Row:
    """A part of the loop; parts come from differences between runs, which say nothing of very small ones."""
    told = part > 0.03 * whole
    return Row(
        f"  {name}", 1e3 * max(part, 0.0), "ms", note=f"{part / whole:.0%}" if told else "less than runs differ by"
    )


def _take(variants: Mapping[str, Scenario], repeat: int, progress: Progress) -> dict[str, list[dict[str, float]]]:
    """Times of every variant; the variants take turns, so that none has the quiet minute."""
    taken: dict[str, list[dict[str, float]]] = {name: [] for name in variants}
    for round_ in range(repeat + 1):
        for name, scenario in variants.items():
            taken[name].append(_timed(scenario))
        progress(0.2 + 0.5 * round_ / repeat)
    return {name: times[1:] for name, times in taken.items()}  # the first round loads and warms up


def _timed(scenario: Scenario) -> dict[str, float]:
    from umbilical.engine.simulate import simulate

    begun = perf_counter()
    timing = dict(simulate(scenario).timing)
    whole = perf_counter() - begun
    timing["assemble_s"] = whole - timing["prepare_s"] - timing["simulate_s"]
    timing["loop_s"] = timing["simulate_s"] - timing["outside_s"]
    return timing


def _parts(times: Mapping[str, Mapping[str, float]]) -> dict[str, float]:
    """Seconds of each part of the loop; they add up to the whole."""
    loop = {name: taken["loop_s"] for name, taken in times.items()}
    storing = loop["full"] - loop["unstored"]
    outer = loop["ideal"] - loop["bare"]
    return {
        "outside world, sampled": times["full"]["outside_s"],
        "plant: cable, ROV, sensors, measures": loop["bare"] - storing,
        "plant: motors": loop["idle"] - loop["bare"],
        "outer law and observers": outer,
        "motor loops and allocation": loop["full"] - loop["idle"] - outer,
        "storing samples": storing,
    }


def _others(members: int) -> list[Row]:
    """The same run by other means, and a study of many."""
    import numpy as np

    from umbilical.control.cascade import Cascade
    from umbilical.engine.simulate import simulate
    from umbilical.library import load
    from umbilical.verify.references.paper import displacement

    short = load("paper").replace({"duration": PYTHON_LOOP})
    simulate(short.replace({"duration": 0.1}), Cascade(short))
    python = simulate(short, Cascade(short)).timing["simulate_s"] * 50.0 / PYTHON_LOOP
    begun = perf_counter()
    displacement(np.array([0.0, REFERENCE]))
    plain = (perf_counter() - begun) * 50.0 / REFERENCE
    called = f"the controller is called from Python; {PYTHON_LOOP:g} s, scaled"
    script = f"100 nodes of second order, RK45, continuous law; {REFERENCE:g} s, scaled"
    return [
        Row("Python loop, 50 s", python, "s", 50.0 / python, called),
        Row("numpy + scipy solve_ivp, 50 s", plain, "s", 50.0 / plain, script),
        *(study_rows(members, plain) if members else []),
    ]


def _processes(cold: bool) -> list[Row]:
    """Whole processes, as a shell starts them."""
    run = ("run", "paper", "--json")
    _process(run)  # compiles if need be, and brings the files into the disk cache
    rows = [
        Row("umbilical run paper --json", _process(run), "s", note="whole process, kernels from disk"),
        Row("  its peak memory", peak_of_children(), "MB"),
        Row("umbilical --help", _process(("--help",)), "s", note="whole process"),
    ]
    if cold:
        with tempfile.TemporaryDirectory(prefix="umbilical-bench-") as folder:
            seconds = _process(run, UMBILICAL_CACHE=folder)
        rows.append(Row("umbilical run paper --json, first ever", seconds, "s", note="kernels compiled, empty cache"))
    return rows


def _process(arguments: tuple[str, ...], **environment: str) -> float:
    """Seconds one command takes."""
    command = [sys.executable, "-m", "umbilical", *arguments]
    begun = perf_counter()
    subprocess.run(command, env={**os.environ, **environment}, stdout=subprocess.DEVNULL, check=True)
    return perf_counter() - begun
