"""Where elements meet: velocity and tension of the waves that run into the interface, along and across the cable.

With [.] = right - left, the impedances Z_t = sqrt(rho EA) along the cable, slack or not, and Z_n = sqrt(M N/|r_x|)
across it, M = rho + rho_a::

    W* = {W} + [G]/(2 Z),   G* = {G} + Z [W]/2        G = N t

A jump takes ([G]^2/Z + Z [W]^2)/2 from the energy, whatever the law of the material (docs/rope.md).
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.rope.records import GRID, RopeConstants

LEAST_TENSION = 1.0
"""N; the impedance across the cable is that of at least this tension, so that it does not vanish in slack."""


@kernel
def impedance_across(rope: RopeConstants, stretch: float) -> float:
    """Z_n, kg/s."""
    tension = max(rope.stiffness * (stretch - 1.0), LEAST_TENSION)
    return sqrt((rope.density + rope.added) * tension / stretch)


@kernel
def meet_elements(
    rope: RopeConstants, x: np.ndarray, pull: np.ndarray, stretch: np.ndarray, star: np.ndarray, power: np.ndarray
) -> None:
    """W and N t at the interfaces inside the cable into ``star``; the power they take is added to the grid's."""
    n = stretch.shape[1]
    along = sqrt(rope.stiffness * rope.density)
    lost = 0.0
    for f in range(1, n):
        a, b = f - 1, f
        tx, ty, tz = x[4, a] + x[0, b], x[4, n + a] + x[0, n + b], x[4, 2 * n + a] + x[0, 2 * n + b]
        size = 1.0 / sqrt(tx * tx + ty * ty + tz * tz + 1e-30)
        tx, ty, tz = tx * size, ty * size, tz * size
        across = impedance_across(rope, 0.5 * (stretch[4, a] + stretch[0, b]))
        ux, uy, uz = x[4, 3 * n + a], x[4, 4 * n + a], x[4, 5 * n + a]
        wx, wy, wz = x[0, 3 * n + b] - ux, x[0, 4 * n + b] - uy, x[0, 5 * n + b] - uz
        hx, hy, hz = pull[4, a], pull[4, n + a], pull[4, 2 * n + a]
        gx, gy, gz = pull[0, b] - hx, pull[0, n + b] - hy, pull[0, 2 * n + b] - hz
        w_along, g_along = tx * wx + ty * wy + tz * wz, tx * gx + ty * gy + tz * gz
        admit, extra = 0.5 / across, 0.5 * g_along * (1.0 / along - 1.0 / across)
        half, more = 0.5 * across, 0.5 * w_along * (along - across)
        star[0, f] = ux + 0.5 * wx + admit * gx + extra * tx
        star[1, f] = uy + 0.5 * wy + admit * gy + extra * ty
        star[2, f] = uz + 0.5 * wz + admit * gz + extra * tz
        star[3, f] = hx + 0.5 * gx + half * wx + more * tx
        star[4, f] = hy + 0.5 * gy + half * wy + more * ty
        star[5, f] = hz + 0.5 * gz + half * wz + more * tz
        lost += half * (wx * wx + wy * wy + wz * wz) + more * w_along
        lost += admit * (gx * gx + gy * gy + gz * gz) + extra * g_along
    power[GRID] -= lost
