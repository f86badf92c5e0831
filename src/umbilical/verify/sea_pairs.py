"""What must hold between two runs in waves: of the string and the rope, and of two descriptions of one sea."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from umbilical.scenario.scenario import Scenario
from umbilical.verify import ours
from umbilical.verify.cases import Case, Check, small
from umbilical.verify.invariance import TWO_RUNS
from umbilical.verify.water import BODY, string

SHIP: dict[str, Any] = {"kind": "box", "length": 93.0, "breadth": 20.0, "draught": 6.6, "block_coefficient": 0.75,
                        "sheave_forward": 10.0, "sheave_up": 8.0}  # fmt: skip
SYSTEM: dict[str, Any] = {"significant_height": 1e-3, "peak_period": 8.0, "heading": 2.0, "components": 40}
SEA: dict[str, Any] = {"systems": [SYSTEM], "vessel": SHIP, "plane": 2.0, "orbital_below": 6.6}
TMS: dict[str, Any] = BODY | {"displaced_mass": 5400.0}
STIFF = 1e9
"""EA, N, of a rope that is nearly a string."""


def in_waves(**changes: Any) -> Scenario:
    """A string of 100 m in still water under a small sea."""
    base = {"environment__sea": SEA, "environment__vessel_ramp": 5.0, "environment__water__current": None,
            "payload__water": TMS, "grid__elements": 6, "duration": 10.0, "output__interval": 0.2}  # fmt: skip
    return string(100.0, **base | changes)


def as_rope(scenario: Scenario) -> Scenario:
    """The same cable and body as a rope of :data:`STIFF`."""
    stiff = {"cable.axial_stiffness": STIFF, "rope.elements": scenario.grid.elements}
    return scenario.replace({"model": "rope", **stiff})


def moved_by_waves() -> Iterator[Check]:
    """What the orbital motion of a small sea makes of a string, and of a stiff rope."""
    still = SEA | {"orbital_below": None}
    rows = []
    for change in (lambda scenario: scenario, as_rope):
        with_waves, without = (ours.completed(change(in_waves(environment__sea=sea))) for sea in (SEA, still))
        rows.append(with_waves["displacement"].values - without["displacement"].values)
    gap = float(abs(rows[0] - rows[1]).max() / abs(rows[0]).max())
    yield small("y that the waves in the water add, share of its largest", gap, 1e-3, "the rope's stretch and heave")


CASES = (Case("sea, string and rope in waves", TWO_RUNS, "small motions of a stiff rope", moved_by_waves),)
