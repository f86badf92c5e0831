"""The water that cable and body move in: interpolated in height between the levels it is known at."""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.orbital import at_level, find_level, look_at_waves
from umbilical.plant.rope.records import AXES, STAGES, RopeOutside, WaterColumn


@kernel
def add_orbital_motion(water: WaterColumn, stage: int, height: float, out: np.ndarray, at: int, step: int) -> None:
    """Add the waves' motion at a height over the sheave's mean height to ``out``, as :func:`flow_at`."""
    level = find_level(water.waves, -height)
    if level < 0.0:
        return
    for kind in range(2):
        for i in range(AXES):
            out[at + (AXES * kind + i) * step] += at_level(water.orbit[stage, kind, i], level)


@kernel
def flow_at(water: WaterColumn, stage: int, height: float, out: np.ndarray, at: int, step: int) -> None:
    """Velocity and acceleration at a height into ``out[at], out[at + step], ...``, six numbers; linear between."""
    known, levels = water.heights, water.heights.size
    k = 1
    while k < levels - 1 and height < known[k]:
        k += 1
    share = 0.0
    if levels > 1:
        share = min(max((known[k - 1] - height) / (known[k - 1] - known[k]), 0.0), 1.0)
    above, below = water.flow[stage, k - 1], water.flow[stage, min(k, levels - 1)]
    for c in range(6):
        out[at + c * step] = above[c] + share * (below[c] - above[c])
    if water.waves.deepest > 0.0:
        add_orbital_motion(water, stage, height, out, at, step)


@kernel
def stir(water: WaterColumn, stage: RopeOutside, orbits: np.ndarray, start: float, end: float) -> None:
    """Current and waves at the stages of a step, these from their places in the rows of ``plant/orbital.py``."""
    for s in range(STAGES):
        factor, rate = stage[s].current_factor, stage[s].current_rate
        for k in range(water.heights.size):
            for i in range(AXES):
                water.flow[s, k, i] = factor * water.profile[k, i]
                water.flow[s, k, AXES + i] = rate * water.profile[k, i]
    if water.waves.deepest > 0.0:
        look_at_waves(orbits, start, water.orbit[0])
        look_at_waves(orbits, end, water.orbit[1])
        look_at_waves(orbits, 0.5 * (start + end), water.orbit[2])


@kernel
def flow_along(water: WaterColumn, stage: int, height: np.ndarray, flow: np.ndarray) -> None:
    """Velocity and acceleration of the water at the nodes, shape (5, 6 n)."""
    n = height.shape[1]
    for j in range(5):
        for e in range(n):
            flow_at(water, stage, height[j, e], flow[j], e, n)
