"""What drag and current cost: the string of a preset in its sheared current beside the same string in air."""

from __future__ import annotations

from statistics import median
from typing import TYPE_CHECKING, Any

from benchmarks.rows import Row

if TYPE_CHECKING:
    from umbilical.scenario import Scenario

UNTIL = 60.0
ALONE: dict[str, Any] = {
    "motors": [], "ideal_thruster": True, "control.law": {"kind": "none"}, "control.motor_loop": None,
    "grid.elements": 64, "initial": {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5},
    "duration": UNTIL, "output.interval": UNTIL,
}  # fmt: skip
"""Nothing but the string, so that what drag costs is not hidden behind a controller."""
CALM: dict[str, Any] = {"cable.water": None, "payload.water": None, "environment.water": None}
PAYS_OUT = {"winch": {"law": "quintic", "start_length": 940.0, "end_length": 1000.0, "duration": UNTIL}}


def water_rows(repeat: int) -> list[Row]:
    """The string in drag and current over the calm one, held and paid out; sampling and the balance of powers count."""
    from umbilical.library import load

    string = load("work-class-1000m-current", ALONE)
    return [_row(name, string.replace(change), repeat) for name, change in (("held", {}), ("paid out", PAYS_OUT))]


def _row(name: str, wet: Scenario, repeat: int) -> Row:
    """Median of the ratios of pairs that follow each other."""
    calm = wet.replace(CALM)
    pairs = [(_seconds(wet), _seconds(calm)) for _ in range(repeat + 1)][1:]  # the first loads and warms up
    ratio, own = median(a / b for a, b in pairs), median(a for a, _ in pairs)
    told = f"{wet.grid.elements} elements, open loop, {1e3 * own:.0f} ms for {UNTIL:g} s in water"
    return Row(f"string in drag and current over calm, {name}", ratio, "x", note=f"median of {repeat} pairs, {told}")


def _seconds(scenario: Scenario) -> float:
    from umbilical.engine.simulate import simulate

    return simulate(scenario).timing["simulate_s"]
