"""A string in a current, shaken at its end: equivalent linearisation of quadratic drag, by finite differences.

Of ``|u - V cos| (u - V cos)``, a current u and a velocity of amplitude V across, the part at the frequency of V is
``-N V cos``, and the equivalent damping of ``k |u_r| u_r`` is ``k N(u, V)``::

    N = 2 |u|                                                           V <= |u|
    N = 2 V/pi (2 r asin r + 2/3 sqrt(1 - r^2) (2 + r^2)),  r = |u|/V   V > |u|

Without a current ``8 V/(3 pi)``. V differs along the cable, and is found by iteration. Higher harmonics are left out.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import solve_banded

Array = np.ndarray
_PIECES = 2000
_MOST, _CLOSE = 400, 1e-10


def equivalent(current: Array | float, velocity: Array | float) -> Array:
    """N, m/s, for a current and an amplitude of the velocity, m/s."""
    u, most = np.abs(current), np.maximum(velocity, 1e-12)
    r = np.minimum(u / most, 1.0)
    turns = 2.0 * most / np.pi * (2.0 * r * np.arcsin(r) + 2.0 / 3.0 * np.sqrt(1.0 - r * r) * (2.0 + r * r))
    return np.where(u >= most, 2.0 * u, turns)


class Shaken(NamedTuple):
    """A string held at x = 0 with a body at x = l, in water.

    Attributes:
        length: l, m.
        line: of a metre of it, inertia M, kg/m, weight w, N/m, damping c, N s/m2, drag ``1/2 rho_w C_dn d``, N s2/m3.
        body: m + A_h, kg, W, N, D_l, N s/m, and D_q, N s2/m2.
        current: at x = 0 and x = l, linear between, m/s.
    """

    length: float
    line: tuple[float, float, float, float]
    body: tuple[float, float, float, float]
    current: tuple[float, float]

    def response(self, force: float, frequency: float) -> complex:
        """Displacement of the body per newton, m/N, under ``Re force e^(i frequency t)``."""
        x = np.linspace(0.0, self.length, _PIECES + 1)
        current = np.interp(x, [0.0, self.length], self.current)
        velocity = np.zeros(x.size)
        found = last = np.zeros(x.size, dtype=complex)
        for _ in range(_MOST):
            found = self._shape(force, frequency, equivalent(current, velocity))
            if np.abs(found - last).max() < _CLOSE * np.abs(found).max():
                break
            last = 0.5 * (found + last) if last.any() else found
            velocity = frequency * np.abs(last)
        return complex(found[-1]) / force

    def _shape(self, force: float, frequency: float, slopes: Array) -> Array:
        """``(T Y')' = (-M w^2 + i w c) Y`` with ``T Y' + (-m w^2 + i w c_tip) Y = F`` at the body, c by ``slopes``."""
        h, w = self.length / _PIECES, frequency
        line_inertia, line_weight, line_damping, line_drag = self.line
        inertia, weight, damping, drag = self.body
        pull = weight + line_weight * h * (np.arange(_PIECES, 0, -1) - 0.5)
        along = -line_inertia * w * w + 1j * w * (line_damping + line_drag * slopes)
        body = -inertia * w * w + 1j * w * (damping + drag * slopes[-1])
        bands = np.zeros((3, _PIECES + 1), dtype=complex)
        bands[0, 2:], bands[2, :-1] = -pull[1:] / h, -pull / h
        bands[1, 0] = 1.0
        bands[1, 1:-1] = (pull[:-1] + pull[1:]) / h + along[1:-1] * h
        bands[1, -1] = pull[-1] / h + 0.5 * h * along[-1] + body
        bands[2, 0] = -pull[0] / h
        load = np.zeros(_PIECES + 1, dtype=complex)
        load[-1] = force
        return solve_banded((1, 1), bands, load)
