"""The conditions proved instead of sampled: interval arithmetic over boxes of time, all x at once.

Conditions with one number on each side are those of ``conditions.py``, over intervals; K0 and K5, which the search
solves for a rate, are written from docs/certificates.md, and the winch laws are those of ``proof_motion.py``. Numbers
of the scenario and of the certificate enter exactly as they are stored. In x every condition is a line, or a line minus
a positive multiple of the square of one: it is least at an end of [0, l]. In t a box is halved until its intervals
decide.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import Any, NamedTuple

import numpy as np
from mpmath.ctx_iv import MPIntervalContext

from umbilical.certificate.conditions import State, sides
from umbilical.certificate.proof_motion import Motion, motion_over
from umbilical.certificate.records import Proof, Weights
from umbilical.certificate.setting import Loop
from umbilical.relations.tension import (
    Hanging,
    fading_tension,
    net_gravity,
    tension,
    tension_gain,
)
from umbilical.scenario.winch import Winch

BITS = 64
"""Binary digits of the intervals' ends: enough that rounding never decides."""
FEWEST, MOST = 24, 40000
"""Halvings of one slab, and boxes of one proof, before it is given up."""

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
    exact: list[Any] = [[None if x is None else ctx.mpf(x) for x in of] for of in (loop, weights)]
    loop, weights = Loop(*exact[0]), Weights(*exact[1])
    boxes, left_open = 0, []
    for begin, end, rate in zip(edges[:-1].tolist(), edges[1:].tolist(), rates.tolist(), strict=True):
        count, name, where = _slab(ctx, loop, weights, winch, (begin, end), rate, strict)
        boxes += count
        if name:
            left_open.append((name, *where))
    return Proof(not left_open, boxes, tuple(left_open))


class Box(NamedTuple):
    """Loop, weights and rate, and what the winch does in a box of time: length, speed, jerk, and g - a.

    ``reach`` is lam (l + x0)/gam; ``pull_top`` and ``pull`` are the tension at both ends.
    """

    loop: Loop
    weights: Weights
    hanging: Hanging
    rate: Interval
    length: Interval
    v: Interval
    jerk: Interval
    net: Interval
    reach: Interval
    pull_top: Interval
    pull: Interval


def _slab(
    ctx: Any,
    loop: Loop,
    weights: Weights,
    winch: Winch,
    slab: tuple[float, float],
    rate: float,
    strict: bool,
) -> tuple[int, str, tuple[float, float]]:
    """Decide one slab: boxes it took, and the condition and the box that stayed open; a half is asked only for what
    its whole left undecided."""
    if not np.isfinite(rate):
        return 0, "K5", slab
    waiting, count = [(*slab, 0, NAMES)], 0
    while waiting:
        begin, end, depth, asked = waiting.pop()
        count += 1
        box = _box(loop, weights, motion_over(ctx, winch, begin, end), ctx.mpf(rate))
        verdicts = _verdicts(box, asked, strict)
        undecided = tuple(name for name in asked if verdicts[name] is not True)
        if undecided:
            refuted = [name for name in undecided if verdicts[name] is False]
            if refuted or depth >= FEWEST or count > MOST:
                return count, (refuted or undecided)[0], (begin, end)
            middle = 0.5 * (begin + end)
            waiting += [(begin, middle, depth + 1, undecided), (middle, end, depth + 1, undecided)]
    return count, "", slab


def _box(loop: Loop, weights: Weights, motion: Motion, rate: Interval) -> Box:
    length, v, a, jerk = motion
    hung = loop.hanging_in(lambda number: number)
    net, reach = net_gravity(loop.g, a), weights.vessel + weights.cross * length
    ends = (tension(at, net, hung) for at in (length, 0))
    return Box(loop, weights, hung, rate, length, v, jerk, net, reach, *ends)


def _verdicts(box: Box, asked: Collection[str], strict: bool) -> dict[str, bool | None]:
    """Whether each condition holds everywhere in a box; False if nowhere, None if the intervals cannot tell."""
    found: dict[str, bool | None] = {}
    for name, above, value in _values(box, asked, strict):
        holds = False if value.b < 0 else True if (value.a > 0 if above else value.a >= 0) else None
        found[name] = False if False in (holds, found.get(name)) else None if found.get(name, True) is None else holds
    return found


def _values(b: Box, asked: Collection[str], strict: bool) -> Iterator[tuple[str, bool, Interval]]:
    """Name, whether equality breaks it, and what must not be negative anywhere in the box."""
    for name in asked:
        if name in ALONG:
            yield from ((name, name != "K5", value) for value in ALONG[name](b))
    state = State(b.v, b.reach, b.pull / b.loop.rho, b.pull_top / b.loop.rho)
    if not ALONG.keys() >= set(asked):
        for name, equation, left, right, *_ in sides(b.loop, b.weights, state, b.rate, strict):
            if name in asked:
                yield name, "<=" not in equation, right - left


def _weights(b: Box) -> Iterator[Interval]:
    """lam, eta and everything else that makes V a sum of squares; K0 then makes V1 + V2 one."""
    of = b.loop
    yield from (x for x in (of.rho, of.m, of.beta, of.k_a, of.k_s, of.vs) if x is not None)
    yield from (b.weights.cross, b.weights.boundary, b.pull)


def _k0(b: Box) -> Iterator[Interval]:
    yield from _least((b.pull_top, b.pull), (b.weights.vessel, b.reach), b.loop.rho)


def _k5(b: Box) -> Iterator[Interval]:
    """The entries of M - th/2 N: A does not depend on x, B and C are lines; A, C and AC - B^2 must not be negative."""
    rho, lam, vessel = b.loop.rho, b.weights.cross, b.weights.vessel
    corner = b.loop.c + rho * (lam - b.rate) / 2
    yield corner
    side = [(q * (b.loop.c - b.rate * rho) - rho * b.v * lam) / 2 for q in (vessel, b.reach)]
    far = [
        (fading_tension(lam - b.rate, s, b.net, b.jerk, b.hanging) + tension_gain(q, b.net, b.hanging)) / 2
        for s, q in ((b.length, vessel), (0, b.reach))
    ]
    yield from far  # without them A = B = 0 would let any C pass
    yield from _least((corner * far[0], corner * far[1]), (side[0], side[1]), 1)


ALONG = {"weights": _weights, "K0": _k0, "K5": _k5}
"""Conditions for all x at once, as coefficients of polynomials in x, intervals in t."""
NAMES = ("weights", "wave", "K0", "K1", "K2", "K3", "K4", "K5", "K6")


def _least(ends: tuple[Interval, Interval], line: tuple[Interval, Interval], factor: Interval) -> Iterator[Interval]:
    """On [0, l], (a line through ``ends``) - factor (a line through ``line``)^2: concave, so least at one of both ends.

    That needs ``factor`` above 0: it is 1, or the line density, which the condition *weights* holds above 0.
    """
    yield ends[0] - factor * line[0] ** 2
    yield ends[1] - factor * line[1] ** 2
