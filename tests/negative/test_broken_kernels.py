"""One line of a kernel changed in a copy of the package, compiled anew: the verification notices, by ten times.

What the broken models cannot reach lies inside the compiled loop; here it is edited where it stands.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import pytest

import umbilical

MARGIN = 10.0

MANUFACTURED = ("rope, manufactured, l growing", "rope, manufactured, l shrinking")


class Edit(NamedTuple):
    """A line of a file of the package, what it is changed to, and the cases that must notice."""

    file: str
    line: str
    wrong: str
    cases: tuple[str, ...]


EDITS = {
    "the projection of the rope's added mass": Edit(
        "plant/rope/forces.py",
        "more = (total - bracket) * along - total * across",
        "more = 0.0 * bracket",
        ("rope, taut heave", *MANUFACTURED),
    ),
    "the water that slides along the rope": Edit(
        "plant/rope/forces.py",
        "turn, bend = 2.0 * slide",
        "turn, bend = 1.0 * slide",
        MANUFACTURED,
    ),
    "what enters with the rope that is paid out": Edit(
        "plant/rope/ends.py",
        "per = (1.0 + size / rope.stiffness) / size",
        "per = 1.0 / size",
        ("rope, manufactured, l growing",),
    ),
    "the side that the rope's material comes from": Edit(
        "plant/rope/rates.py",
        "if speed > 0.0 else (4, f - 1, f)",
        "if speed < 0.0 else (4, f - 1, f)",
        MANUFACTURED,
    ),
    "a body braked by slack rope": Edit(
        "plant/rope/ends.py",
        "if stretch[4, last] > 1.0 else 0.0",
        "if stretch[4, last] > 0.0 else 0.0",
        ("rope, free flight over slack",),
    ),
    "transport in the flux between elements": Edit(
        "plant/cable.py",
        "flow[f] = fma(-transport, slope, velocity)",
        "flow[f] = fma(transport, slope, velocity)",
        ("moving end, paying out at 5 m/s", "moving end, hauling in at 4 m/s"),
    ),
    "the material velocity in the drag across": Edit(
        "plant/forces/drag.py",
        "slides = (sinks - slip) / length\n    for j",
        "slides = -slip / length\n    for j",
        (
            "manufactured solution, at sea, l growing",
            "manufactured solution, at sea, l shrinking",
            "string in water, drag in still water",
        ),
    ),
    "the transport at the ROV": Edit(
        "plant/cable.py",
        "ends.tip_velocity - slip * ends.tip_slope",
        "ends.tip_velocity",
        ("manufactured solution, at sea, l growing", "manufactured solution, at sea, l shrinking"),
    ),
    "the work of the thrust": Edit(
        "engine/stepping.py",
        "work_thrust += now.average.thrust * moved",
        "work_thrust -= now.average.thrust * moved",
        ("power balance, paying out, controlled", "power balance, hauling in, controlled"),
    ),
    "the ROV's part in the rate of the slope": Edit(
        "engine/sensing.py",
        "slope += cable.LIFT * (",
        "slope -= cable.LIFT * (",
        (
            "manufactured solution, l growing, rate of the slope",
            "manufactured solution, l shrinking, rate of the slope",
        ),
    ),
    "the cross term of (60)": Edit(
        "control/motor/backstepping.py",
        "-gains.current_gain * e2 - e1 - c.f21 * speed",
        "-gains.current_gain * e2 + e1 - c.f21 * speed",
        ("law of a motor at random states",),
    ),
    "the robust term of (59)": Edit(
        "control/motor/backstepping.py",
        "wanted_rate -= robust1",
        "wanted_rate += robust1",
        ("law of a motor at random states",),
    ),
}

JUDGE = """
import sys
from umbilical.verify import FAMILIES
from umbilical.verify.cases import worst_ratio
cases = {case.name: case for cases in FAMILIES.values() for case in cases}
for name in sys.argv[1:]:
    print(worst_ratio(cases[name].judge().checks))
"""


def worst_ratios(folder: Path, edit: Edit) -> list[float]:
    """Largest error over tolerance of each case, by an edited copy of the package in a folder."""
    package = Path(umbilical.__file__).parent
    shutil.copytree(package, folder / package.name, ignore=shutil.ignore_patterns("__pycache__"))
    file = folder / package.name / edit.file
    text = file.read_text(encoding="utf-8")
    assert text.count(edit.line) == 1
    file.write_text(text.replace(edit.line, edit.wrong), encoding="utf-8")
    places = {"PYTHONPATH": str(folder), "UMBILICAL_CACHE": str(folder / "cache")}
    command = [sys.executable, "-c", JUDGE, *edit.cases]
    answer = subprocess.run(command, env={**os.environ, **places}, capture_output=True, text=True, check=True)
    return [float(line) for line in answer.stdout.splitlines()]


@pytest.fixture(scope="module")
def ratios(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, Future[list[float]]]]:
    """Those of every edit, two copies at a time: most of it is compilation."""
    with ThreadPoolExecutor(2) as pool:
        yield {name: pool.submit(worst_ratios, tmp_path_factory.mktemp("broken"), edit) for name, edit in EDITS.items()}


@pytest.mark.slow
@pytest.mark.parametrize("name", EDITS)
def test_it_is_noticed(name: str, ratios: dict[str, Future[list[float]]]) -> None:
    assert min(ratios[name].result()) > MARGIN
