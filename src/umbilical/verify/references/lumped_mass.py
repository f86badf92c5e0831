"""MoorDyn: an independent code for marine cables, lumped masses and springs, on the same hanging cable.

It runs in a process of its own, for it prints a line per step and can end the process it is in. Without drag and added
mass; where the string weighs less than in air, in water that its volumes displace. Nearly inextensible (EA = 1e8 N),
the unstretched length shortened so that it hangs at the wanted one.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np

from umbilical.verify.references import CaseError
from umbilical.verify.references.hanging_string import HangingString

STIFFNESS = 1e8
WATER = 1025.0
"""Density of water, kg/m3."""
SETTLING = 60.0
"""Seconds it hangs still before the vessel moves."""
STEP = 0.01
"""Seconds between two positions of the vessel; its own steps are shorter."""
LIMIT = 300.0
"""Seconds after which it is taken to be stuck."""

_INPUT = Path(__file__).with_name("moordyn.txt")
"""MoorDyn's input file, with fields for numbers."""

_SCRIPT = """
import json, sys, time, moordyn
task = json.load(open(sys.argv[1]))
system, still = moordyn.Create(task["input"]), [0.0] * 3
moordyn.SetVerbosity(system, moordyn.LEVEL_ERR)
if moordyn.Init(system, task["place"][0], still) != 0:
    raise SystemExit("MoorDyn did not start")
body, line, t, step, found = moordyn.GetPoint(system, 2), moordyn.GetLine(system, 1), 0.0, task["step"], []
for _ in range(task["settling"]):
    moordyn.Step(system, task["place"][0], still, t, step)
    t += step
begun = time.perf_counter()
for place, speed in zip(task["place"], task["velocity"]):
    found.append((*moordyn.GetPointPos(body), moordyn.GetLineFairTen(line)))
    moordyn.Step(system, place, speed, t, step)
    t += step
seconds = time.perf_counter() - begun
moordyn.Close(system)
json.dump({"seconds": seconds, "found": found}, open(task["output"], "w"))
"""


class MovedCable(NamedTuple):
    """What MoorDyn gave at each instant at which the vessel's motion was: place of the body, m, shape (instants, 3);
    tension in the last segment below the vessel, N; and the seconds it took, the settling left out."""

    place: np.ndarray
    tension: np.ndarray
    seconds: float


def tip(string: HangingString, segments: int, vessel: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """y(l,t), m, every :data:`STEP` while the vessel moves.

    Args:
        string: what hangs.
        segments: into which the cable is cut.
        vessel: e at those instants, m.
        velocity: e' at those instants, m/s.

    Raises:
        CaseError: MoorDyn failed, or what it gave is not finite.
    """
    still = np.zeros_like(vessel)
    place, speed = (np.stack([part, still, still], axis=1) for part in (vessel, velocity))
    return move(_input(string, segments), place, speed, STEP).place[:, 0]


def move(text: str, place: np.ndarray, velocity: np.ndarray, step: float) -> MovedCable:
    """Move the vessel, point 1 of the input ``text``, after it hung still; point 2 is the body, line 1 the cable.

    Args:
        text: MoorDyn's input file.
        place, velocity: of the vessel, m and m/s, shape (instants, 3); between two instants MoorDyn goes on with the
            velocity of the first.
        step: seconds between two instants.

    Raises:
        CaseError: MoorDyn failed, or what it gave is not finite.
    """
    with tempfile.TemporaryDirectory(prefix="umbilical-moordyn-") as name:
        folder = Path(name)
        (folder / "cable.txt").write_text(text)
        task = {
            "input": str(folder / "cable.txt"), "output": str(folder / "moved.json"), "step": step,
            "settling": round(SETTLING / step), "place": place.tolist(), "velocity": velocity.tolist(),
        }  # fmt: skip
        (folder / "task.json").write_text(json.dumps(task))
        _run([sys.executable, "-c", _SCRIPT, str(folder / "task.json")], folder)
        given = json.loads((folder / "moved.json").read_text())
    found = np.array(given["found"])
    if not np.isfinite(found).all():
        raise CaseError("MoorDyn's answer is not finite")
    return MovedCable(found[:, :3], found[:, 3], given["seconds"])


def _input(string: HangingString, segments: int) -> str:
    """MoorDyn's input file; the cable is stretched by ``int T ds/EA`` under the weight below it."""
    rho, m, length, g = string[:4]
    stretch = (string.weight + string.line_weight * length / 2.0) * length / STIFFNESS
    unstretched = length - stretch
    displaced = (rho - string.line_weight / g) * length / unstretched
    water = WATER if displaced else 0.0
    return _INPUT.read_text(encoding="utf-8").format(
        density=rho * length / unstretched, stiffness=STIFFNESS, depth=-length, mass=m, unstretched=unstretched,
        segments=segments, gravity=g, bottom=4.0 * length, water=water,
        volume=(m - string.weight / g) / WATER, diameter=np.sqrt(4.0 / np.pi * displaced / WATER) or 0.01,
    )  # fmt: skip


def _run(command: list[str], folder: Path) -> None:
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=LIMIT, check=False)
    except subprocess.TimeoutExpired:
        raise CaseError(f"MoorDyn took more than {LIMIT:g} s") from None
    if done.returncode or not (folder / "moved.json").exists():
        raise CaseError(f"MoorDyn failed: {done.stderr.decode(errors='replace').strip()[-200:]}")
