"""The hanging string with a mass at its free end, in closed form.

With s up from the ROV, ``T = W + q s`` (in air ``W = m g``, ``q = rho g``) and ``z(s) = 2 w sqrt(rho T)/q``, eq. (6)
without damping has the solutions ``J0(z)`` and ``Y0(z)``. The ROV's ``T Y_s = -m w^2 Y`` is
``Y_z = -m w/sqrt(rho W) Y``; in air the factor is z/2 and the two terms make a J2: "Frequencies of a hanging chain
supporting an end mass".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import mpmath
import numpy as np
from scipy.optimize import brentq
from scipy.special import jv, yv


class HangingString(NamedTuple):
    """Line density, kg/m; mass at the end, kg; length, m; gravity, m/s2; share of both weights that water leaves."""

    line_density: float = 2.0
    mass: float = 500.0
    length: float = 500.0
    gravity: float = 10.0
    weight_left: float = 1.0
    line_weight_left: float = 1.0

    @property
    def weight(self) -> float:
        """W of the mass at the end, N."""
        return self.weight_left * self.mass * self.gravity

    @property
    def line_weight(self) -> float:
        """q, N/m."""
        return self.line_weight_left * self.line_density * self.gravity

    @property
    def inertia(self) -> float:
        """m/sqrt(rho W), s."""
        return self.mass / float(np.sqrt(self.line_density * self.weight))

    def argument(self, above: Any) -> Any:
        """z/w at a height above the ROV, s."""
        return 2.0 * np.sqrt(self.line_density * (self.weight + self.line_weight * above)) / self.line_weight


def frequencies(string: HangingString, count: int) -> np.ndarray:
    """Roots w, rad/s, of ``Y_z + m w/sqrt(rho W) Y = 0`` at the ROV, Y 0 at the vessel, to 15 digits."""
    foot, top = float(string.argument(0.0)), float(string.argument(string.length))

    def equation(w: Any) -> Any:
        z0, z1 = foot * w, top * w
        first, second = (string.inertia * w * f(0, z0) - f(1, z0) for f in (mpmath.besselj, mpmath.bessely))
        return first * mpmath.bessely(0, z1) - second * mpmath.besselj(0, z1)

    with mpmath.workdps(30):
        return np.array([float(mpmath.findroot(equation, root)) for root in _scanned(string, count)])


def mode_shape(string: HangingString, frequency: float, above: np.ndarray) -> np.ndarray:
    """Y at heights above the ROV, 1 at the ROV: ``J0(z) Y0(z1) - Y0(z) J0(z1)``."""
    top = frequency * string.argument(string.length)

    def shape(z: Any) -> Any:
        return jv(0, z) * yv(0, top) - yv(0, z) * jv(0, top)

    return shape(frequency * string.argument(above)) / shape(frequency * string.argument(0.0))


def _scanned(string: HangingString, count: int) -> list[float]:
    """The roots in double precision, none left out: their distance tends to ``pi/(top - foot)``."""
    foot, top = float(string.argument(0.0)), float(string.argument(string.length))

    def equation(w: Any) -> Any:
        first, second = (string.inertia * w * f(0, foot * w) - f(1, foot * w) for f in (jv, yv))
        return first * yv(0, top * w) - second * jv(0, top * w)

    grid = np.concatenate([np.geomspace(1e-4, 0.02, 200), np.arange(0.03, count + 2.0, 0.02)]) * np.pi / (top - foot)
    values = equation(grid)
    brackets = np.flatnonzero(values[:-1] * values[1:] < 0.0)[:count]
    found: list[Any] = [brentq(equation, grid[k], grid[k + 1], xtol=1e-15) for k in brackets]
    return [float(root) for root in found]


def steady_tension_frequencies(string: HangingString, count: int) -> np.ndarray:
    """The same under ``T = m g`` everywhere: ``cot b = (m/(rho l)) b`` with ``b = w l/c``."""
    ratio = string.mass / (string.line_density * string.length)
    speed = np.sqrt(string.mass * string.gravity / string.line_density)
    roots = [
        brentq(lambda b: np.cos(b) - ratio * b * np.sin(b), k * np.pi + 1e-9, (k + 1) * np.pi - 1e-9, xtol=1e-14)
        for k in range(count)
    ]
    return np.array(roots) * speed / string.length


def damped_poles(string: HangingString, tip_damping: float, count: int, stages: int = 5) -> np.ndarray:
    """Roots of ``(m lam^2 + c_tip lam) Y + T Y_x = 0`` at the ROV with Y the string's shape at pole lam, 1/s.

    Followed from the undamped ones while the damper grows, so that none is left out or found twice. A mode that is
    overdamped in the end, which has left the upper half plane, does not count.
    """
    found = 1j * frequencies(string, count + 1)
    for stage in range(1, stages + 1):
        found = np.array([_damped_pole(string, tip_damping * stage / stages, near) for near in found])
    upper = found[np.imag(found) > 1e-9]
    return upper[np.argsort(np.imag(upper))][:count]


def _damped_pole(string: HangingString, tip_damping: float, near: complex) -> complex:
    foot, top = float(string.argument(0.0)), float(string.argument(string.length))

    def residue(lam: Any) -> Any:
        w = -1j * lam
        z0, z1 = foot * w, top * w

        def shape(order: int) -> Any:
            return mpmath.besselj(order, z0) * mpmath.bessely(0, z1) - mpmath.bessely(order, z0) * mpmath.besselj(0, z1)

        # dz/ds = 2 w^2 rho/(q z), s up from the ROV; J0' = -J1, and Y_x = -Y_s.
        slope = shape(1) * 2 * w * w * string.line_density / (string.line_weight * z0)
        return (string.mass * lam * lam + tip_damping * lam) * shape(0) + string.weight * slope

    with mpmath.workdps(20):
        return complex(mpmath.findroot(residue, near))


def static_shape(string: HangingString, force: float, sigma: np.ndarray) -> np.ndarray:
    """Deflection, m, under a steady force on the ROV: ``P/q ln(T_0/T)``."""
    foot, gained = string.weight, string.line_weight * string.length
    return force / string.line_weight * np.log((foot + gained) / (foot + gained * (1.0 - sigma)))


class _Mode(NamedTuple):
    """Frequency, rad/s; shape at the ROV; ``int rho phi^2 ds + m phi(0)^2`` and ``int rho phi ds + m phi(0)``."""

    frequency: float
    tip: float
    inertia: float
    share: float


def _modes(string: HangingString, count: int) -> list[_Mode]:
    points, weights = np.polynomial.legendre.leggauss(240)
    above = 0.5 * string.length * (points + 1.0)
    weights = 0.5 * string.length * string.line_density * weights
    found = []
    for w in _scanned(string, count):
        z = w * string.argument(np.append(above, [0.0, string.length]))
        shape = jv(0, z) * yv(0, z[-1]) - yv(0, z) * jv(0, z[-1])
        along, tip = shape[:-2], float(shape[-2])
        inertia, share = weights @ along**2 + string.mass * tip**2, weights @ along + string.mass * tip
        found.append(_Mode(w, tip, float(inertia), float(share)))
    return found


def released_tip(string: HangingString, force: float, t: np.ndarray, count: int = 80) -> np.ndarray:
    """y(l,t), m, undamped, released from rest under ``force``: the sum of ``P phi^2 cos(w t)/(w^2 M)``."""
    return sum(
        (force * m.tip**2 / (m.frequency**2 * m.inertia) * np.cos(m.frequency * t) for m in _modes(string, count)),
        start=np.zeros_like(t),
    )


def carried_tip(
    string: HangingString, acceleration: Callable[[np.ndarray], np.ndarray], t: np.ndarray, count: int = 60
) -> np.ndarray:
    """y(l,t) - e(t), m, undamped, from rest, with the vessel moving as e: ``q'' + w^2 q = -e'' int rho phi/M``.

    Args:
        string: what hangs.
        acceleration: e'', m/s2, over arrays of time.
        t: evenly spaced instants from 0, s; between them e'' is integrated by Gauss's rule.
        count: modes.
    """
    points, weights = np.polynomial.legendre.leggauss(3)
    step = float(t[1] - t[0])
    inside = t[:-1, None] + 0.5 * step * (points + 1.0)
    pushed = acceleration(inside) * 0.5 * step
    tip = np.zeros_like(t)
    for m in _modes(string, count):
        # q' + i w q turns at w and takes up -e'' int rho phi/M on the way.
        taken = -(pushed * np.exp(-1j * m.frequency * inside)) @ weights * m.share / m.inertia
        turning = np.concatenate([[0.0], np.cumsum(taken)]) * np.exp(1j * m.frequency * t)
        tip += m.tip * np.imag(turning) / m.frequency
    return tip
