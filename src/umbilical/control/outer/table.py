"""The outer laws: what a scenario's ``control.law.kind`` stands for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from umbilical.control.outer import boundary, pd
from umbilical.errors import Problem
from umbilical.scenario.control import Control
from umbilical.scenario.findings import Finding
from umbilical.scenario.sensors import Sensors

NONE, PD, BOUNDARY = range(3)
"""What the kernel of the outer law switches on."""


class OuterPart(NamedTuple):
    """A law: its number, its two gains, and the checks of them against its period."""

    number: int
    gains: Callable[[Any], tuple[float, float]]
    checks: tuple[Callable[..., Iterator[Finding]], ...] = ()


LAWS = {
    "none": OuterPart(NONE, lambda law: (0.0, 0.0)),
    "boundary": OuterPart(BOUNDARY, boundary.gains, (boundary.boundary_law,)),
    "pd": OuterPart(PD, pd.gains, (pd.proportional_derivative,)),
}


def sections_of_the_law(control: Control) -> Iterator[Finding]:
    """The observers that the law reads are described."""
    for name in control.law.observers:
        if getattr(control, name) is None:
            yield Problem(
                f"control.{name}",
                "missing",
                "required",
                f"the law '{control.law.kind}' reads it",
                f"add [control.{name}] with time_constant and damping",
            )


def ideal_sensors(control: Control, sensors: Sensors) -> Iterator[Finding]:
    """A law that reads velocities directly has been granted the sensors for it."""
    if control.law.reads_rates and not sensors.ideal_velocity:
        yield Problem(
            f"control.law.{control.law.rates_key}",
            '"sensor"',
            '"observer", or sensors.ideal_velocity = true',
            "velocities are not measured unless an ideal sensor is granted",
            "grant the sensor or use the observers",
        )
