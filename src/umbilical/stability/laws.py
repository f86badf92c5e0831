"""The built-in controller as linear systems, by differences of its kernels; adaptation is frozen.

The outer law with its observers is linear as it is. The loop of a motor is linearised at a steady speed, where every
error is zero; its voltage limit is left out: a voltage that has reached it answers nothing.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from umbilical.control.allocation.table import ADAPTIVE
from umbilical.control.cascade import CascadeState, MotorMemory, Motors, Outer, OuterMemory, update_motors, update_outer
from umbilical.control.contract import Decision, MotorReadings, Readings, TipReadings, make_decision, make_readings
from umbilical.engine.linearise import Linear, LinearisationPoint, Names, linearise
from umbilical.frames import Frame, leaves

READINGS = tuple(TipReadings.fields)
"""y(l), y_x(l) and, where they are granted, Dy/Dt and D(y_x)/Dt."""
_DEVIATIONS = np.linspace(-6.0, 6.0, 801)
_LIKELIHOOD = np.exp(-0.5 * _DEVIATIONS**2) / np.exp(-0.5 * _DEVIATIONS**2).sum()


def linear_outer_law(outer: Outer) -> Linear:
    """From the four readings at the ROV to the commanded thrust.

    States are what observers remember and the command that was held last, alpha_c.
    """
    state, readings, decision = _begun()
    remembered, kept = _reals(state.outer, OuterMemory)
    command = decision.outer[0]

    def step(x: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        remembered[kept], command.thrust_command, readings.tip[0] = x[:-1], x[-1], tuple(u)
        update_outer(outer, state, readings, decision)
        return np.append(remembered[kept], command.thrust_command), np.array([command.thrust_command])

    names = Names((*_names(OuterMemory), "thrust_command"), READINGS, ("thrust_command",))
    return linearise(step, LinearisationPoint(np.zeros(kept.size + 1), np.zeros(len(READINGS)), names))


def linear_motor_law(motors: Motors, number: int, speed: float, demand: float = 0.0, spread: float = 0.0) -> Linear:
    """From (demand U_i, w, i) to the voltage of one motor, eqs. (52)-(64), near a steady speed.

    Args:
        motors: settings of the motor loops.
        number: of the motor, from 0.
        speed: steady, not negative, rad/s.
        demand, spread: as for :func:`root_slope`; only where there is a spread, which the speed then belongs to.
    """
    width = motors.command_filter.width
    usual = soft_square(speed, width)
    c = motors.nominal[[number]]
    c["voltage_limit"] = np.inf
    only = motors._replace(nominal=c)
    state, readings, decision = _begun()
    remembered, kept = _reals(state.motors, MotorMemory)

    def step(x: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        remembered[kept], decision.motors[0].demand, readings.motors[0] = x, u[0], (u[1], u[2])
        update_motors(only, state, readings, decision)
        return remembered[kept], np.array([decision.motors[0].motor_voltage])

    scaled = -(c[0].f11 + c[0].f12 * speed) * speed
    steady = [speed, 0.0, 0.0, -motors.observer_gain * scaled, -c[0].f21 * speed - c[0].f22 * scaled]
    inputs = np.array([usual, speed, scaled / c[0].current_scale])
    names = Names(_names(MotorMemory), ("demand", *MotorReadings.fields), ("motor_voltage",))
    law = linearise(step, LinearisationPoint(np.array(steady), inputs, names))
    if spread:
        share = root_slope(demand, width, spread) / root_slope(usual, width)
        law.b[:, 0] *= share
        law.d[:, 0] *= share
    return law


def soft_square(speed: float, width: float) -> float:
    """The demand whose softened root is a speed, rad2/s2; the speed is not negative.

    >>> root = soft_square(3.0, 0.5)
    >>> round(root / (root**2 + 0.5**2) ** 0.25, 12)
    3.0
    """
    square = speed * speed
    return speed * sqrt(0.5 * (square + sqrt(square * square + 4.0 * width * width)))


def root_slope(demand: float, width: float, spread: float = 0.0) -> float:
    """Slope of the softened root U/(U^2 + s^2)^(1/4) at a demand, s/rad.

    Args:
        demand: mean of the demand, rad2/s2.
        width: s, rad2/s2.
        spread: standard deviation of a normally distributed demand, rad2/s2; the slope is then the mean slope, the
            gain of the equivalent linear element (Roberts, Spanos: Random Vibration and Statistical Linearization).

    >>> round(root_slope(0.0, 1e-3), 2), round(root_slope(0.0, 1e-3, spread=4.0), 3)
    (31.62, 0.43)
    """
    if spread > 1e-3 * np.hypot(demand, width):
        # The mean slope is E[root(U) x]/spread (Stein's lemma), which needs no point close to the steep part.
        demands = demand + spread * _DEVIATIONS
        roots = demands / np.sqrt(np.hypot(demands, width))
        return float((roots * _DEVIATIONS * _LIKELIHOOD).sum() / spread)
    square = demand * demand + width * width
    return (0.5 * demand * demand + width * width) / square**1.25


def shares(motors: Motors, kappa: np.ndarray) -> np.ndarray:
    """Demand on each motor per commanded thrust, rad2/(N s2), kappa frozen where it adapts (23)."""
    coefficients = motors.nominal["thrust_coefficient"]
    signs = np.sign(coefficients)
    return signs * kappa[0] if motors.allocation.method == ADAPTIVE else signs / np.abs(coefficients).sum()


def _begun() -> tuple[CascadeState, Readings, Decision]:
    """Memory of a controller of one motor after its first update, and what it reads and decides."""
    state = CascadeState(OuterMemory.many(1), np.zeros(2), MotorMemory.many(1))
    state.outer[0].updates = 1
    return state, make_readings(1), make_decision(1)


def _names(frame: type[Frame]) -> tuple[str, ...]:
    return tuple(name for name, dtype in leaves(frame) if dtype is np.float64)


def _reals(records: Frame, frame: type[Frame]) -> tuple[np.ndarray, np.ndarray]:
    """The memory of one record as numbers, and which of them are real."""
    flat = records.view(np.float64)  # pyright: ignore[reportAttributeAccessIssue]
    return flat, np.flatnonzero([dtype is np.float64 for _, dtype in leaves(frame)])
