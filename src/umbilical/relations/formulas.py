"""Thrust and motor constants: one formula, one place.

Each function works on floats and arrays in plain Python and is inlined into the kernels that call it.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import Any

import numpy as np

from umbilical.compile import formula
from umbilical.frames import Frame, real


@formula
def signed_square(speed: float) -> float:
    """|w| w, rad2/s2: what a propeller turns into thrust and load torque (8), (15)."""
    return abs(speed) * speed


@formula
def soft_signed_root(demand: float, width: float) -> float:
    """sgn(U) sqrt|U| made smooth at 0: U / (U^2 + s^2)^(1/4), rad/s for U in rad2/s2."""
    return demand / sqrt(sqrt(demand * demand + width * width))


class MotorConstants(Frame):
    """The constants f11 ... f23 of the motor written in z1 = w, z2 = (K_t/J) i, eqs. (44)-(46)."""

    f11 = real()
    f12 = real()
    f13 = real()
    f21 = real()
    f22 = real()
    f23 = real()
    current_scale = real()


def motor_constants(motor: Any) -> MotorConstants:
    """f11 ... f23 of a :class:`~umbilical.scenario.hardware.Motor`, and K_t/J."""
    scale = motor.torque_constant / motor.inertia
    return MotorConstants.one(
        f11=-motor.viscous_friction / motor.inertia, f12=-motor.load_coefficient / motor.inertia,
        f13=1.0 / motor.inertia, f21=-scale * motor.back_emf_constant / motor.inductance,
        f22=-motor.resistance / motor.inductance, f23=scale / motor.inductance, current_scale=scale,
    )  # fmt: skip


def motor_rates(motor: Any, speed: float) -> tuple[np.ndarray, np.ndarray]:
    """(15) near a steady speed, rad/s: ``(w, i)' = rates (w, i) + volts U``."""
    brake = motor.viscous_friction + 2.0 * motor.load_coefficient * abs(speed)
    rates = [
        [-brake / motor.inertia, motor.torque_constant / motor.inertia],
        [-motor.back_emf_constant / motor.inductance, -motor.resistance / motor.inductance],
    ]
    return np.array(rates), np.array([[0.0], [1.0 / motor.inductance]])


def steady_speed(
    motor: Any, voltage: float, voltage_disturbance: float = 0.0, torque_disturbance: float = 0.0
) -> float:
    """Speed at which a motor settles under constant voltage, rad/s: the root of (15) at rest; infinite without a brake.

    ``w = sgn(G) (-b + sqrt(b^2 + 4 K_Q |G|)) / (2 K_Q)`` with ``G = K_t (U + d2)/R + d1`` and
    ``b = B + K_t K_b/R``.
    """
    drive = motor.torque_constant * (voltage + voltage_disturbance) / motor.resistance + torque_disturbance
    brake = motor.viscous_friction + motor.torque_constant * motor.back_emf_constant / motor.resistance
    size = abs(drive)
    # The textbook root loses all digits as K_Q -> 0; this form of it does not.
    root = brake + sqrt(brake * brake + 4.0 * motor.load_coefficient * size)
    speed = 2.0 * size / root if root else inf if size else 0.0
    return speed if drive >= 0.0 else -speed
