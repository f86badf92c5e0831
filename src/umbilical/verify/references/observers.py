"""Exact responses of the observers' continuous equations, eqs. (17), (21), (61), to simple inputs."""

from __future__ import annotations

import numpy as np


def high_gain_step(time_constant: float, damping: float, t: np.ndarray) -> np.ndarray:
    """Estimate of the derivative after a unit step of the signal, 1/s: the pulse of ``s/(eps^2 s^2 + lam eps s + 1)``.

    For damping 2, ``t/eps^2 exp(-t/eps)``; below it, ``exp(-lam t/(2 eps)) sin(q t/eps)/(q eps)``.
    """
    eps, half = time_constant, damping / 2.0
    if damping == 2.0:
        return t / eps**2 * np.exp(-t / eps)
    q = np.sqrt(1.0 - half * half)
    return np.exp(-half * t / eps) * np.sin(q * t / eps) / (q * eps)


def high_gain_transfer(time_constant: float, damping: float, frequency: float, period: float) -> complex:
    """``s/(eps^2 s^2 + lam eps s + 1)`` of a sine that is held at its sample over the period *before* it."""
    s = 1j * frequency
    hold = (1.0 - np.exp(-s * period)) / (s * period) * np.exp(s * period)
    # The samples of a held sine see all its images, too, s + 2 pi i n/period; their sum is the exact answer.
    total = 0.0 + 0.0j
    for n in range(-4000, 4001):
        image = s + 2j * np.pi * n / period
        shape = image / (time_constant**2 * image**2 + damping * time_constant * image + 1.0)
        total += shape * (hold * s / image if n else hold)
    return total


def first_order(gain: float, t: np.ndarray) -> np.ndarray:
    """``1 - exp(-k t)``: what an observer with ``D^' = k (D - D^)`` has found of a constant."""
    return 1.0 - np.exp(-gain * t)


def first_order_transfer(gain: float, frequency: float) -> complex:
    """``k/(s + k)``."""
    return gain / (1j * frequency + gain)
