"""The conditions once more, proved instead of sampled: interval arithmetic over boxes of time, all x at once.

Nothing here is shared with the search but the formula of the tension: the conditions are written anew from
docs/certificates.md, and the winch laws are those of ``proof_motion.py``. Numbers of the scenario and of the
certificate enter exactly as they are stored. In x every condition is a line, or a line minus a positive multiple of the
square of one: it is least at an end of [0, l]. In t a box is halved until its intervals decide.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from mpmath.ctx_iv import MPIntervalContext

from umbilical.analysis.certificate.proof_motion import Motion, motion_over
from umbilical.analysis.certificate.records import Proof, Weights
from umbilical.analysis.certificate.setting import Loop
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
    hung = loop.hanging_in(ctx.mpf)
    numbers = {
        name: ctx.mpf(value) for name, value in (loop._asdict() | weights._asdict()).items() if value is not None
    }
    boxes, left_open = 0, []
    for begin, end, rate in zip(edges[:-1].tolist(), edges[1:].tolist(), rates.tolist(), strict=True):
        count, name, where = _slab(ctx, numbers, hung, winch, (begin, end), rate, strict)
        boxes += count
        if name:
            left_open.append((name, *where))
    return Proof(not left_open, boxes, tuple(left_open))


class Box(NamedTuple):
    """Numbers of loop and certificate, and what the winch does in a box of time: length, speed, jerk, and g - a.

    ``reach`` is lam (l + x0)/gam; ``pull_top`` and ``pull`` are the tension at both ends.
    """

    n: Mapping[str, Interval]
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
    numbers: Mapping[str, Interval],
    hung: Hanging,
    winch: Winch,
    slab: tuple[float, float],
    rate: float,
    strict: bool,
) -> tuple[int, str, tuple[float, float]]:
    """Decide one slab: boxes it took, and the condition and the box that stayed open; a half is asked only for what
    its whole left undecided."""
    if not np.isfinite(rate):
        return 0, "K5", slab
    waiting, count = [(*slab, 0, tuple(CONDITIONS))], 0
    while waiting:
        begin, end, depth, asked = waiting.pop()
        count += 1
        box = _box(numbers, hung, motion_over(ctx, winch, begin, end), ctx.mpf(rate))
        verdicts = {name: _verdict(name, box, strict) for name in asked}
        undecided = tuple(name for name, verdict in verdicts.items() if verdict is not True)
        if undecided:
            refuted = [name for name in undecided if verdicts[name] is False]
            if refuted or depth >= FEWEST or count > MOST:
                return count, (refuted or undecided)[0], (begin, end)
            middle = 0.5 * (begin + end)
            waiting += [(begin, middle, depth + 1, undecided), (middle, end, depth + 1, undecided)]
    return count, "", slab


def _box(n: Mapping[str, Interval], hung: Hanging, motion: Motion, rate: Interval) -> Box:
    length, v, a, jerk = motion
    net, reach = net_gravity(n["g"], a), n["vessel"] + n["cross"] * length
    return Box(n, hung, rate, length, v, jerk, net, reach, tension(length, net, hung), tension(0, net, hung))


def _verdict(name: str, box: Box, strict: bool) -> bool | None:
    """Whether a condition holds everywhere in a box; False if nowhere, None if the intervals cannot tell."""
    above = name in STRICT or (strict and name == "K4")
    values = list(CONDITIONS[name](box))
    if any(value.b < 0 for value in values):
        return False
    return True if all(value.a > 0 if above else value.a >= 0 for value in values) else None


def _weights(b: Box) -> Iterator[Interval]:
    """lam, eta and everything else that makes V a sum of squares; K0 then makes V1 + V2 one."""
    yield from (b.n[name] for name in ("rho", "m", "beta", "k_a", "k_s", "vs", "cross", "boundary") if name in b.n)


def _wave(b: Box) -> Iterator[Interval]:
    yield b.pull
    yield b.pull_top - b.n["rho"] * b.v**2


def _k0(b: Box) -> Iterator[Interval]:
    yield from _least((b.pull_top, b.pull), (b.n["vessel"], b.reach), b.n["rho"])


def _k1(b: Box) -> Iterator[Interval]:
    yield b.pull - b.n["beta"] * b.n["rho"] * b.reach


def _k2(b: Box) -> Iterator[Interval]:
    yield b.n["beta"] - b.reach


def _k3(b: Box) -> Iterator[Interval]:
    yield 2 * b.n["beta"] * b.n["boundary"] * b.n["k_a"] - b.pull


def _k4(b: Box) -> Iterator[Interval]:
    yield b.v + b.n["vessel"]


def _k5(b: Box) -> Iterator[Interval]:
    """The entries of M - th/2 N: A does not depend on x, B and C are lines; A, C and AC - B^2 must not be negative."""
    n, rho, lam = b.n, b.n["rho"], b.n["cross"]
    corner = n["c"] + rho * (lam - b.rate) / 2
    yield corner
    side = [(q * (n["c"] - b.rate * rho) - rho * b.v * lam) / 2 for q in (n["vessel"], b.reach)]
    far = [
        (fading_tension(lam - b.rate, s, b.net, b.jerk, b.hanging) + tension_gain(q, b.net, b.hanging)) / 2
        for s, q in ((b.length, n["vessel"]), (0, b.reach))
    ]
    yield from far  # without them A = B = 0 would let any C pass
    yield from _least((corner * far[0], corner * far[1]), (side[0], side[1]), 1)


def _k6(b: Box) -> Iterator[Interval]:
    n = b.n
    yield 2 * n["boundary"] * n["k_a"] - b.pull / n["beta"] - b.rate * n["boundary"] * n["m"]
    if "k_s" in n:
        yield n["k_s"] - b.rate


CONDITIONS = {
    "weights": _weights, "wave": _wave,
    "K0": _k0, "K1": _k1, "K2": _k2, "K3": _k3, "K4": _k4, "K5": _k5, "K6": _k6,
}  # fmt: skip
"""What must not be negative anywhere; coefficients of polynomials in x, intervals in t."""
STRICT = ("weights", "wave", "K0", "K3")
"""Conditions that equality breaks."""


def _least(ends: tuple[Interval, Interval], line: tuple[Interval, Interval], factor: Interval) -> Iterator[Interval]:
    """On [0, l], (a line through ``ends``) - factor (a line through ``line``)^2: concave, so least at one of both ends.

    That needs ``factor`` above 0: it is 1, or the line density, which the condition *weights* holds above 0.
    """
    yield ends[0] - factor * line[0] ** 2
    yield ends[1] - factor * line[1] ** 2
