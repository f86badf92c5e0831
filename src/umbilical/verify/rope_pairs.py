"""The presets of the string on the rope: what one key changes, where slopes and stretch are small."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.run import Run
from umbilical.scenario.scenario import Scenario
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, each, small
from umbilical.verify.invariance import TWO_RUNS

PRESETS: dict[str, dict[str, float]] = {
    "crosscheck": {"crosscheck-none": 0.1, "crosscheck-no-observer": 1.0, "crosscheck-pd": 0.1,
                   "crosscheck-proposed": 1.0},
    "paper": {"paper": 1.0, "paper-none": 0.1, "paper-pd": 0.1, "paper-adaptive": 1.0, "haul-in": 1.0,
              "ringdown": 0.01},
    "faults": {f"paper-{fault}{law}": 1.0 for fault in ("dead", "partial", "stuck") for law in ("", "-adaptive")},
    "current": {"work-class-1000m-current": 1.0},
}  # fmt: skip
"""Every preset of the string, and the share of its load and of its shape at the start that is taken: slopes of 0.05 at
full size leave second orders of some 1e-3, of which a tenth is left of the tenth."""
ELEMENTS = 16
"""Of both, so that both round off the fronts of a jump alike; a grid of 64 has the same differences."""
SHIP: dict[str, Any] = {"kind": "box", "length": 93.0, "breadth": 20.0, "draught": 6.6, "block_coefficient": 0.75,
                        "sheave_forward": 10.0}  # fmt: skip
SYSTEM: dict[str, Any] = {"significant_height": 0.5, "peak_period": 8.0, "heading": 2.0, "components": 40}
SEAWAY: dict[str, Any] = {
    "duration": 60.0, "environment.vessel_ramp": 20.0, "control.law": {"kind": "none"},
    "environment.sea": {"systems": [SYSTEM], "vessel": SHIP, "plane": 2.0, "heave": True, "orbital_below": 6.6},
    "environment.water.current": {"depths": [0.0, 1100.0], "speeds": [0.5, 0.06],
                                  "variation": [engine.sine(0.2, 0.3)]},
}  # fmt: skip
"""Waves that move vessel and water, heave in the tension, a current that varies; a law would know the tension of the
rope, and not that of a string that heaves."""


def _smaller(scenario: Scenario, share: float) -> dict[str, Any]:
    """What makes a scenario's force on the ROV and its shape at the start a share of what they are."""
    change: dict[str, Any] = {}
    for number, term in enumerate(scenario.environment.payload_force, start=1):
        for name in {"value", "amplitude"} & set(type(term).model_fields):
            change[f"environment.payload_force.{number}.{name}"] = share * getattr(term, name)
    if "amplitude" in type(scenario.initial).model_fields:
        change["initial.amplitude"] = share * scenario.initial.amplitude  # type: ignore[union-attr]
    return change


def _beside(scenario: Scenario) -> tuple[Run, Run]:
    """The same on the string and on the rope, on grids of :data:`ELEMENTS`."""
    grids = {"grid.elements": ELEMENTS, "rope.elements": ELEMENTS}
    string, rope = (engine.completed(scenario.replace({**grids, "model": model})) for model in ("string", "rope"))
    return string, rope


def _compared(name: str, scenario: Scenario, why: str) -> Iterator[Check]:
    """Displacement of tip and midpoint: rms of the difference over the rms of the string's."""
    runs = _beside(scenario)
    for place, sigma in (("tip", 1.0), ("midpoint", 0.5)):
        y, other = (run["displacement"].sel(sigma=sigma, method="nearest").values for run in runs)
        off = float(np.sqrt(((y - other) ** 2).mean() / (y**2).mean()))
        yield small(f"{name}, {place}: rms of the difference over that of y", off, 1e-3, why)


def _presets(group: str) -> Iterator[Check]:
    """One family of presets."""
    for name, share in PRESETS[group].items():
        scenario = load(name)
        why = "stretch of 1e-4, second orders of the slope" + (f" at {share:g} of the load" if share < 1.0 else "")
        yield from _compared(name, scenario.replace(_smaller(scenario, share)), why)


def _seaway() -> Iterator[Check]:
    """A free ROV on 1000 m in waves and in a sheared current that varies."""
    scenario = load("work-class-1000m-current", SEAWAY)
    yield from _compared("waves and a varying current", scenario, "stretch of 1e-4, second orders of the slope")


CASES = (
    *each("rope beside the string, {}", TWO_RUNS, "small motions", _presets, tuple(PRESETS), quick=False),
    Case("rope beside the string, waves and current", TWO_RUNS, "small motions", _seaway, quick=False),
)
