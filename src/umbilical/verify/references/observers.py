"""Exact responses of the observers' continuous equations, eqs. (17), (21), (61), to simple inputs."""

from __future__ import annotations

import numpy as np


def high_gain_step(time_constant: float, damping: float, t: np.ndarray) -> np.ndarray:
    """Estimate of the derivative after a unit step of the signal, 1/s: the pulse of ``s/(eps^2 s^2 + lam eps s + 1)``.

    ``exp(-lam t/(2 eps)) sin(q t/eps)/(q eps)``, for damping 2, where q = 0, ``t/eps^2 exp(-t/eps)``.
    """
    eps, half = time_constant, damping / 2.0
    q = np.sqrt(1.0 - half * half)
    return np.exp(-half * t / eps) * np.sinc(q * t / eps / np.pi) * t / eps**2


def high_gain_transfer(time_constant: float, damping: float, frequency: float, period: float) -> complex:
    """``s/(eps^2 s^2 + lam eps s + 1)`` of a sine that is held at its sample over the period *before* it.

    The samples of a held sine see all its images, too, s + 2 pi i n/period; their sum is the exact answer.
    """
    s = 1j * frequency
    image = s + 2j * np.pi * np.arange(-4000, 4001) / period
    seen = 1.0 / (time_constant**2 * image**2 + damping * time_constant * image + 1.0)
    return complex(np.expm1(s * period) / period * seen.sum())


def first_order(gain: float, t: np.ndarray) -> np.ndarray:
    """``1 - exp(-k t)``: what an observer with ``D^' = k (D - D^)`` has found of a constant."""
    return 1.0 - np.exp(-gain * t)


def first_order_transfer(gain: float, frequency: float) -> complex:
    """``k/(s + k)``."""
    return gain / (1j * frequency + gain)
