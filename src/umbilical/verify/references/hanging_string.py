"""The hanging string with a mass at its free end, in closed form.

With s up from the ROV, ``T = W + q s`` (in air ``W = m g``, ``q = rho g``) and ``z(s) = 2 w sqrt(rho T)/q``, eq. (6)
without damping has the solutions ``J0(z)`` and ``Y0(z)``. The ROV's ``T Y_s = (-m w^2 + i c w) Y`` is
``Y_z = -(m w - i c)/sqrt(rho W) Y``; in air and undamped the factor is z/2 and the two terms make a J2: "Frequencies of
a hanging chain supporting an end mass".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import mpmath
import numpy as np
from scipy.special import jv, yv

from umbilical.verify.references import roots


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

    def argument(self, above: Any) -> Any:
        """z/w at a height above the ROV, s."""
        return 2.0 * np.sqrt(self.line_density * (self.weight + self.line_weight * above)) / self.line_weight

    def miss(self, w: Any, damping: float = 0.0, first: Any = jv, second: Any = yv) -> Any:
        """``Y_z + (m w - i c)/sqrt(rho W) Y`` at the ROV of the shape that is 0 at the vessel, by Bessel functions."""
        z0, z1 = (float(self.argument(above)) * w for above in (0.0, self.length))
        shape, bent = (first(n, z0) * second(0, z1) - second(n, z0) * first(0, z1) for n in (0, 1))
        load = self.mass * w - 1j * damping if damping else self.mass * w
        return load / float(np.sqrt(self.line_density * self.weight)) * shape - bent


def _exact(string: HangingString, near: Any, damping: float = 0.0, digits: int = 30) -> Any:
    """The root next to one, by mpmath."""
    with mpmath.workdps(digits):
        return mpmath.findroot(lambda w: w * string.miss(w, damping, mpmath.besselj, mpmath.bessely), near)


def frequencies(string: HangingString, count: int) -> np.ndarray:
    """Roots w, rad/s, to 15 digits."""
    return np.array([float(_exact(string, root)) for root in _scanned(string, count).tolist()])


def _scanned(string: HangingString, count: int) -> np.ndarray:
    """The roots in double precision, none left out: their distance tends to ``pi/(top - foot)``."""
    distance = np.pi / (string.argument(string.length) - string.argument(0.0))
    grid = np.concatenate([np.geomspace(1e-4, 0.02, 200), np.arange(0.03, count + 2.0, 0.02)]) * distance
    return roots(string.miss, grid, count)


def mode_shape(string: HangingString, frequency: float, above: Any) -> np.ndarray:
    """Y at heights above the ROV, 1 at the ROV: ``J0(z) Y0(z1) - Y0(z) J0(z1)``."""
    z = frequency * string.argument(np.append(above, [0.0, string.length]))
    shape = jv(0, z) * yv(0, z[-1]) - yv(0, z) * jv(0, z[-1])
    return shape[:-2] / shape[-2]


def steady_tension_frequencies(string: HangingString, count: int) -> np.ndarray:
    """The same under ``T = m g`` everywhere: ``cot b = (m/(rho l)) b`` with ``b = w l/c``."""
    ratio = string.mass / (string.line_density * string.length)
    speed = np.sqrt(string.mass * string.gravity / string.line_density)
    found = roots(lambda b: np.cos(b) - ratio * b * np.sin(b), np.arange(count + 1) * np.pi + 1e-9, count)
    return found * speed / string.length


def damped_poles(string: HangingString, tip_damping: float, count: int, stages: int = 5) -> np.ndarray:
    """Poles, 1/s, with a damper at the ROV.

    Followed from the undamped ones while the damper grows, so that none is left out or found twice. A mode that is
    overdamped in the end, which has left the upper half plane, does not count.
    """
    found = list(frequencies(string, count + 1))
    for damping in tip_damping * np.arange(1, stages + 1) / stages:
        found = [_exact(string, near, damping, 20) for near in found]
    poles = 1j * np.array(found, dtype=complex)
    upper = poles[np.imag(poles) > 1e-9]
    return upper[np.argsort(np.imag(upper))][:count]


def static_shape(string: HangingString, force: float, sigma: np.ndarray) -> np.ndarray:
    """Deflection, m, under a steady force on the ROV: ``P/q ln(T_0/T)``."""
    foot, gained = string.weight, string.line_weight * string.length
    return force / string.line_weight * np.log((foot + gained) / (foot + gained * (1.0 - sigma)))


def _modes(string: HangingString, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frequencies, rad/s, and with phi 1 at the ROV ``int rho phi^2 ds + m`` and ``int rho phi ds + m``."""
    points, weights = np.polynomial.legendre.leggauss(240)
    weights = 0.5 * string.length * string.line_density * weights
    found = _scanned(string, count)
    shapes = np.array([mode_shape(string, w, 0.5 * string.length * (points + 1.0)) for w in found])
    return found, shapes**2 @ weights + string.mass, shapes @ weights + string.mass


def released_tip(string: HangingString, force: float, t: np.ndarray, count: int = 80) -> np.ndarray:
    """y(l,t), m, undamped, released from rest under ``force``: the sum of ``P phi^2 cos(w t)/(w^2 M)``."""
    frequency, inertia, _ = _modes(string, count)
    return np.cos(np.multiply.outer(t, frequency)) @ (force / (frequency**2 * inertia))


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
    half, tip = 0.5 * float(t[1] - t[0]), np.zeros_like(t)
    inside = t[:-1, None] + half * (points + 1.0)
    pushed = acceleration(inside) * half * weights
    for frequency, inertia, share in zip(*_modes(string, count), strict=True):
        # q' + i w q turns at w and takes up -e'' int rho phi/M on the way.
        taken = -(pushed * np.exp(-1j * frequency * inside)).sum(axis=1) * share / inertia
        turning = np.append(0.0, np.cumsum(taken)) * np.exp(1j * frequency * t)
        tip += np.imag(turning) / frequency
    return tip
