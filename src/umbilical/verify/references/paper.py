"""What one writes without this package: the paper's closed loop in plain numpy, handed to scipy.

Method of lines on xi = x/l with second-order differences, continuous control law, all numbers typed in. Nothing of
the package is used, so it is a yardstick for time and, at the accuracy of its grid, an independent answer.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from umbilical.verify.references import integrated

Array = np.ndarray
N = 100  # intervals along the cable
RHO, MASS, DAMPING, TIP_DAMPING, GRAVITY = 2.0, 500.0, 0.001, 0.001, 10.0
J, B, K_T, K_Q, R, L, K_B = 0.5, 0.015, 4.0, 1.0, 0.08, 0.002, 0.5
THRUST = np.array([1.2, 0.8])
K_A, BETA, EPS, LAM, K_S, VS = 1e4, 0.01, 0.005, 2.0, 5.0, 1.0
K1, K2, MU, E0, E02, DB1, DB2, G_O, W_C, SOFT = 50.0, 500.0, 1.5, 0.1, 2.0, 4.0, 120.0, 100.0, 200.0, 1e-3
F11, F12, F13, F21, F22, F23 = -B / J, -K_Q / J, 1 / J, -K_T * K_B / (J * L), -R / L, K_T / (J * L)
XI = np.linspace(0.0, 1.0, N + 1)
MIDDLE = 0.5 * (XI[1:] + XI[:-1])


def winch(t: float) -> tuple[float, float, float]:
    """Length, speed, acceleration: 450 m to 500 m in 50 s."""
    q = min(max(t / 50.0, 0.0), 1.0)
    rate = (30 * q**2 - 60 * q**3 + 30 * q**4) / 50.0
    return 450 + 50 * (10 * q**3 - 15 * q**4 + 6 * q**5), 50 * rate, 50 * (60 * q - 180 * q**2 + 120 * q**3) / 2500.0


def payload_force(t: float) -> float:
    """External force on the ROV, N."""
    return 100 + 50 * np.sin(0.7 * t) + 30 * np.sin(0.5 * t) + 20 * np.sin(0.9 * t)


def motor_disturbances(t: float) -> tuple[Array, Array]:
    """Torque, N m, and voltage, V, of both motors."""
    both = np.array([np.sin(20 * t), 1 / (1 + ((t - 25) / 8) ** 4)])
    return both, 0.2 * both


def commanded_thrust(x1: float, z1: float, tension: float, s: Array) -> tuple[float, Array]:
    """Commanded thrust, and the rates of pi1, pi2, chi1, chi2, phi: (17), (19), (21), (22)."""
    pi1, pi2, chi1, chi2, phi = s
    x2, z2 = pi2 / EPS, chi2 / EPS
    error, known = x2 + BETA * z1, tension * z1 + TIP_DAMPING * x2
    estimate = phi + K_S * MASS * x2
    thrust = -K_A * error - BETA * MASS * z2 + known - estimate
    observers = [pi2, -LAM * pi2 - pi1 + x1, chi2, -LAM * chi2 - chi1 + z1]
    return thrust, np.array([*(rate / EPS for rate in observers), K_S * (VS * error + known - thrust - estimate)])


def motor_loops(thrust: float, w: Array, i: Array, f: Array, ups: Array) -> tuple[Any, ...]:
    """Voltages, and the rates of the command filters and of the motor observers: (52)-(64)."""
    demand = thrust / THRUST.sum()
    root = demand / (demand**2 + SOFT**2) ** 0.25
    z1, z2 = w, K_T / J * i
    z1_rate = z2 + F11 * z1 + F12 * z1 * abs(z1)
    e1, e1_rate = z1 - f[0], z1_rate - f[1]
    soft = np.sqrt(e1**2 + E0**2)
    wanted = -K1 * e1 - F11 * z1 - F12 * z1 * abs(z1) - DB1 * MU * e1 / soft + f[1]
    wanted_rate = -K1 * e1_rate - F11 * z1_rate - 2 * F12 * abs(z1) * z1_rate
    wanted_rate += -DB1 * MU * E0**2 * e1_rate / soft**3 + f[2]
    e2 = z2 - wanted
    drive = -K2 * e2 - e1 - F21 * z1 - F22 * z2 - DB2 * MU * e2 / np.sqrt(e2**2 + E02**2) + wanted_rate
    drive = drive - (ups + G_O * z2)
    ups_rate = -G_O * ups - G_O * (G_O * z2 + F21 * z1 + F22 * z2 + drive)
    f_rate = np.array([f[1], f[2], W_C**3 * (root - f[0]) - 3 * W_C**2 * f[1] - 3 * W_C * f[2]])
    return drive / F23, f_rate, ups_rate


def rates_of_motors(w: Array, i: Array, voltage: Array, disturbances: tuple[Array, Array]) -> tuple[Array, Array]:
    """Rates of speeds and currents under torques, N m, and voltages, V, from outside: (15)."""
    torque, extra = disturbances
    return (K_T * i - B * w - K_Q * abs(w) * w + torque) / J, (-R * i - K_B * w + voltage + extra) / L


def controlled(tip: float, slope: float, tension: float, tail: Array) -> tuple[Array, list[Array]]:
    """Voltages, and the rates of the outer observers, the filters and the motors' observers.

    Args:
        tip, slope, tension: y(l), m, y_x(l) and T(l), N.
        tail: speeds, currents, outer observers, filters and motor observers, shape (17,).
    """
    thrust, observer_rates = commanded_thrust(tip, slope, tension, tail[4:9])
    voltage, filter_rates, ups_rate = motor_loops(thrust, tail[0:2], tail[2:4], tail[9:15].reshape(3, 2), tail[15:17])
    return voltage, [observer_rates, filter_rates.ravel(), ups_rate]


def loop_rates(t: float, state: Array) -> Array:
    """Time derivative of y and Dy/Dt at nodes 1 to N, motors, observers, filters."""
    length, v, a = winch(t)
    h = length / N
    y, w = np.concatenate([[0.0], state[:N]]), np.concatenate([[0.0], state[N : 2 * N]])
    tail = state[2 * N :]
    speed, current = tail[0:2], tail[2:4]
    w[0] = v * (4 * y[1] - y[2]) / (2 * h)
    pull = (MASS + RHO * length * (1 - MIDDLE)) * (GRAVITY - a) * np.diff(y) / h
    slope = (3 * y[N] - 4 * y[N - 1] + y[N - 2]) / (2 * h)

    voltage, control_rates = controlled(y[N], slope, MASS * (GRAVITY - a), tail)
    motors = rates_of_motors(speed, current, voltage, motor_disturbances(t))

    y_rate, w_rate = w.copy(), np.empty(N + 1)
    carried = v * (1 - XI[1:N]) / (2 * h)
    y_rate[1:N] -= carried * (y[2:] - y[:-2])
    w_rate[1:N] = np.diff(pull) / (RHO * h) - DAMPING / RHO * w[1:N] - carried * (w[2:] - w[:-2])
    delivered = THRUST @ (abs(speed) * speed)
    # The last half interval of cable moves with the ROV: second order, and no one-sided difference in the balance.
    load = -pull[-1] - TIP_DAMPING * w[N] - DAMPING * h / 2 * w[N] + payload_force(t) + delivered
    w_rate[N] = load / (MASS + RHO * h / 2)
    return np.concatenate([y_rate[1:], w_rate[1:], *motors, *control_rates])


def displacement(times: Array) -> Array:
    """y at increasing instants from 0 and N + 1 nodes from vessel to ROV, m, from a straight cable at rest.

    Raises:
        CaseError: scipy gave up, or the state is not finite.
    """
    found = integrated(loop_rates, np.zeros(2 * N + 17), times, rtol=1e-6, atol=1e-9)
    return np.concatenate([np.zeros((1, times.size)), found[:N]]).T
