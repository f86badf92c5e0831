"""The outer laws: what a scenario's ``control.law.kind`` stands for.

A kernel cannot walk over a table: ``start_law`` and ``update_law`` name every law once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

from umbilical.compile import glue
from umbilical.control.contract import OuterDecision, Readings
from umbilical.control.outer.boundary import (
    Boundary,
    BoundaryMemory,
    boundary_law,
    make_boundary,
    start_boundary,
    update_boundary,
)
from umbilical.control.outer.law import Believed, believe
from umbilical.control.outer.pd import PDGains, make_pd, proportional_derivative, update_pd
from umbilical.errors import Problem
from umbilical.frames import Frame, part
from umbilical.scenario.control import Control
from umbilical.scenario.findings import Finding
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.sensors import Sensors

LAWS: dict[str, tuple[Callable[..., Iterator[Finding]], ...]] = {
    "none": (),
    "pd": (proportional_derivative,),
    "boundary": (boundary_law,),
}
"""Every law with the checks of its gains against its period."""
NONE, PD, BOUNDARY = range(len(LAWS))
"""What the kernels switch on: the place of a law in :data:`LAWS`."""


class Laws(NamedTuple):
    """Which law decides, what all are told, and the constants of each, idle where it is not the scenario's."""

    kind: int
    believed: Believed
    pd: PDGains
    boundary: Boundary


class LawMemory(Frame):
    """What each law remembers."""

    boundary = part(BoundaryMemory)


def make_laws(scenario: Scenario, period: float, across: bool = False) -> Laws:
    """Constants of a scenario's law for one period of the outer loop; ``across``: for the direction y of a rope."""
    control, believed = scenario.control, believe(scenario, across)
    kind = list(LAWS).index(control.law.kind)
    return Laws(kind, believed, make_pd(control), make_boundary(control, period, believed, across))


@glue
def start_law(laws: Laws, memory: LawMemory, readings: Readings, velocity: float) -> None:
    """Memory at the first sample; ``velocity`` as far as it is measured, m/s, else 0."""
    start_boundary(laws.boundary, laws.believed, memory.boundary, readings.tip[0], velocity)


@glue
def update_law(laws: Laws, memory: LawMemory, readings: Readings, out: OuterDecision, advance: bool) -> None:
    """Decide the thrust; ``advance`` is False at the first update, before which no period has passed."""
    if laws.kind == PD:
        update_pd(laws.pd, readings.tip[0], out)
    elif laws.kind == BOUNDARY:
        update_boundary(laws.boundary, laws.believed, memory.boundary, readings, out, advance)


def sections_of_the_law(control: Control) -> Iterator[Finding]:
    """The observers that the law reads are described."""
    for name in control.law.observers:
        if getattr(control, name) is None:
            yield Problem(
                f"control.{name}", "missing", "required", f"the law '{control.law.kind}' reads it",
                f"add [control.{name}] with time_constant and damping",
            )  # fmt: skip


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
