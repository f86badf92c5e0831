"""The hanging cable in heave: an elastic bar with a damped mass at its end, in closed form.

With u(x,t) = Re U(x) e^{i w t} the motion beyond the static stretch, zeta = 1 at the sheave, M = m + A_z, the body's
linear damping k, the cable's c per metre and the loss factor h of its material::

    E U'' = -(rho w^2 - i w c) U,    U(0) = 1,    E U'(l) = (w^2 M - i w k) U(l),    E = EA (1 + i h)

The dynamic tension is -E U', x counting down from the sheave. Drag D |u| u of a body that moves with u = mean +
Gaussian is replaced by the damping k with the least mean square error, k = 2 D E|u|; without a mean that is
D sqrt(8/pi) sigma. sigma depends on k, so k is a root. Source: textbook, rod with an end mass; compared in
``umbilical verify`` with lumped masses.
"""

from __future__ import annotations

from collections.abc import Callable
from math import erf, exp, pi, sqrt
from typing import Any, NamedTuple

import numpy as np


class Bar(NamedTuple):
    """What moves up and down.

    Attributes:
        stiffness: EA, N.
        line_density: dry, kg/m.
        mass: m + A_z, kg.
        length: m.
        loss_factor: h of the material.
        shared_damping: damping of the cable per metre over that of the body, 1/m.
    """

    stiffness: float
    line_density: float
    mass: float
    length: float
    loss_factor: float = 0.0
    shared_damping: float = 0.0

    @property
    def speed(self) -> float:
        """Speed of axial waves, m/s."""
        return float(np.sqrt(self.stiffness / self.line_density))


class HeaveTransfer(NamedTuple):
    """Complex amplitudes per metre of the sheave's heave, shape (dampings, frequencies).

    Attributes:
        body: heave of the body, m/m.
        end, top: dynamic tension at the body and at the sheave, N/m.
        wave_number: of axial waves, 1/m.
        impedance: E times the wave number, N/m.
    """

    body: np.ndarray
    end: np.ndarray
    top: np.ndarray
    wave_number: np.ndarray
    impedance: np.ndarray

    def tension_at(self, x: float) -> np.ndarray:
        """Dynamic tension x metres below the sheave, N/m."""
        return self.top * np.cos(self.wave_number * x) - self.impedance * np.sin(self.wave_number * x)


def heave_transfer(bar: Bar, damping: np.ndarray, omega: np.ndarray) -> HeaveTransfer:
    """Answer of cable and body to the heave of the sheave.

    Args:
        bar: cable and body.
        damping: linear damping of the body, N s/m, shape (dampings,).
        omega: angular frequencies above 0, rad/s, shape (frequencies,).

    >>> bar = Bar(2e7, 5.0, 8000.0, 3000.0)
    >>> answer = heave_transfer(bar, np.array([1.2e4]), np.array([0.5, 0.9]))
    >>> [float(round(a, 6)) for a in abs(answer.body[0])]
    [1.066136, 0.789406]
    """
    damping = np.asarray(damping, dtype=float)[:, None]
    stiffness = bar.stiffness * (1.0 + 1j * bar.loss_factor)
    along = bar.shared_damping * damping if bar.shared_damping else np.zeros((1, 1))  # one row serves all dampings
    wave_number = np.sqrt((omega**2 * bar.line_density - 1j * omega * along) / stiffness)
    cos, sin = np.cos(wave_number * bar.length), np.sin(wave_number * bar.length)
    impedance = stiffness * wave_number
    load = omega**2 * bar.mass - 1j * omega * damping
    sine = (load * cos + impedance * sin) / (impedance * cos - load * sin)
    body, end = cos + sine * sin, impedance * (sine * cos - sin)
    return HeaveTransfer(body, end, impedance * sine, wave_number, impedance)


def axial_period(bar: Bar) -> float:
    """Longest natural period T1 of the undamped bar, s: ``b tan b = rho l/M`` with ``b = w l/c``.

    >>> round(axial_period(Bar(2.6e7, 5.412, 17000.0, 1500.0)), 2)
    6.71
    """
    from scipy.optimize import brentq  # slow to import

    ratio = bar.line_density * bar.length / bar.mass
    root: Any = brentq(lambda b: b * np.sin(b) - ratio * np.cos(b), 0.0, np.pi / 2.0, xtol=1e-14)
    return float(2.0 * np.pi * bar.length / (bar.speed * root))


def equivalent_damping(quadratic: float, mean: float, rms: float) -> float:
    """Damping with the least mean square error, 2 D E|u| for u Gaussian with this mean and rms, N s/m.

    >>> round(equivalent_damping(4500.0, 0.0, 0.5) / (4500.0 * 0.5), 6)
    1.595769
    """
    if rms <= 0.0:
        return 2.0 * quadratic * abs(mean)
    ratio = mean / rms
    spread_part = rms * sqrt(2.0 / pi) * exp(-(ratio**2) / 2.0)
    return 2.0 * quadratic * (spread_part + mean * erf(ratio / sqrt(2.0)))


def linearised_damping(quadratic: float, mean: float, rms: Callable[[float], float]) -> float:
    """Solve ``k = 2 D E|u|`` for the damping, N s/m; ``rms`` gives the body's velocity, m/s, under a damping."""
    if quadratic == 0.0:
        return 0.0
    from scipy.optimize import brentq  # slow to import

    largest = 1.0 + equivalent_damping(quadratic, mean, 100.0)
    found: Any = brentq(lambda k: k - equivalent_damping(quadratic, mean, rms(k)), 0.0, largest, xtol=1e-6)
    return float(found)


def mean_drag(quadratic: float, mean: float, rms: float) -> float:
    """D E[|u| u], N: what steady motion through the water takes from the tension, more of it in waves."""
    if rms <= 0.0:
        return quadratic * abs(mean) * mean
    ratio = mean / rms
    odd = (1.0 + ratio**2) * erf(ratio / sqrt(2.0)) + ratio * sqrt(2.0 / pi) * exp(-(ratio**2) / 2.0)
    return quadratic * rms**2 * odd
