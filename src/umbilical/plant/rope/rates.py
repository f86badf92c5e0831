"""Rates of cable and body: the two conservation laws on sigma = x/l(t), with Q = l r_x and A = 1 - sigma.

::

    Q_t = W_sigma - (v A/l) Q_sigma + (v/l) Q          W_t = DW/Dt - (v A/l) W_sigma

W_sigma and (N t)_sigma meet at interfaces in the waves' flux (``fluxes.py``); what moves with the material, at v A/l,
takes the value of the side it comes from.
"""

from __future__ import annotations

import numpy as np

from umbilical.compile import entry_kernel, glue, kernel
from umbilical.plant.rope.body import accelerate_body
from umbilical.plant.rope.ends import meet_body, meet_vessel
from umbilical.plant.rope.fluxes import meet_elements
from umbilical.plant.rope.forces import accelerate_dry, accelerate_wet, add_loads, book_cable
from umbilical.plant.rope.operators import LIFT, add_up_positions, differentiate_columns, heights, lift
from umbilical.plant.rope.records import GRID, RopeConstants, RopeOutside, RopeState, WaterColumn
from umbilical.plant.rope.tension import pull_of, stretch_of
from umbilical.plant.rope.water import flow_along, flow_at


@kernel
def carry(rope: RopeConstants, state: RopeState, speed: float, length: float) -> None:
    """From DW/Dt to W_t, and Q_t, with the transport of the material through the grid."""
    n = state.stretch.shape[1]
    for j in range(5):
        above, rate, now, grad = rope.above[j], state.rate[j], state.now[j], state.gradient[j]
        for i in range(3):
            q, w, qs, ws = now[i * n : (i + 1) * n], rate[(3 + i) * n :], grad[i * n :], grad[(3 + i) * n :]
            out = rate[i * n : (i + 1) * n]
            for e in range(n):
                drift = speed / length * above[e]
                out[e] = ws[e] - drift * qs[e] + speed / length * q[e]
                w[e] -= drift * ws[e]


@kernel
def carry_across(rope: RopeConstants, state: RopeState, speed: float, length: float) -> None:
    """What the transport takes from the side it comes from, where elements meet; and what that costs."""
    n = state.stretch.shape[1]
    lost = 0.0
    for f in range(1, n):
        drift = speed / length * rope.above_faces[f]
        scale = 2.0 * n * LIFT * abs(drift)
        row, own, other = (0, f, f - 1) if speed > 0.0 else (4, f - 1, f)
        kinetic, mine, theirs, work = 0.0, 0.0, 0.0, 0.0
        for i in range(3):
            w_own, w_other = state.now[row, (3 + i) * n + own], state.now[4 - row, (3 + i) * n + other]
            q_own, q_other = state.now[row, i * n + own], state.now[4 - row, i * n + other]
            state.rate[row, (3 + i) * n + own] += scale * (w_other - w_own)
            state.rate[row, i * n + own] += scale * (q_other - q_own)
            kinetic += (w_other - w_own) ** 2
            work += state.pull[row, i * n + own] * (q_other - q_own)
        mine, theirs = state.stretch[row, own] - 1.0, state.stretch[4 - row, other] - 1.0
        stored = 0.5 * rope.stiffness * (max(theirs, 0.0) ** 2 - max(mine, 0.0) ** 2) - work / length
        lost += abs(drift) * length * (stored + 0.5 * rope.density * kinetic)
    state.power[GRID] -= lost


@kernel
def carry_in(rope: RopeConstants, state: RopeState, speed: float, length: float) -> None:
    """What is paid out enters at the sheave with its stretch and velocity."""
    n = state.stretch.shape[1]
    ends = state.ends[0]
    scale = 2.0 * n * LIFT * speed / length
    kinetic, work, size = 0.0, 0.0, 0.0
    for i in range(3):
        entering = ends.entering_stretch[i]
        step = length * entering - state.now[0, i * n]
        state.rate[0, i * n] += scale * step
        state.rate[0, (3 + i) * n] += scale * (ends.top_velocity[i] - state.now[0, (3 + i) * n])
        kinetic += (ends.top_velocity[i] - state.now[0, (3 + i) * n]) ** 2
        work += state.pull[0, i * n] * step / length
        size += entering * entering
    mine, theirs = max(state.stretch[0, 0] - 1.0, 0.0), max(np.sqrt(size) - 1.0, 0.0)
    stored = 0.5 * rope.stiffness * (theirs * theirs - mine * mine) - work
    state.power[GRID] -= speed * (stored + 0.5 * rope.density * kinetic)


@glue
def look_at_water(state: RopeState, water: WaterColumn, stage: int, start: np.ndarray) -> None:
    """The water at the nodes and at the body."""
    n = state.stretch.shape[1]
    add_up_positions(state.now, state.joints, start, n)
    heights(state.now, state.joints, state.height, n)
    flow_along(water, stage, state.height, state.flow)
    flow_at(water, stage, state.joints[2, n], state.body_flow, 0, 1)


@glue
def find_gradients(state: RopeState) -> None:
    """d/dsigma of Q and W inside the elements, and of N t with what holds where they meet."""
    n = state.stretch.shape[1]
    differentiate_columns(state.now, state.gradient, 0, n)
    differentiate_columns(state.pull, state.gradient, 6 * n, n)
    for i in range(3):
        lift(state.pull[:, i * n : (i + 1) * n], state.star, 3 + i, state.gradient, (6 + i) * n, n)


@entry_kernel
def evaluate_rope(
    rope: RopeConstants,
    state: RopeState,
    outside: RopeOutside,
    loads: np.ndarray,
    water: WaterColumn,
    stage: int,
    booked: bool,
) -> None:
    """All rates at the present state, and the powers."""
    length, speed, n = outside.length, outside.payout_speed, state.stretch.shape[1]
    state.power[GRID] = 0.0
    stretch_of(state.now, state.stretch, length)
    pull_of(rope, state.now, state.stretch, state.pull, length)
    meet_elements(rope, state.now, state.pull, state.stretch, state.star, state.power)
    meet_vessel(rope, state.now, state.pull, state.stretch, state.star, state.power, outside, state.ends[0])
    meet_body(rope, state.now, state.pull, state.stretch, state.star, state.power, state.body[0], state.ends[0], length)
    find_gradients(state)
    if rope.wet:
        look_at_water(state, water, stage, outside.vessel_position)
        accelerate_wet(rope, state, length)
    else:
        accelerate_dry(rope, state, length)
    if loads.size > 0:
        add_loads(rope, state, loads, length)
    if booked:
        book_cable(rope, state, loads, length)
    accelerate_body(rope, state, outside, booked)
    carry(rope, state, speed, length)
    for i in range(3):
        lift(state.now[:, (3 + i) * n : (4 + i) * n], state.star, i, state.rate, i * n, n)
    if speed != 0.0:
        carry_across(rope, state, speed, length)
    if speed > 0.0:
        carry_in(rope, state, speed, length)
