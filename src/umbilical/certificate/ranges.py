"""What the winch does in every piece of time, from below and above: what bounds over a whole run are made of.

The intervals are those of ``proof_motion.py``, so nothing can hide between samples. Sums of doubles that are made of
them are moved outward by :data:`ROUNDING`.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from mpmath.ctx_iv import MPIntervalContext

from umbilical.certificate.proof_motion import motion_over
from umbilical.certificate.records import Ranges, Span, Weights
from umbilical.certificate.setting import Loop
from umbilical.relations.tension import carried, net_gravity, relative_jerk, tension
from umbilical.scenario.winch import Winch

PIECES = 16
"""Pieces of a slab, so that intervals stay narrow."""
ROUNDING = 1e-12
"""Share by which a sum of doubles is moved outward: hundreds of times what its additions can lose."""

Interval = Any


def ranges_of(winch: Winch, gravity: float, edges: np.ndarray) -> Ranges:
    """Length, speed and g - a over :data:`PIECES` pieces of each slab."""
    ctx: Any = MPIntervalContext()
    found = []
    for begin, end in pairwise(edges.tolist()):
        for low, high in pairwise(np.linspace(begin, end, PIECES + 1).tolist()):
            length, speed, acceleration, _ = motion_over(ctx, winch, low, high)
            found.append([_outward(part) for part in (length, speed, net_gravity(gravity, acceleration))])
    spans = np.array(found).reshape(edges.size - 1, PIECES, 3, 2)
    return Ranges(*(Span(spans[:, :, k, 0], spans[:, :, k, 1]) for k in range(3)))


def _outward(interval: Interval) -> tuple[float, float]:
    return float(np.nextafter(float(interval.a), -np.inf)), float(np.nextafter(float(interval.b), np.inf))


def growth_at_edges(loop: Loop, winch: Winch, weights: Weights, edges: np.ndarray) -> np.ndarray:
    """Largest growth of V where the tension jumps with the winch's acceleration, at each edge.

    ``N_after <= k N_before`` for all x with ``k = 1 + (r - 1)/(1 - rho Q^2/T)``, r the ratio of the tensions. Both
    ``r`` and ``rho Q^2/T`` are largest at an end of the cable: one is a ratio of lines, the other convex.
    """
    ctx: Any = MPIntervalContext()
    middles = 0.5 * (edges[:-1] + edges[1:])
    inner = zip(edges[1:-1].tolist(), middles[:-1].tolist(), middles[1:].tolist(), strict=True)
    return np.array([1.0, *(1.0 + _growth(ctx, loop, winch, weights, *instant) for instant in inner), 1.0])


def _growth(ctx: Any, loop: Loop, winch: Winch, weights: Weights, instant: float, before: float, after: float) -> float:
    """k - 1 at one instant, by the laws that hold before and after it; 0 where the tension does not grow."""
    _, _, old, _ = motion_over(ctx, winch, instant, instant, before)
    length, _, new, _ = motion_over(ctx, winch, instant, instant, after)
    net, hung = net_gravity(loop.g, old), loop.over(ctx).hanging
    grown = relative_jerk(old - new, net)
    if grown.b <= 0:
        return 0.0
    steep, wide = [], []
    for s, reach in ((0, weights.vessel + weights.cross * length), (length, weights.vessel)):
        pull = tension(s, net, hung)
        steep.append(1 + carried(s, hung) / pull)
        wide.append(1 - loop.rho * reach**2 / pull)
    grown, left = grown * max(steep, key=lambda part: part.b), min(wide, key=lambda part: part.a)
    return _outward(grown / left)[1] if left.a > 0 else np.inf
