"""Regular waves of Airy: dispersion, and the orbital velocity under the surface."""

from __future__ import annotations

import numpy as np


def wave_number(omega: np.ndarray | float, gravity: float = 9.81, water_depth: float = np.inf) -> np.ndarray:
    """Solve ``w^2 = g k tanh(k h)`` for k, 1/m.

    Args:
        omega: angular frequencies above 0, rad/s, any shape.
        gravity: m/s2.
        water_depth: h, m; infinite for deep water, k = w^2/g.

    >>> float(np.round(wave_number(np.array([0.5]), water_depth=30.0), 5)[0])
    0.03342
    """
    omega = np.asarray(omega, dtype=float)
    deep = omega**2 / gravity
    if np.isinf(water_depth):
        return deep
    start = deep / np.sqrt(np.tanh(deep * water_depth))  # Eckart: within 5 %
    from scipy.optimize import newton  # slow to import

    return np.asarray(newton(lambda k: gravity * k * np.tanh(k * water_depth) - omega**2, start))


def orbital_velocity(
    omega: np.ndarray | float, height: np.ndarray | float, gravity: float = 9.81, water_depth: float = np.inf
) -> np.ndarray:
    """Amplitude of the horizontal orbital velocity per metre of wave amplitude, 1/s.

    Args:
        omega: angular frequencies, rad/s.
        height: z, m, at most 0; the surface is 0. Broadcast against ``omega``.
        gravity: m/s2.
        water_depth: m.

    >>> period = 2.0 * np.pi / 8.0
    >>> float(np.round(orbital_velocity(period, -20.0) / period, 3))
    0.284
    """
    k, omega = wave_number(omega, gravity, water_depth), np.asarray(omega, dtype=float)
    if np.isinf(water_depth):
        return omega * np.exp(k * height)
    return omega * np.cosh(k * (height + water_depth)) / np.sinh(k * water_depth)
