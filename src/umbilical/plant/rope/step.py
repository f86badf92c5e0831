"""One step of the rope: the strong-stability-preserving Runge-Kutta method of order 3, and the step it allows.

::

    u1 = u + dt L(u, t),  u2 = 3/4 u + 1/4 (u1 + dt L(u1, t + dt)),  u <- 1/3 u + 2/3 (u2 + dt L(u2, t + dt/2))

Source: Gottlieb, Shu, Tadmor, SIAM Review 43 (2001). In slack the penalty on jumps of the velocity relaxes at the rate
20 c/h for elements of the length h: the method's real limit of 2.51, less a margin, gives the step.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from umbilical.compile import entry_kernel, glue, kernel
from umbilical.plant.rope.ends import meet_body, meet_vessel
from umbilical.plant.rope.operators import add_up_positions
from umbilical.plant.rope.rates import evaluate_rope
from umbilical.plant.rope.records import RopeConstants, RopeOutside, RopeState, WaterColumn
from umbilical.plant.rope.tension import pull_of, stretch_of

SAFE = 2.3
"""Largest product of step and fastest rate that is taken; the method's own limit is 2.51."""
FASTEST = 20.0
"""Fastest rate of the grid times an element's length over the wave speed."""


def axial_speed(rope: RopeConstants) -> float:
    """Speed of waves along the cable, m/s."""
    return sqrt(rope.stiffness / rope.density)


def largest_step(rope: RopeConstants, length: float, speed: float, elements: int) -> float:
    """Longest step taken on a cable of this length, s, that the winch moves at this speed, m/s."""
    return SAFE * length / (elements * FASTEST * (axial_speed(rope) + abs(speed)))


@kernel
def blend(state: RopeState, dt: float, share: float) -> None:
    """u <- (1 - share) base + share (u + dt rate), for cable and body."""
    rest, step = 1.0 - share, share * dt
    for j in range(5):
        now, base, rate = state.now[j], state.base[j], state.rate[j]
        for k in range(now.size):
            now[k] = rest * base[k] + share * now[k] + step * rate[k]
    for i in range(3):
        state.body[0, i] = rest * state.body[1, i] + share * state.body[0, i] + step * state.body[2, i]


@kernel
def add_works(state: RopeState, time: float) -> None:
    """work += power * time."""
    for k in range(state.work.size):
        state.work[k] += time * state.power[k]


@kernel
def keep_base(state: RopeState) -> None:
    """Remember the start of the step."""
    for j in range(5):
        now, base = state.now[j], state.base[j]
        for k in range(now.size):
            base[k] = now[k]
    for i in range(3):
        state.body[1, i] = state.body[0, i]


@glue
def advance_rope(
    rope: RopeConstants,
    state: RopeState,
    outside: RopeOutside,
    loads: np.ndarray,
    water: WaterColumn,
    dt: float,
    booked: bool,
) -> None:
    """One step. ``outside`` and ``water`` at its start, end and middle; ``loads`` likewise, shape (3, loads)."""
    keep_base(state)
    for stage in range(3):
        evaluate_rope(rope, state, outside[stage], loads[stage], water, stage, booked)
        blend(state, dt, 1.0 if stage == 0 else (0.25 if stage == 1 else 2.0 / 3.0))
        if booked:
            add_works(state, dt * (2.0 / 3.0 if stage == 2 else 1.0 / 6.0))
    state.outside[0] = outside[1]
    look_at_rope(rope, state)


@entry_kernel
def look_at_rope(rope: RopeConstants, state: RopeState) -> None:
    """What follows from the present state: tension along the cable and at its ends, places where elements meet."""
    n, outside = state.stretch.shape[1], state.outside[0]
    stretch_of(state.now, state.stretch, outside.length)
    pull_of(rope, state.now, state.stretch, state.pull, outside.length)
    meet_vessel(rope, state.now, state.pull, state.stretch, state.star, state.power, outside, state.ends[0])
    meet_body(
        rope, state.now, state.pull, state.stretch, state.star, state.power, state.body[0], state.ends[0],
        outside.length,
    )  # fmt: skip
    add_up_positions(state.now, state.joints, outside.vessel_position, n)


@entry_kernel
def run_rope(
    rope: RopeConstants,
    state: RopeState,
    outside: RopeOutside,
    loads: np.ndarray,
    water: WaterColumn,
    dt: np.ndarray,
    booked: bool,
) -> None:
    """Steps one after the other: ``outside`` of shape (steps, 3), ``loads`` (steps, 3, loads), ``dt`` (steps,)."""
    for i in range(dt.size):
        advance_rope(rope, state, outside[i], loads[i], water, dt[i], booked)
