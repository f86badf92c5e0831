"""The conditions proved instead of sampled: interval arithmetic over boxes of time, all x at once.

The conditions are those of ``conditions.py`` and the winch laws those of ``proof_motion.py``, both over intervals.
Numbers of the scenario and of the certificate enter exactly as they are stored. A box of time is halved until its
intervals decide.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import Any

import numpy as np
from mpmath.ctx_iv import MPIntervalContext

from umbilical.certificate.conditions import ALONG, Terms, sides, terms_of
from umbilical.certificate.proof_motion import motion_over
from umbilical.certificate.records import Proof, Weights
from umbilical.certificate.setting import Loop, payout_of
from umbilical.scenario.winch import Winch

BITS = 64
"""Binary digits of the intervals' ends: enough that rounding never decides."""
FEWEST, MOST = 24, 40000
"""Halvings of one slab, and boxes of one proof, before it is given up."""

NAMES = ("weights", "wave", "K0", "K1", "K2", "K3", "K4", "K5", "K6")
Interval = Any


def prove(loop: Loop, winch: Winch, edges: np.ndarray, rates: np.ndarray, weights: Weights, strict: bool) -> Proof:
    """Verify a certificate's numbers for all x in [0, l(t)] and all t of the run.

    Args:
        loop: constants of the ideal loop.
        winch: law of the scenario.
        edges: instants between which the rate is constant, s; every jump of the winch among them.
        rates: claimed rate of V in each slab, 1/s.
        weights: numbers of the search.
        strict: whether K4 must hold strictly, as it must when the vessel moves.

    Returns:
        Whether all is proved, the number of boxes, and what stayed open.
    """
    ctx: Any = MPIntervalContext()
    ctx.prec = BITS
    loop, weights = loop.over(ctx), Weights(*map(ctx.mpf, weights))
    boxes, left_open = 0, []
    for begin, end, rate in zip(edges[:-1].tolist(), edges[1:].tolist(), rates.tolist(), strict=True):
        count, name, where = _slab(ctx, loop, weights, winch, (begin, end), rate, strict)
        boxes += count
        if name:
            left_open.append((name, *where))
    return Proof(not left_open, boxes, tuple(left_open))


def _slab(
    ctx: Any, loop: Loop, weights: Weights, winch: Winch, slab: tuple[float, float], rate: float, strict: bool
) -> tuple[int, str, tuple[float, float]]:
    """Decide one slab: boxes it took, and the condition and the box that stayed open; a half is asked only for what
    its whole left undecided."""
    if not np.isfinite(rate):
        return 0, "K5", slab
    waiting, count = [(*slab, 0, NAMES)], 0
    while waiting:
        begin, end, depth, asked = waiting.pop()
        count += 1
        case = terms_of(loop, weights, payout_of(None, motion_over(ctx, winch, begin, end), loop.g))
        verdicts = _verdicts(case, ctx.mpf(rate), asked, strict)
        undecided = tuple(name for name in asked if verdicts[name] is not True)
        if undecided:
            refuted = [name for name in undecided if verdicts[name] is False]
            if refuted or depth >= FEWEST or count > MOST:
                return count, (refuted or undecided)[0], (begin, end)
            middle = 0.5 * (begin + end)
            waiting += [(begin, middle, depth + 1, undecided), (middle, end, depth + 1, undecided)]
    return count, "", slab


def _verdicts(case: Terms, rate: Interval, asked: Collection[str], strict: bool) -> dict[str, bool | None]:
    """Whether each condition holds everywhere in a box; False if nowhere, None if the intervals cannot tell."""
    found: dict[str, bool | None] = {}
    for name, above, value in _values(case, rate, asked, strict):
        holds = False if value.b < 0 else True if (value.a > 0 if above else value.a >= 0) else None
        found[name] = False if False in (holds, found.get(name)) else None if found.get(name, True) is None else holds
    return found


def _values(case: Terms, rate: Interval, asked: Collection[str], strict: bool) -> Iterator[tuple[str, bool, Interval]]:
    """Name, whether equality breaks it, and what must not be negative anywhere in the box."""
    for name in asked:
        if name in ALONG:
            yield from ((name, name != "K5", value) for value in ALONG[name](case, rate))
    if not ALONG.keys() >= set(asked):
        for name, equation, left, right, *_ in sides(case, rate, strict):
            if name in asked:
                yield name, "<=" not in equation, right - left
