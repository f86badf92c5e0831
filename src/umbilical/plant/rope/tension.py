"""The law of the material: N = EA (|r_x| - 1), and nothing in compression."""

from __future__ import annotations

from math import sqrt

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.rope.records import RopeConstants

SMALLEST = 1e-12
"""|r_x| below which a direction would be round-off."""


@kernel
def stretch_of(x: np.ndarray, stretch: np.ndarray, length: float) -> None:
    """|r_x| at the nodes from l r_x, the first 3 n columns of ``x``."""
    n = stretch.shape[1]
    scale = 1.0 / length
    for j in range(5):
        qx, qy, qz, out = x[j, :n], x[j, n : 2 * n], x[j, 2 * n : 3 * n], stretch[j]
        for e in range(n):
            out[e] = scale * sqrt(qx[e] * qx[e] + qy[e] * qy[e] + qz[e] * qz[e]) + SMALLEST


@kernel
def pull_of(rope: RopeConstants, x: np.ndarray, stretch: np.ndarray, pull: np.ndarray, length: float) -> None:
    """N t at the nodes, N."""
    n = stretch.shape[1]
    for j in range(5):
        qx, qy, qz, s = x[j, :n], x[j, n : 2 * n], x[j, 2 * n : 3 * n], stretch[j]
        gx, gy, gz = pull[j, :n], pull[j, n : 2 * n], pull[j, 2 * n : 3 * n]
        for e in range(n):
            per = rope.stiffness * max(s[e] - 1.0, 0.0) / (s[e] * length)
            gx[e], gy[e], gz[e] = per * qx[e], per * qy[e], per * qz[e]
