"""The water that cable and body move in: interpolated in height between the levels it is known at."""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.rope.records import Water


@kernel
def flow_at(water: Water, stage: int, height: float, out: np.ndarray, at: int, step: int) -> None:
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


@kernel
def flow_along(water: Water, stage: int, height: np.ndarray, flow: np.ndarray) -> None:
    """Velocity and acceleration of the water at the nodes, shape (5, 6 n)."""
    n = height.shape[1]
    for j in range(5):
        for e in range(n):
            flow_at(water, stage, height[j, e], flow[j], e, n)
