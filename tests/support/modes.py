"""Modes of the hanging cable: from the engine's own step, and from the closed form in Bessel functions."""

from __future__ import annotations

from typing import Any

import mpmath
import numpy as np
from scipy.optimize import brentq
from scipy.special import jv, yv

from umbilical import Scenario
from umbilical.engine.linear import step_poles


def engine_poles(scenario: Scenario, count: int) -> np.ndarray:
    """The ``count`` slowest poles above the real axis, 1/s, of the engine's own step."""
    poles = step_poles(scenario)
    # Waves too short for the grid decay within a period or two: they belong to no mode of the cable.
    return poles[(poles.imag > 1e-9) & (poles.real > -0.3 * poles.imag)][:count]


def bessel_frequencies(
    line_density: float, mass: float, length: float, count: int, gravity: float = 10.0
) -> np.ndarray:
    """Roots w, rad/s, of ``J0(z1) Y2(z0) - Y0(z1) J2(z0) = 0``: hanging string with a free mass at its end.

    ``z0 = 2 w sqrt(m/(rho g))``, ``z1 = 2 w sqrt((m + rho l)/(rho g))``; scanned with scipy, polished with mpmath.
    """

    def scale(hanging: float) -> float:
        return 2.0 * float(np.sqrt((mass + hanging) / (line_density * gravity)))

    foot, top = scale(0.0), scale(line_density * length)

    def coarse(w: float) -> float:
        return float(jv(0, top * w) * yv(2, foot * w) - yv(0, top * w) * jv(2, foot * w))

    def fine(w: Any) -> Any:
        return mpmath.besselj(0, top * w) * mpmath.bessely(2, foot * w) - mpmath.bessely(0, top * w) * mpmath.besselj(
            2, foot * w
        )

    spacing = np.pi / (top - foot)  # of the higher roots
    grid = np.arange(0.02, count + 2.0, 0.02) * spacing
    values = [coarse(w) for w in grid]
    brackets = [k for k in range(grid.size - 1) if values[k] * values[k + 1] < 0.0][:count]
    roots = [brentq(coarse, grid[k], grid[k + 1], xtol=1e-15) for k in brackets]
    with mpmath.workdps(30):
        return np.array([float(mpmath.findroot(fine, root)) for root in roots])


def damped_pole(
    line_density: float, mass: float, length: float, tip_damping: float, near: complex, gravity: float = 10.0
) -> complex:
    """Root of ``(m lam^2 + c_tip lam) Y + T Y_x = 0`` at the ROV with Y the hanging string's shape at pole lam."""
    foot_scale = 2.0 * float(np.sqrt(mass / (line_density * gravity)))
    top_scale = 2.0 * float(np.sqrt((mass + line_density * length) / (line_density * gravity)))

    def residue(lam: Any) -> Any:
        w = -1j * lam
        z0, z1 = foot_scale * w, top_scale * w

        def shape(order: int) -> Any:
            return mpmath.besselj(order, z0) * mpmath.bessely(0, z1) - mpmath.bessely(order, z0) * mpmath.besselj(0, z1)

        # dz/ds = 2 w^2/(g z), s up from the ROV; J0' = -J1, and Y_x = -Y_s.
        slope = shape(1) * 2 * w * w / (gravity * z0)
        return (mass * lam * lam + tip_damping * lam) * shape(0) + mass * gravity * slope

    with mpmath.workdps(30):
        return complex(mpmath.findroot(residue, near))


def released_tip(
    force: float, line_density: float, mass: float, length: float, t: np.ndarray, gravity: float = 10.0, count: int = 80
) -> np.ndarray:
    """y(l,t), m, of the undamped cable released from rest under ``force``: sum of P phi_l^2 cos(wt)/(w^2 M)."""
    points, weights = np.polynomial.legendre.leggauss(600)
    above = 0.5 * length * (points + 1.0)
    tip = np.zeros_like(t)
    for w in bessel_frequencies(line_density, mass, length, count, gravity):
        z = 2.0 * w * np.sqrt((mass + line_density * np.append(above, [0.0, length])) / (line_density * gravity))
        shape = jv(0, z) * yv(0, z[-1]) - yv(0, z) * jv(0, z[-1])
        inertia = mass * shape[-2] ** 2 + line_density * 0.5 * length * (weights @ shape[:-2] ** 2)
        tip += force * shape[-2] ** 2 / (w * w * inertia) * np.cos(w * t)
    return tip
