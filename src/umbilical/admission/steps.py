"""Explicit limits on the step of the plant, computed from the scenario."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import ceil, sqrt

import numpy as np

from umbilical.admission.findings import Finding, amount
from umbilical.admission.motion import sampled_winch
from umbilical.errors import Problem
from umbilical.plant.elements import highest_frequency
from umbilical.scenario.control import Control
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable, Motor, Payload
from umbilical.scenario.scenario import Grid
from umbilical.scenario.winch import Winch

_VERLET = 1.8
"""Largest product of step and angular frequency; velocity Verlet is stable below 2."""
_RUNGE_KUTTA = 2.5
"""Largest product of step and pole; the classical fourth-order method is stable below 2.785 on the real axis."""
_USUAL_SPEED = 100.0
"""Speed at which a motor's poles are judged when no voltage limit bounds it, rad/s."""


def plant_step(control: Control, grid: Grid) -> float:
    """The step taken, s: the control period in as few equal parts as ``grid.step`` allows."""
    parts = min(control.period / grid.step, 1e15)  # a step of 1e-320 s has its own problem: the size of the run
    return control.period / ceil(parts * (1.0 - 1e-9))


def cable(
    cable: Cable,
    payload: Payload,
    environment: Environment,
    winch: Winch,
    duration: float,
    control: Control,
    grid: Grid,
) -> Iterator[Finding]:
    """The step resolves the fastest wave between two nodes, throughout the run."""
    if not (sampled := sampled_winch(winch, duration)):
        return
    _, motion = sampled
    net = np.maximum(environment.gravity - motion.acceleration, 0.0)
    tension = (payload.mass + cable.hanging_density * motion.length) * net
    speed = np.sqrt(tension / cable.line_density) + np.abs(motion.speed)
    worst = int(np.argmax(speed / motion.length))
    element = float(motion.length[worst]) / grid.elements
    if element <= 0.0:
        return  # the length has its own problem
    limit = _VERLET / highest_frequency(float(speed[worst]), element)
    if plant_step(control, grid) > limit:
        yield Problem(
            "grid.step",
            amount(plant_step(control, grid), "s"),
            f"at most {limit:.4g} s",
            f"waves of {speed[worst]:.4g} m/s cross elements of {element:.4g} m; the scheme is explicit",
            "a smaller grid.step or fewer grid.elements",
        )


def damping(cable: Cable, payload: Payload, control: Control, grid: Grid) -> Iterator[Finding]:
    """Damping is explicit too: within a step it takes less than all of the speed."""
    step = plant_step(control, grid)
    for key, coefficient, unit, inertia in (
        ("cable.damping", cable.damping, "N s/m2", cable.line_density),
        ("payload.damping", payload.damping, "N s/m", payload.mass),
    ):
        if step * coefficient >= inertia:
            yield Problem(
                key,
                amount(coefficient, unit),
                f"below {inertia / step:.6g} {unit} at a step of {step:g} s",
                "within one step it would take more than all of the speed",
                "a smaller grid.step",
            )


def motors(motors: Sequence[Motor], ideal_thruster: bool, control: Control, grid: Grid) -> Iterator[Finding]:
    """The step resolves the fastest pole of each motor over the speeds it reaches."""
    if ideal_thruster:
        return
    step = plant_step(control, grid)
    for number, motor in enumerate(motors, start=1):
        speed = reachable_speed(motor)
        pole = max(fastest_pole(motor, speed), fastest_pole(motor, 0.0))
        if not pole * step <= _RUNGE_KUTTA:
            yield Problem(
                "grid.step",
                amount(step, "s"),
                f"at most {_RUNGE_KUTTA / pole:.4g} s",
                f"motor {number} has a pole at {pole:.6g} 1/s at {speed:.6g} rad/s; the scheme is explicit",
                f"a smaller grid.step, or check motors.{number}.inductance and motors.{number}.inertia",
            )


def reachable_speed(motor: Motor) -> float:
    """Steady speed at the voltage limit, rad/s, from ``K_Q w^2 + (B + K_t K_b/R) w = K_t U/R``."""
    if motor.voltage_limit is None:
        return _USUAL_SPEED
    torque = motor.torque_constant * motor.voltage_limit / motor.resistance
    friction = motor.viscous_friction + motor.torque_constant * motor.back_emf_constant / motor.resistance
    root = friction + sqrt(friction * friction + 4.0 * motor.load_coefficient * torque)
    return 2.0 * torque / root if root > 0.0 else _USUAL_SPEED


def fastest_pole(motor: Motor, speed: float) -> float:
    """Largest modulus, 1/s, of the poles of eq. (15) linearised at a speed, rad/s; infinite if they overflow."""
    brake = motor.viscous_friction + 2.0 * motor.load_coefficient * abs(speed)
    matrix = np.array([
        [-brake / motor.inertia, motor.torque_constant / motor.inertia],
        [-motor.back_emf_constant / motor.inductance, -motor.resistance / motor.inductance],
    ])  # fmt: skip
    return float(np.abs(np.linalg.eigvals(matrix)).max()) if np.isfinite(matrix).all() else float("inf")
