"""Search and proof for one loop on one motion of the winch: weights, a rate in each slab, and whether both are proved.

The samples only suggest a rate. What counts, for the verdict and for the fix alike, is the rate that was proved.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.certificate.conditions import SLACK, boundary_weight, decay_rates, extent, rate_limit
from umbilical.certificate.proof import prove
from umbilical.certificate.records import Proof, Weights
from umbilical.certificate.search import best_weights
from umbilical.certificate.setting import Loop, Payout
from umbilical.scenario.winch import Winch

ATTEMPTS = 4
"""Rates that are tried in a slab, each four times as far below its samples as the last."""
SPREAD = 1.0 / 64.0
"""Share of what the rate changes by in a slab that is left free: four times what a parabola through its nine samples
can fall below them, and enough for interval arithmetic."""


class ProofTask(NamedTuple):
    """What is to be certified.

    Attributes:
        winch: law of the scenario.
        edges: instants between which the rate is constant, s.
        motion: the winch at the samples of each slab.
        vessel_moves: whether the vessel does, and K4 must hold strictly.
    """

    winch: Winch
    edges: np.ndarray
    motion: Payout
    vessel_moves: bool


class Found(NamedTuple):
    """What came of it.

    Attributes:
        weights: the best ones; where K1, K2 and K4 leave no room, some that show what is missing.
        rates: rate of V in each slab, 1/s, shape (slabs,); not a number where there is no room.
        proof: of just these weights and rates.
    """

    weights: Weights
    rates: np.ndarray
    proof: Proof

    @property
    def certified(self) -> bool:
        """Whether V is proved to decay in every slab."""
        return self.proof.holds and bool((self.rates > 0.0).all())


def find_and_prove(loop: Loop, task: ProofTask) -> Found:
    """The best weights, and the rates that interval arithmetic confirms for them."""
    found = best_weights(loop, task.motion, vessel_moves=task.vessel_moves)
    if found is None:
        nothing = np.full(task.edges.size - 1, np.nan)
        return Found(_without_room(loop, task.motion), nothing, Proof(False, 0))
    sampled = decay_rates(loop, task.motion, *found)
    capped = np.minimum(sampled.min(axis=1), rate_limit(loop))
    slack = SLACK * np.abs(capped) + SPREAD * np.ptp(sampled, axis=1)
    weights = Weights(*found, boundary_weight(loop, task.motion, float(capped.max())))
    slabs = [_slab(loop, task, weights, k, *numbers) for k, numbers in enumerate(zip(capped, slack, strict=True))]
    left_open = tuple(part for _, proof in slabs for part in proof.open)
    proof = Proof(not left_open, sum(proof.boxes for _, proof in slabs), left_open)
    return Found(weights, np.array([rate for rate, _ in slabs]), proof)


def _without_room(loop: Loop, motion: Payout) -> Weights:
    room = extent(loop, motion)
    cross = SLACK * float(room.reach.min()) / float(motion.l.max())
    return Weights(cross, room.least_vessel, boundary_weight(loop, motion, 0.0))


def _slab(
    loop: Loop, task: ProofTask, weights: Weights, slab: int, sampled: float, slack: float
) -> tuple[float, Proof]:
    """A rate a little below the samples of a slab, and its proof; one that resists is tried again lower."""
    edges = task.edges[slab : slab + 2]
    for tried in range(ATTEMPTS):
        rate = sampled - (2.0 ** (2 * tried)) * slack
        proof = prove(loop, task.winch, edges, np.array([rate]), weights, task.vessel_moves)
        if not any(name == "K5" for name, *_ in proof.open):
            break
    return rate, proof
