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

import numpy as np

from umbilical.verify.cases import CaseError
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

_INPUT = """Written by Umbilical
---------------------- LINE TYPES ----------------------
TypeName  Diam  Mass/m  EA   BA/-zeta  EI  Cd  Ca  CdAx  CaAx
(name)    (m)   (kg/m)  (N)  (N-s/-)   (-) (-) (-) (-)   (-)
cable     {diameter:.17g}  {density:.17g} {stiffness:.17g} -0.1 0 0 0 0 0
---------------------- POINTS ----------------------
ID   Type     X  Y  Z        Mass     Volume  CdA  CA
(#)  (-)      (m) (m) (m)    (kg)     (m3)    (m2) (-)
1    Coupled  0  0  0        0        0       0    0
2    Free     0  0  {depth:.17g} {mass:.17g} {volume:.17g} 0 0
---------------------- LINES ----------------------
ID   LineType  AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)  (name)    (#)      (#)      (m)       (-)      (-)
1    cable     2        1        {unstretched:.17g} {segments} -
---------------------- SOLVER OPTIONS ----------------------
0     writeLog
RK4   tScheme
0.1   cfl
{gravity:.17g} g
{water:.17g} WtrDnsty
{bottom:.17g} WtrDpth
0     TmaxIC
---------------------- need this line ----------------------
"""

_SCRIPT = """
import json, sys, moordyn
task = json.load(open(sys.argv[1]))
system = moordyn.Create(task["input"])
if moordyn.Init(system, [0.0] * 3, [0.0] * 3) != 0:
    raise SystemExit("MoorDyn did not start")
rov, t, step, tip = moordyn.GetPoint(system, 2), 0.0, task["step"], []
for _ in range(task["settling"]):
    moordyn.Step(system, [0.0] * 3, [0.0] * 3, t, step)
    t += step
for place, speed in zip(task["vessel"], task["velocity"]):
    tip.append(moordyn.GetPointPos(rov)[0])
    moordyn.Step(system, [place, 0.0, 0.0], [speed, 0.0, 0.0], t, step)
    t += step
moordyn.Close(system)
json.dump(tip, open(task["output"], "w"))
"""


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
    with tempfile.TemporaryDirectory(prefix="umbilical-moordyn-") as name:
        folder = Path(name)
        (folder / "cable.txt").write_text(_input(string, segments))
        task = {
            "input": str(folder / "cable.txt"), "output": str(folder / "tip.json"), "step": STEP,
            "settling": round(SETTLING / STEP), "vessel": vessel.tolist(), "velocity": velocity.tolist(),
        }  # fmt: skip
        (folder / "task.json").write_text(json.dumps(task))
        _run([sys.executable, "-c", _SCRIPT, str(folder / "task.json")], folder)
        found = np.array(json.loads((folder / "tip.json").read_text()))
    if not np.isfinite(found).all():
        raise CaseError("MoorDyn's answer is not finite")
    return found


def _input(string: HangingString, segments: int) -> str:
    """MoorDyn's input file; the cable is stretched by ``int T ds/EA`` under the weight below it."""
    rho, m, length, g = string[:4]
    stretch = (string.weight + string.line_weight * length / 2.0) * length / STIFFNESS
    unstretched = length - stretch
    displaced = (rho - string.line_weight / g) * length / unstretched
    water = WATER if displaced else 0.0
    return _INPUT.format(
        density=rho * length / unstretched, stiffness=STIFFNESS, depth=-length, mass=m, unstretched=unstretched,
        segments=segments, gravity=g, bottom=4.0 * length, water=water,
        volume=(m - string.weight / g) / WATER, diameter=np.sqrt(4.0 / np.pi * displaced / WATER) or 0.01,
    )  # fmt: skip


def _run(command: list[str], folder: Path) -> None:
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=LIMIT, check=False)
    except subprocess.TimeoutExpired:
        raise CaseError(f"MoorDyn took more than {LIMIT:g} s") from None
    if done.returncode or not (folder / "tip.json").exists():
        raise CaseError(f"MoorDyn failed: {done.stderr.decode(errors='replace').strip()[-200:]}")
