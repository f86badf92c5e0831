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

from math import sqrt
from typing import NamedTuple

from umbilical.compile import kernel
from umbilical.control.motor.command_filter import Reference
from umbilical.relations.formulas import MotorConstants, signed_square


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
