"""Energy of cable and body, J: kinetic and elastic. Weight is a work, for cable comes and goes at the sheave."""

from __future__ import annotations

import numpy as np

from umbilical.plant.elements import WEIGHTS
from umbilical.plant.rope.records import RopeConstants


def rope_energy(rope: RopeConstants, now: np.ndarray, body: np.ndarray, length: np.ndarray) -> np.ndarray:
    """``int (rho |W|^2 + EA (|p| - 1)_+^2)/2 dx + V (m + A) V/2``.

    Args:
        rope: constants.
        now: l r_x and W at the nodes, shape (samples, 5, 6 n).
        body: velocity of the body, shape (samples, 3).
        length: m, shape (samples,).

    Returns:
        J, shape (samples,).
    """
    samples, _, columns = now.shape
    parts = now.reshape(samples, 5, 6, columns // 6)
    stretch = np.sqrt((parts[:, :, :3] ** 2).sum(axis=2)) / length[:, None, None]
    strain = np.maximum(stretch - 1.0, 0.0)
    density = 0.5 * (rope.density * (parts[:, :, 3:] ** 2).sum(axis=2) + rope.stiffness * strain**2)
    inside = np.einsum("j,sje->s", WEIGHTS, density) * length / (2.0 * parts.shape[3])
    return inside + 0.5 * (rope.inertia * body**2).sum(axis=1)
