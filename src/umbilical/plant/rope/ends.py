"""Both ends of the cable: the sheave on the vessel, and the body.

At the vessel the cable's velocity is W* = r_v' + v p*: what is paid out enters with the stretch p* that belongs to the
tension G* (|p*| = 1 where it is slack); what is hauled in leaves with the stretch it has. G* = G + Z (W - W*).
At the body W* = V and G* = G + Z (V - W), which never pushes: a negative part along the cable is dropped, and a node
that is slack has no impedance along the cable.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.rope.fluxes import impedance_across
from umbilical.plant.rope.records import GRID, VESSEL, RopeConstants, RopeEnds, RopeOutside

PASSES = 2
"""Of the fixed point between entering stretch and tension, whose error falls by v/c in each."""


@kernel
def enter_stretch(rope: RopeConstants, ends: RopeEnds, tx: float, ty: float, tz: float) -> None:
    """p* of the cable that is paid out, from G*: along the tension if it pulls, else unstretched along the cable."""
    gx, gy, gz = ends.top_pull[0], ends.top_pull[1], ends.top_pull[2]
    if gx * tx + gy * ty + gz * tz > 0.0:
        size = sqrt(gx * gx + gy * gy + gz * gz)
        per = (1.0 + size / rope.stiffness) / size
        tx, ty, tz = per * gx, per * gy, per * gz
    ends.entering_stretch[0], ends.entering_stretch[1], ends.entering_stretch[2] = tx, ty, tz


@kernel
def meet_vessel(
    rope: RopeConstants, x: np.ndarray, pull: np.ndarray, stretch: np.ndarray, star: np.ndarray, power: np.ndarray,
    outside: RopeOutside, ends: RopeEnds,
) -> None:  # fmt: skip
    """W*, G* and p* at the sheave."""
    n = stretch.shape[1]
    speed, per = outside.payout_speed, 1.0 / (stretch[0, 0] * outside.length)
    tx, ty, tz = per * x[0, 0], per * x[0, n], per * x[0, 2 * n]
    along, across = sqrt(rope.stiffness * rope.density), impedance_across(rope, stretch[0, 0])
    for i in range(3):
        ends.entering_stretch[i] = x[0, i * n] / outside.length
    for _ in range(PASSES if speed > 0.0 else 1):
        wx = x[0, 3 * n] - outside.vessel_speed[0] - speed * ends.entering_stretch[0]
        wy = x[0, 4 * n] - outside.vessel_speed[1] - speed * ends.entering_stretch[1]
        wz = x[0, 5 * n] - outside.vessel_speed[2] - speed * ends.entering_stretch[2]
        more = (along - across) * (wx * tx + wy * ty + wz * tz)
        ends.top_pull[0] = pull[0, 0] + across * wx + more * tx
        ends.top_pull[1] = pull[0, n] + across * wy + more * ty
        ends.top_pull[2] = pull[0, 2 * n] + across * wz + more * tz
        if speed > 0.0:
            enter_stretch(rope, ends, tx, ty, tz)
    lost, moving, done, stretched = 0.0, 0.0, 0.0, 0.0
    for i in range(3):
        entering = ends.entering_stretch[i]
        ends.top_velocity[i] = outside.vessel_speed[i] + speed * entering
        star[i, 0], star[3 + i, 0] = ends.top_velocity[i], ends.top_pull[i]
        lost += (ends.top_pull[i] - pull[0, i * n]) * (x[0, (3 + i) * n] - ends.top_velocity[i])
        done += ends.top_pull[i] * ends.top_velocity[i]
        moving += ends.top_velocity[i] ** 2 if speed > 0.0 else x[0, (3 + i) * n] ** 2
        stretched += entering * entering
    strain = max(sqrt(stretched) - 1.0, 0.0)
    power[VESSEL] = -done + 0.5 * speed * (rope.stiffness * strain * strain + rope.density * moving)
    power[GRID] -= lost


@kernel
def meet_body(
    rope: RopeConstants, x: np.ndarray, pull: np.ndarray, stretch: np.ndarray, star: np.ndarray, power: np.ndarray,
    body: np.ndarray, ends: RopeEnds, length: float,
) -> None:  # fmt: skip
    """W* and G* at the body; ``body`` is its velocity, shape (3,)."""
    n = stretch.shape[1]
    last, per = n - 1, 1.0 / (stretch[4, n - 1] * length)
    tx, ty, tz = per * x[4, last], per * x[4, n + last], per * x[4, 2 * n + last]
    wx, wy, wz = body[0] - x[4, 3 * n + last], body[1] - x[4, 4 * n + last], body[2] - x[4, 5 * n + last]
    across = impedance_across(rope, stretch[4, last])
    along = sqrt(rope.stiffness * rope.density) if stretch[4, last] > 1.0 else 0.0
    w_along = wx * tx + wy * ty + wz * tz
    g_along = pull[4, last] * tx + pull[4, n + last] * ty + pull[4, 2 * n + last] * tz
    more = max((along - across) * w_along, -g_along - across * w_along)
    ends.end_pull[0] = pull[4, last] + across * wx + more * tx
    ends.end_pull[1] = pull[4, n + last] + across * wy + more * ty
    ends.end_pull[2] = pull[4, 2 * n + last] + across * wz + more * tz
    for i in range(3):
        star[i, n], star[3 + i, n] = body[i], ends.end_pull[i]
    power[GRID] -= across * (wx * wx + wy * wy + wz * wz) + more * w_along
