"""The multiplicative inverse controller of a motor: backstepping with smooth robust terms, eqs. (52)-(64).

With e1 = z1 - w_d and e2 = z2 - i_d::

    (52) i_d  = -k1 e1 - f11 z1 - f12 z1|z1| - db1 mu e1/sqrt(e1^2 + e0^2) + w_d'
    (59) i_d' = -k1 e1' - f11 z1' - 2 f12 |z1| z1' - db1 mu e0^2 e1'/(e1^2 + e0^2)^(3/2) + w_d''
    (60) V_b  = -k2 e2 - e1 - f21 z1 - f22 z2 - db2 mu e2/sqrt(e2^2 + e02^2) + i_d'
    (64) V    = V_b - d^

where z1' is nominal (the torque disturbance left out) and e1' = z1' - w_d'. The paper prints sgn(e2) in
(60); its smooth form is ours.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import sqrt
from typing import NamedTuple

from umbilical.compile import kernel
from umbilical.control.motor.command_filter import Reference
from umbilical.control.rates import drives_motors, within_a_period
from umbilical.errors import Problem
from umbilical.relations.formulas import MotorConstants, signed_square
from umbilical.scenario.control import Control
from umbilical.scenario.findings import Finding, amount
from umbilical.scenario.hardware import Motor


class Backstepping(NamedTuple):
    """Gains of the inner loop, in the units of :mod:`umbilical.quantities`."""

    speed_gain: float
    current_gain: float
    robust_factor: float
    speed_width: float
    current_width: float
    speed_bound: float
    current_bound: float


@kernel
def smooth_sign(error: float, width: float) -> float:
    """e/sqrt(e^2 + w^2): a sign without a jump (51)."""
    return error / sqrt(error * error + width * width)


@kernel
def backstepping_drive(
    c: MotorConstants, gains: Backstepping, speed: float, scaled_current: float, reference: Reference
) -> float:
    """V_b of (60), rad/s3."""
    e1 = speed - reference.speed_reference
    square = signed_square(speed)
    rate = scaled_current + c.f11 * speed + c.f12 * square
    e1_rate = rate - reference.speed_reference_rate
    robust1 = gains.speed_bound * gains.robust_factor
    soft = e1 * e1 + gains.speed_width * gains.speed_width

    wanted = -gains.speed_gain * e1 - c.f11 * speed - c.f12 * square + reference.speed_reference_rate
    wanted -= robust1 * smooth_sign(e1, gains.speed_width)
    wanted_rate = -gains.speed_gain * e1_rate - c.f11 * rate - 2.0 * c.f12 * abs(speed) * rate
    wanted_rate += reference.speed_reference_curvature
    wanted_rate -= robust1 * gains.speed_width * gains.speed_width * e1_rate / (soft * sqrt(soft))

    e2 = scaled_current - wanted
    drive = -gains.current_gain * e2 - e1 - c.f21 * speed - c.f22 * scaled_current + wanted_rate
    return drive - gains.current_bound * gains.robust_factor * smooth_sign(e2, gains.current_width)


def motor_loop(control: Control, ideal_thruster: bool) -> Iterator[Finding]:
    """Driven motors have a loop that drives them."""
    if drives_motors(control, ideal_thruster) and control.motor_loop is None:
        yield Problem(
            "control.motor_loop", "missing", "required", "the motors must follow the demanded thrust",
            "add [control.motor_loop], or set ideal_thruster = true",
        )  # fmt: skip


def sampled_gains(control: Control, ideal_thruster: bool, motors: Sequence[Motor]) -> Iterator[Finding]:
    """The gains of the inner loop, robust terms included, at the controller's period."""
    loop, period = control.motor_loop, control.period
    if loop is None or not motors or not drives_motors(control, ideal_thruster):
        return
    # Near a zero error the smooth robust term is a gain of its own: bound * factor / width.
    robust_speed = loop.speed_bound * loop.robust_factor / loop.speed_width
    robust_current = loop.current_bound * loop.robust_factor / loop.current_width
    place = "control.motor_loop"
    yield from _sum(f"{place}.speed_gain", loop.speed_gain, robust_speed, "speed", period)
    yield from _sum(f"{place}.current_gain", loop.current_gain, robust_current, "current", period)
    yield from within_a_period(f"{place}.observer_gain", loop.observer_gain, "1/s", 1.0, period)
    yield from within_a_period(f"{place}.filter_frequency", loop.filter_frequency, "rad/s", 1.0, period)


def _sum(key: str, gain: float, robust: float, name: str, period: float) -> Iterator[Finding]:
    """The gain and the slope of its robust term together, 1/s, times the period stay below 1."""
    if (gain + robust) * period >= 1.0:
        yield Problem(
            key,
            amount(gain, "1/s"),
            f"{name}_gain + {name}_bound * robust_factor / {name}_width below {1.0 / period:.6g} 1/s, "
            f"and {gain:g} + {robust:g} = {gain + robust:.6g} 1/s",
            f"the voltage is held for {period:g} s; such a gain overshoots within it and the voltage alternates",
            f"a smaller {name}_gain or {name}_bound, a larger {name}_width, or a shorter control.period",
        )
