"""Forces on the cable: weight, drag along and across, added mass with its sliding terms, linear damping, loads.

::

    rho a + F_a = (N t)_x + f + (rho_w A_c + rho_a P) u_t          a = DW/Dt,  P = 1 - t t^T
    F_a  = rho_a P [ a - 2 w_s W_x/|p| + w_s^2 t_x/|p| ],          w_s = (W - u) . t
    f    = -w z + k_n |u_n| u_n + k_t |u_t| u_t,                   u_n = P (u - W),  u_t = t t . (u - W)

P takes the sliding of the cable along itself out of u_n: payout needs no drag of its own.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.rope.operators import W as WEIGHTS
from umbilical.plant.rope.records import ADDED, DAMPING, DRAG, LOAD, WEIGHT, RopeConstants, RopeState


@kernel
def accelerate_dry(rope: RopeConstants, state: RopeState, length: float) -> None:
    """DW/Dt at the nodes into the second half of ``rate``, without water."""
    n = state.stretch.shape[1]
    per, loss = 1.0 / (rope.density * length), rope.damping / rope.density
    falling = rope.weight / rope.density
    for j in range(5):
        gx, gy, gz = state.gradient[j, 6 * n : 7 * n], state.gradient[j, 7 * n : 8 * n], state.gradient[j, 8 * n :]
        wx, wy = state.now[j, 3 * n : 4 * n], state.now[j, 4 * n : 5 * n]
        ax, ay, az = state.rate[j, 3 * n : 4 * n], state.rate[j, 4 * n : 5 * n], state.rate[j, 5 * n :]
        for e in range(n):
            ax[e] = per * gx[e] - loss * wx[e]
            ay[e] = per * gy[e] - loss * wy[e]
            az[e] = per * gz[e] - falling


@kernel
def accelerate_wet(rope: RopeConstants, state: RopeState, length: float) -> None:
    """DW/Dt at the nodes into the second half of ``rate``, in water."""
    n = state.stretch.shape[1]
    scale, added, displaced = 1.0 / length, rope.added, rope.displaced
    along, across = 1.0 / rope.density, 1.0 / (rope.density + rope.added)
    for j in range(5):
        now, grad, flow, rate, stretch = state.now[j], state.gradient[j], state.flow[j], state.rate[j], state.stretch[j]
        for e in range(n):
            inverse = 1.0 / stretch[e]
            tx, ty, tz = scale * inverse * now[e], scale * inverse * now[n + e], scale * inverse * now[2 * n + e]
            wx, wy, wz = now[3 * n + e], now[4 * n + e], now[5 * n + e]
            rx, ry, rz = flow[e] - wx, flow[n + e] - wy, flow[2 * n + e] - wz
            slide = rx * tx + ry * ty + rz * tz
            nx, ny, nz = rx - slide * tx, ry - slide * ty, rz - slide * tz
            normal = rope.normal_drag * sqrt(nx * nx + ny * ny + nz * nz)
            tangential = rope.tangential_drag * abs(slide) * slide
            # w_s = -slide; W_x = grad/l, t_x = P p_x/|p|, both over |p|. P is applied to the whole bracket below.
            turn, bend = 2.0 * slide * scale * inverse, (slide * scale * inverse) ** 2
            bx = flow[3 * n + e] - turn * grad[3 * n + e] - bend * grad[e]
            by = flow[4 * n + e] - turn * grad[4 * n + e] - bend * grad[n + e]
            bz = flow[5 * n + e] - turn * grad[5 * n + e] - bend * grad[2 * n + e]
            fx = scale * grad[6 * n + e] + normal * nx + tangential * tx - rope.damping * wx
            fy = scale * grad[7 * n + e] + normal * ny + tangential * ty - rope.damping * wy
            fz = scale * grad[8 * n + e] + normal * nz + tangential * tz - rope.weight
            fx += displaced * flow[3 * n + e] + added * bx
            fy += displaced * flow[4 * n + e] + added * by
            fz += displaced * flow[5 * n + e] + added * bz
            bracket = added * (bx * tx + by * ty + bz * tz)
            total = fx * tx + fy * ty + fz * tz
            more = (total - bracket) * along - total * across
            rate[3 * n + e] = across * fx + more * tx
            rate[4 * n + e] = across * fy + more * ty
            rate[5 * n + e] = across * fz + more * tz


@kernel
def add_loads(rope: RopeConstants, state: RopeState, loads: np.ndarray, length: float) -> None:
    """Loads along the cable, N/m, in the direction of x; what of them is across the cable moves the added mass, too."""
    n = state.stretch.shape[1]
    across = 1.0 / (rope.density + rope.added)
    more = 1.0 / rope.density - across
    for j in range(5):
        now, rate = state.now[j], state.rate[j]
        for e in range(n):
            inverse = 1.0 / (state.stretch[j, e] * length)
            tx, ty, tz = inverse * now[e], inverse * now[n + e], inverse * now[2 * n + e]
            amount = 0.0
            for k in range(loads.size):
                amount += loads[k] * rope.profiles[k, j, e]
            along = more * amount * tx
            rate[3 * n + e] += across * amount + along * tx
            rate[4 * n + e] += along * ty
            rate[5 * n + e] += along * tz


@kernel
def book_cable(rope: RopeConstants, state: RopeState, loads: np.ndarray, length: float) -> None:
    """Powers of the forces on the cable; what the added mass takes is what is missing to rho a."""
    n = state.stretch.shape[1]
    scale, per = 1.0 / length, length / (2.0 * n)
    weight, drag, damping, added, load = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(5):
        now, grad, flow, rate, stretch = state.now[j], state.gradient[j], state.flow[j], state.rate[j], state.stretch[j]
        for e in range(n):
            share, inverse = per * WEIGHTS[j], scale / stretch[e]
            tx, ty, tz = inverse * now[e], inverse * now[n + e], inverse * now[2 * n + e]
            wx, wy, wz = now[3 * n + e], now[4 * n + e], now[5 * n + e]
            rx, ry, rz = flow[e] - wx, flow[n + e] - wy, flow[2 * n + e] - wz
            slide = rx * tx + ry * ty + rz * tz
            nx, ny, nz = rx - slide * tx, ry - slide * ty, rz - slide * tz
            normal = rope.normal_drag * sqrt(nx * nx + ny * ny + nz * nz)
            tangential = rope.tangential_drag * abs(slide) * slide
            on_weight, on_damping = -rope.weight * wz, -rope.damping * (wx * wx + wy * wy)
            on_drag = (
                normal * (nx * wx + ny * wy + nz * wz) + tangential * (tx * wx + ty * wy + tz * wz)
            )  # fmt: skip
            on_load = 0.0
            for k in range(loads.size):
                on_load += loads[k] * rope.profiles[k, j, e] * wx
            moved = wx * rate[3 * n + e] + wy * rate[4 * n + e] + wz * rate[5 * n + e]
            pulled = wx * grad[6 * n + e] + wy * grad[7 * n + e] + wz * grad[8 * n + e]
            weight += share * on_weight
            drag += share * on_drag
            damping += share * on_damping
            load += share * on_load
            added += share * (rope.density * moved - scale * pulled - on_weight - on_drag - on_damping - on_load)
    state.power[WEIGHT], state.power[DRAG], state.power[DAMPING] = weight, drag, damping
    state.power[LOAD], state.power[ADDED] = load, added
