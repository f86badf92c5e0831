"""One motor of eq. (15) under a constant voltage, integrated to twelve digits, and its closed forms."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from umbilical.verify.references import integrated

Motor = Mapping[str, float]
"""Constants of eq. (15) by the names of the scenario."""


def steady_state(motor: Motor, voltage: float) -> tuple[float, float]:
    """Speed and current that stay: ``w = sgn(G) (-b + sqrt(b^2 + 4 K_Q |G|))/(2 K_Q)``, ``G = K_t U/R``."""
    g = motor["torque_constant"] * voltage / motor["resistance"]
    b = motor["viscous_friction"] + motor["torque_constant"] * motor["back_emf_constant"] / motor["resistance"]
    k = motor["load_coefficient"]
    speed = np.sign(g) * (-b + np.sqrt(b * b + 4.0 * k * abs(g))) / (2.0 * k)
    return float(speed), float((voltage - motor["back_emf_constant"] * speed) / motor["resistance"])


def driven_motor(motor: Motor, voltage: float, start: tuple[float, float], t: np.ndarray) -> np.ndarray:
    """Speed and current, shape (2, t), from ``start`` under a constant voltage, by DOP853 at 1e-12.

    Raises:
        CaseError: scipy gave up, or the state is not finite.
    """
    m = motor

    def rates(_: float, state: np.ndarray) -> tuple[float, float]:
        w, i = state
        torque = m["torque_constant"] * i - m["viscous_friction"] * w - m["load_coefficient"] * abs(w) * w
        return torque / m["inertia"], (voltage - m["resistance"] * i - m["back_emf_constant"] * w) / m["inductance"]

    return integrated(rates, start, t, method="DOP853", rtol=1e-12, atol=1e-12, max_step=1e-3)


def linear_step(motor: Motor, speed: float, change: float, t: np.ndarray) -> np.ndarray:
    """Change of the speed, rad/s, after a small change of the voltage, of eq. (15) linearised at a speed."""
    brake = motor["viscous_friction"] + 2.0 * motor["load_coefficient"] * abs(speed)
    stored = np.array([[motor["inertia"]], [motor["inductance"]]])
    matrix = (
        np.array([[-brake, motor["torque_constant"]], [-motor["back_emf_constant"], -motor["resistance"]]]) / stored
    )
    final = np.linalg.solve(matrix, [0.0, -change / motor["inductance"]])
    poles, modes = np.linalg.eig(matrix)
    remaining = modes @ (np.exp(np.multiply.outer(poles, t)) * np.linalg.solve(modes, final)[:, None])
    return final[0] - remaining[0].real


def without_inductance(motor: Motor, voltage: float, t: np.ndarray) -> np.ndarray:
    """Speed from rest as L -> 0: ``J w' = G - b w - K_Q w^2``, a tanh."""
    b = motor["viscous_friction"] + motor["torque_constant"] * motor["back_emf_constant"] / motor["resistance"]
    g, k = motor["torque_constant"] * voltage / motor["resistance"], motor["load_coefficient"]
    root = np.sqrt(b * b / 4.0 + k * g)
    return (root * np.tanh(root * t / motor["inertia"] + np.arctanh(b / 2.0 / root)) - b / 2.0) / k
