"""The conditions once more, proved instead of sampled: interval arithmetic over boxes of time, all x at once.

Nothing here is shared with the search: the conditions are written anew from docs/certificates.md, and the winch laws
are those of ``proof_motion.py``. Numbers of the scenario and of the certificate enter exactly as they are stored. In x
every condition is a polynomial of degree 2 at most; it is positive on [0, l] if its three Bernstein coefficients are.
In t a box is halved until its intervals decide.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from mpmath.ctx_iv import MPIntervalContext

from umbilical.analysis.certificate.proof_motion import motion_over
from umbilical.analysis.certificate.records import Proof, Weights
from umbilical.analysis.certificate.setting import Loop
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
    numbers = {name: ctx.mpf(value) for name, value in (loop._asdict() | weights._asdict()).items() if value is not None}
    boxes, left_open = 0, []
    for begin, end, rate in zip(edges[:-1].tolist(), edges[1:].tolist(), rates.tolist(), strict=True):
        for name, open_from, open_to, count in _slab(ctx, numbers, winch, (begin, end), rate, strict):
            boxes += count
            if name:
                left_open.append((name, open_from, open_to))
    return Proof(not left_open, boxes, tuple(left_open))


def _slab(
    ctx: Any, numbers: dict[str, Interval], winch: Winch, slab: tuple[float, float], rate: float, strict: bool
) -> Iterator[tuple[str, float, float, int]]:
    """Decide one slab; yields what stays open, and at the end the number of boxes."""
    if not np.isfinite(rate):
        yield "K5", *slab, 0
        return
    waiting, count = [(*slab, 0)], 0
    while waiting:
        begin, end, depth = waiting.pop()
        count += 1
        undecided = [
            (name, value)
            for name, value, above in _conditions(numbers, *motion_over(ctx, winch, begin, end), rate=ctx.mpf(rate))
            if not (value.a > 0 if above or (strict and name == "K4") else value.a >= 0)
        ]
        if not undecided:
            continue
        name, value = undecided[0]
        if value.b < 0 or depth >= FEWEST or count > MOST:
            yield name, begin, end, count
            return
        middle = 0.5 * (begin + end)
        waiting += [(begin, middle, depth + 1), (middle, end, depth + 1)]
    yield "", *slab, count


def _conditions(
    n: dict[str, Interval], l: Interval, v: Interval, a: Interval, jerk: Interval, rate: Interval  # noqa: E741
) -> Iterator[tuple[str, Interval, bool]]:
    """Name, what must not be negative, and whether it must be positive."""
    rho, beta, m, lam, offset, eta = n["rho"], n["beta"], n["m"], n["cross"], n["vessel"], n["boundary"]
    net, reach = n["g"] - a, offset + lam * l
    top_mass = m + n["hanging"] * l
    pull_top, pull = top_mass * net, m * net
    yield "wave", net, True
    yield "wave", pull_top - rho * v**2, True
    for coefficient in _bernstein(ends=(pull_top, pull), line=(offset, reach), factor=rho):
        yield "K0", coefficient, True
    yield "K1", pull - beta * rho * reach, False
    yield "K2", beta - reach, False
    yield "K3", 2 * beta * eta * n["k_a"] - pull, True
    yield "K4", v + offset, False
    # A, B, C: entries of M - th/2 N; A is constant in x, B and C are lines.
    corner = n["c"] + rho * (lam - rate) / 2
    side = [(q * (n["c"] - rate * rho) - rho * v * lam) / 2 for q in (offset, reach)]
    gain = lam - rate
    far = [(mass * (gain * net + jerk) + q * n["hanging"] * net) / 2 for mass, q in ((top_mass, offset), (m, reach))]
    yield "K5", corner, False
    for coefficient in _bernstein(ends=(corner * far[0], corner * far[1]), line=(side[0], side[1]), factor=1):
        yield "K5", coefficient, False
    yield "K6", 2 * eta * n["k_a"] - pull / beta - rate * eta * m, False
    if "k_s" in n:
        yield "K6", n["k_s"] - rate, False


def _bernstein(
    ends: tuple[Interval, Interval], line: tuple[Interval, Interval], factor: Interval
) -> tuple[Interval, Interval, Interval]:
    """Bernstein coefficients on [0, l] of (a line through ``ends``) - factor (a line through ``line``)^2."""
    return (
        ends[0] - factor * line[0] ** 2,
        (ends[0] + ends[1]) / 2 - factor * line[0] * line[1],
        ends[1] - factor * line[1] ** 2,
    )
