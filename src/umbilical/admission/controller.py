"""Checks of the controller: the sections its law needs, and lists that go with the motors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi, sqrt
from typing import NamedTuple

from umbilical.admission.findings import Finding, Notice, amount
from umbilical.errors import Problem
from umbilical.plant.top import top_at
from umbilical.relations.tension import hanging_of, net_gravity, tension
from umbilical.scenario.control import AdaptiveAllocation, BoundaryLaw, Control, NoControl, ProportionalDerivative
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable, Motor, Payload
from umbilical.scenario.scenario import Grid
from umbilical.scenario.sensors import Sensors
from umbilical.scenario.winch import Winch


class Needs(NamedTuple):
    """What a law takes its rates from."""

    velocity_observer: bool
    slope_observer: bool
    ideal_velocity: bool


def needs(control: Control) -> Needs:
    """Observers and sensors that the chosen law uses."""
    law = control.law
    if isinstance(law, BoundaryLaw):
        observes = law.rates == "observer"
        return Needs(observes, observes, not observes)
    if isinstance(law, ProportionalDerivative):
        observes = law.velocity == "observer"
        return Needs(observes, False, not observes)
    return Needs(False, False, False)


def drives_motors(control: Control, ideal_thruster: bool) -> bool:
    """Whether the inner loops run: a thrust is commanded and motors deliver it."""
    return not ideal_thruster and not isinstance(control.law, NoControl)


def sections_of_the_law(control: Control) -> Iterator[Finding]:
    """The observers that the law reads are described."""
    for name in ("velocity_observer", "slope_observer"):
        if getattr(needs(control), name) and getattr(control, name) is None:
            yield Problem(
                f"control.{name}",
                "missing",
                "required",
                f"the law '{control.law.kind}' reads it",
                f"add [control.{name}] with time_constant and damping",
            )


def ideal_sensors(control: Control, sensors: Sensors) -> Iterator[Finding]:
    """A law that reads velocities directly has been granted the sensors for it."""
    if needs(control).ideal_velocity and not sensors.ideal_velocity:
        name = "velocity" if isinstance(control.law, ProportionalDerivative) else "rates"
        yield Problem(
            f"control.law.{name}",
            '"sensor"',
            '"observer", or sensors.ideal_velocity = true',
            "velocities are not measured unless an ideal sensor is granted",
            "grant the sensor or use the observers",
        )


def motor_loop(control: Control, ideal_thruster: bool) -> Iterator[Finding]:
    """Driven motors have a loop that drives them."""
    if drives_motors(control, ideal_thruster) and control.motor_loop is None:
        yield Problem(
            "control.motor_loop",
            "missing",
            "required",
            "the motors must follow the demanded thrust",
            "add [control.motor_loop], or set ideal_thruster = true",
        )


def adaptation(control: Control, motors: Sequence[Motor], ideal_thruster: bool) -> Iterator[Finding]:
    """Lists of the adaptive law have n + 1 entries, positive rates and a box around the start."""
    law = control.allocation
    if not isinstance(law, AdaptiveAllocation):
        return
    if ideal_thruster:
        yield Problem(
            "control.allocation.method",
            '"adaptive"',
            '"known" with ideal_thruster',
            "an ideal thruster has no motors to share the thrust",
            "set ideal_thruster = false",
        )
    for name in ("rates", "initial", "lower", "upper"):
        values = getattr(law, name)
        if values is not None and len(values) != len(motors) + 1:
            yield Problem(
                f"control.allocation.{name}",
                f"{len(values)} entries",
                f"{len(motors) + 1} entries",
                f"kappa_0 and one more for each of the {len(motors)} motors",
                "one entry each",
            )
    for number, rate in enumerate(law.rates, start=1):
        if rate <= 0.0:
            yield Problem(
                f"control.allocation.rates.{number}",
                f"{rate:g}",
                "above 0",
                "a rate of the wrong sign adapts away from the fault",
                "a positive rate",
            )
    yield from _box(law)


def nominal(control: Control, motors: Sequence[Motor]) -> Iterator[Finding]:
    """What the controller believes of the motors it believes of each of them."""
    believed = control.nominal
    for name, values in (("thrust_coefficients", believed.thrust_coefficients), ("motors", believed.motors)):
        if values is not None and len(values) != len(motors):
            yield Problem(
                f"control.nominal.{name}",
                f"{len(values)} entries",
                f"{len(motors)} entries",
                "one for each motor",
                "as many entries as [[motors]], or leave it out",
            )
    coefficients = {f"thrust_coefficients.{k}": c for k, c in enumerate(believed.thrust_coefficients or (), start=1)}
    for number, motor in enumerate(believed.motors or (), start=1):
        coefficients[f"motors.{number}.thrust_coefficient"] = motor.thrust_coefficient
    for name, coefficient in coefficients.items():
        if coefficient == 0.0:
            yield Problem(
                f"control.nominal.{name}",
                amount(0.0, "N s2/rad2"),
                "above or below 0",
                "the allocation divides by the sum of their sizes",
                "the sign says which way it pushes",
            )


def _box(law: AdaptiveAllocation) -> Iterator[Finding]:
    for number, start in enumerate(law.initial, start=1):
        lower, upper = (box[number - 1] if box and number <= len(box) else start for box in (law.lower, law.upper))
        if not lower <= start <= upper:
            yield Problem(
                f"control.allocation.initial.{number}",
                f"{start:g}",
                f"from {lower:g} to {upper:g}",
                "kappa is projected onto the box between lower and upper, and starts in it",
                "a start inside the box, or a box around the start",
            )


def adaptation_has_its_error(control: Control) -> Iterator[Finding]:
    """The adaptive law is driven by u_a, which only the boundary law computes."""
    if isinstance(control.allocation, AdaptiveAllocation) and not isinstance(control.law, BoundaryLaw):
        yield Problem(
            "control.allocation.method",
            '"adaptive"',
            f'"known" with the law "{control.law.kind}"',
            "the adaptive law is driven by u_a, which only the boundary law computes: kappa would only leak away",
            'set control.law.kind = "boundary" or control.allocation.method = "known"',
        )


_FELT_FROM = 0.2
"""Share of the wave speed at the ROV from which on a slope gain lets the motors chatter at waves no grid carries."""


def grid_near_the_payload(
    duration: float,
    control: Control,
    cable: Cable,
    payload: Payload,
    environment: Environment,
    winch: Winch,
    grid: Grid,
) -> Iterator[Finding]:
    """Waves too short for the grid are damped where a real cable sends them back from the vessel."""
    pull = tension(0.0, net_gravity(environment.gravity), hanging_of(cable, payload, environment))
    speed = sqrt(pull / cable.line_density)
    if isinstance(control.law, BoundaryLaw) and control.law.slope_gain >= _FELT_FROM * speed:
        longest = float(top_at(winch, [0.0, duration]).length.max())
        band = 2.0 * pi * speed * grid.elements / longest
        yield Notice(
            "control.law.slope_gain",
            f"at {control.law.slope_gain:g} m/s the loop feels waves above {band:.0f} rad/s, which this grid damps "
            "and a cable would send back: judge stability by `umbilical margins`",
        )
