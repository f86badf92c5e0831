"""The motors, eq. (15), advanced by the classical Runge-Kutta method (order 4); thrust and its faults, (8), (16).

::

    J w' = K_t i - B w - K_Q |w| w + d1
    L i' = -R i - K_b w + U + d2
    alpha = sum_i K_Ti u_i,   u_i = rho_i |w_i| w_i + u_ki
"""

from __future__ import annotations

from collections.abc import Sequence
import numpy as np

from umbilical.compile import kernel
from umbilical.relations.formulas import signed_square
from umbilical.scenario.hardware import Motor


# Rows of the motors' constants, shape (9, n), and of their state, shape (2, n).
INERTIA, VISCOUS_FRICTION, TORQUE_CONSTANT, LOAD_COEFFICIENT, RESISTANCE, INDUCTANCE = range(6)
BACK_EMF_CONSTANT, THRUST_COEFFICIENT, VOLTAGE_LIMIT = range(6, 9)
_NAMES = (
    "inertia", "viscous_friction", "torque_constant", "load_coefficient", "resistance", "inductance",
    "back_emf_constant", "thrust_coefficient", "voltage_limit",
)  # fmt: skip
SPEED, CURRENT = range(2)


def make_motors(motors: Sequence[Motor]) -> np.ndarray:
    """Constants of a scenario's motors, shape (9, n); no voltage limit means an infinite one."""
    rows = [[getattr(m, name) for m in motors] for name in _NAMES]
    return np.array([[np.inf if v is None else v for v in row] for row in rows], dtype=float)


def make_motor_state(count: int) -> np.ndarray:
    """All motors at rest: speed (rad/s) and current (A), shape (2, n)."""
    return np.zeros((2, count))


@kernel
def shaft_acceleration(m: np.ndarray, k: int, speed: float, current: float, torque: float) -> float:
    """w' of motor k, first line of (15)."""
    drag = m[VISCOUS_FRICTION, k] * speed + m[LOAD_COEFFICIENT, k] * signed_square(speed)
    return (m[TORQUE_CONSTANT, k] * current - drag + torque) / m[INERTIA, k]


@kernel
def current_rate(m: np.ndarray, k: int, speed: float, current: float, voltage: float) -> float:
    """i' of motor k, second line of (15); ``voltage`` holds U + d2."""
    return (voltage - m[RESISTANCE, k] * current - m[BACK_EMF_CONSTANT, k] * speed) / m[INDUCTANCE, k]


@kernel
def applied_voltage(m: np.ndarray, k: int, wanted: float, effectiveness: float, stuck: float) -> float:
    """Voltage that reaches the motor: the drive's limit first, then its faults."""
    limit = m[VOLTAGE_LIMIT, k]
    return effectiveness * min(max(wanted, -limit), limit) + stuck


@kernel
def advance_motor(m: np.ndarray, state: np.ndarray, k: int, dt: float, voltage: np.ndarray, torque: np.ndarray) -> None:
    """One step of motor k; ``voltage`` (U + d2) and ``torque`` (d1) at start, middle and end, shape (3,)."""
    w0, i0 = state[SPEED, k], state[CURRENT, k]
    half = 0.5 * dt
    w1 = shaft_acceleration(m, k, w0, i0, torque[0])
    i1 = current_rate(m, k, w0, i0, voltage[0])
    w2 = shaft_acceleration(m, k, w0 + half * w1, i0 + half * i1, torque[1])
    i2 = current_rate(m, k, w0 + half * w1, i0 + half * i1, voltage[1])
    w3 = shaft_acceleration(m, k, w0 + half * w2, i0 + half * i2, torque[1])
    i3 = current_rate(m, k, w0 + half * w2, i0 + half * i2, voltage[1])
    w4 = shaft_acceleration(m, k, w0 + dt * w3, i0 + dt * i3, torque[2])
    i4 = current_rate(m, k, w0 + dt * w3, i0 + dt * i3, voltage[2])
    state[SPEED, k] = w0 + dt / 6.0 * (w1 + 2.0 * (w2 + w3) + w4)
    state[CURRENT, k] = i0 + dt / 6.0 * (i1 + 2.0 * (i2 + i3) + i4)


@kernel
def thrust(m: np.ndarray, state: np.ndarray, effectiveness: np.ndarray, stuck: np.ndarray) -> float:
    """Delivered thrust of all motors, N."""
    total = 0.0
    for k in range(state.shape[1]):
        total += m[THRUST_COEFFICIENT, k] * (effectiveness[k] * signed_square(state[SPEED, k]) + stuck[k])
    return total
