"""The best rate over lam/gam and lam x0/gam: quasi-concave, because K5 is linear in both at a given th.

A grid that closes in on its best point: the best of 9 x 9 candidates, then a window half as wide around it, and so
on. Nothing that is found here is believed; ``proof.py`` verifies it.
"""

from __future__ import annotations

import numpy as np

from umbilical.certificate.conditions import SLACK, Extent, decay_rates, extent, largest_cross
from umbilical.certificate.setting import Loop, Payout

CANDIDATES, ROUNDS = 9, 20


def best_weights(
    loop: Loop, motion: Payout, *, vessel_moves: bool = False, enough: float = np.inf
) -> tuple[float, float] | None:
    """lam/gam, 1/s, and lam x0/gam, m/s, with the largest smallest rate; None if K1, K2 and K4 leave no room.

    With a vessel in motion what it does to V is divided by ``v + lam x0/gam`` (section 7, vessel terms); then the
    product of that and the rate is made largest, which makes the vessel's share of the bound smallest. The search
    ends early at a score above ``enough``.
    """
    room = extent(loop, motion)
    widest = float(room.reach.min())
    if room.least_vessel >= widest:
        return None
    low, high = np.zeros(2), np.ones(2)
    best, found = -np.inf, (0.0, 0.0)
    for _ in range(ROUNDS):
        share = np.stack(np.meshgrid(*np.linspace(low, high, CANDIDATES).T, indexing="ij"))
        # Neither at its edge: lam = 0 is no weight, and the proof refuses it.
        vessel = room.least_vessel + np.minimum(share[1], 1.0 - SLACK) * (widest - room.least_vessel)
        cross = np.maximum(share[0], SLACK) * largest_cross(motion, room, vessel)
        score = _score(loop, motion, room, cross, vessel, vessel_moves)
        at = np.unravel_index(np.argmax(score), score.shape)
        if score[at] > best:
            best, found = float(score[at]), (float(cross[at]), float(vessel[at]))
        if best > enough:
            break
        centre, half = share[(slice(None), *at)], (high - low) / 4.0
        low, high = np.clip(centre - half, 0.0, 1.0), np.clip(centre + half, 0.0, 1.0)
    return found if best > -np.inf else None


def _score(
    loop: Loop, motion: Payout, room: Extent, cross: np.ndarray, vessel: np.ndarray, vessel_moves: bool
) -> np.ndarray:
    worst = decay_rates(loop, motion, cross[..., None, None], vessel[..., None, None]).min(axis=(-1, -2))
    if not vessel_moves:
        return worst
    return np.where(worst > 0.0, worst * (vessel + float(motion.v.min())), worst)
