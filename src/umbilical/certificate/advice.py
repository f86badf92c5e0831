"""What would mend a certificate that does not hold: another slope gain or, where none is found, a slower winch.

Samples suggest. What is printed is itself proved, digit by digit: a fix that is followed is certified, and where
nothing could be proved nothing is suggested.
"""

from __future__ import annotations

from collections.abc import Callable
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from typing import NamedTuple

import numpy as np

from umbilical.certificate.conditions import SLACK, decay_rates
from umbilical.certificate.search import best_weights
from umbilical.certificate.setting import Loop, Payout, sampled, slab_edges
from umbilical.certificate.solve import ProofTask, find_and_prove
from umbilical.errors import Problem
from umbilical.relations.tension import tension
from umbilical.scenario.winch import Winch

TRIED, HALVINGS = 25, 10
DIGITS = 4
"""Digits of a gain that is recommended; it is tried with just these."""
STEPS = 8
"""Steps away from the sampled edge, each twice as long as the last, until a gain is proved."""

SLOWER = (0.5, 0.25, 0.125, 0.0625, 0.03125)
"""Shares of the winch's speed that are tried where no gain is certified."""

Test = Callable[[float], bool]


class Range(NamedTuple):
    """Gains that can be certified: from ``low`` to ``high``, m/s; 0 and infinity where nothing was in the way."""

    low: float
    high: float


def fixes(loop: Loop, task: ProofTask) -> tuple[Problem, ...]:
    """What was proved to mend it: a ``control.law.slope_gain``, else a slower winch, else nothing."""
    thin = Payout(*(part[:, :: (part.shape[1] - 1) // 2 or 1] for part in task.motion))  # three samples of each slab
    slowest_wave = float(np.sqrt(tension(0.0, task.motion.net.min(), loop.hanging) / loop.rho))
    tried = slowest_wave * np.geomspace(1e-4, 1e4, TRIED)
    rate = np.array([best_rate(loop._replace(beta=beta), thin) for beta in tried])
    found = _sampled_range(loop, thin, tried, rate)
    gain = _gain(loop, task, found) if found else None
    slower = None if gain else _slower_winch(loop, task, float(tried[np.argmax(rate)]))
    return tuple(filter(None, (gain, slower)))


def _gain(loop: Loop, task: ProofTask, found: Range) -> Problem | None:
    """The gain next to the scenario's that is proved, if one is."""

    def certified(beta: float) -> bool:
        return find_and_prove(loop._replace(beta=beta), task).certified

    too_small = loop.beta < np.sqrt(max(found.low, 1e-300) * min(found.high, 1e300))
    low = max(found.low, loop.beta) if too_small else found.low
    high = found.high if too_small else min(found.high, loop.beta)
    proved = Range(_proved_edge(certified, low, 1.0), _proved_edge(certified, high, -1.0))
    if proved.low < proved.high and (proved.low > 0.0 if too_small else proved.high < np.inf):
        return _range(loop, task.motion, proved, too_small)
    inside = np.geomspace(max(found.low, 1e-4 * loop.beta), min(found.high, 1e4 * loop.beta), TRIED)
    for beta in sorted(inside, key=lambda gain: abs(np.log(gain / loop.beta))):
        if certified(gain := _rounded(float(beta), 1.0)):
            return _single(loop, task.motion, gain)
    return None


def _slower_winch(loop: Loop, task: ProofTask, best: float) -> Problem | None:
    """The fastest of some slower winches that is proved, with the scenario's gain or else the one that decays best."""
    for share in SLOWER:
        for beta in (loop.beta, _rounded(best, 1.0)):
            changes = _slowed(task.winch, share)
            winch = task.winch.model_copy(update=changes)
            edges = slab_edges(winch, float(task.edges[-1]))
            slow = task._replace(winch=winch, edges=edges, motion=sampled(winch, loop.g, edges))
            if changes and find_and_prove(loop._replace(beta=beta), slow).certified:
                return _winch(loop, task.motion, changes, beta)
    return None


def _slowed(winch: Winch, share: float) -> dict[str, float]:
    """The keys of a winch that runs the same way at a share of its speed, rounded toward slower; none for a table."""
    keys = {"speed": 1.0, "top_speed": 1.0, "acceleration": 2.0, "frequency": 1.0, "duration": -1.0}
    found = {key: (getattr(winch, key, None), power) for key, power in keys.items()}
    return {k: _rounded(v * share**p, -1.0 if p > 0.0 else 1.0) for k, (v, p) in found.items() if v is not None}


def best_rate(loop: Loop, motion: Payout, *, enough: float = np.inf) -> float:
    """The largest smallest rate of V over the samples, 1/s, or one above ``enough``.

    Minus infinity where K1, K2 and K4 leave no room.
    """
    found = best_weights(loop, motion, enough=enough)
    return -np.inf if found is None else float(decay_rates(loop, motion, *found).min())


def _sampled_range(loop: Loop, motion: Payout, tried: np.ndarray, rate: np.ndarray) -> Range | None:
    """From the smallest to the largest gain with a positive rate at these samples."""

    def decays(beta: float) -> bool:
        return best_rate(loop._replace(beta=beta), motion, enough=0.0) > 0.0

    good = np.flatnonzero(rate > 0.0)
    if not good.size:
        return None
    first, last = int(good[0]), int(good[-1])
    low = _edge(decays, tried[first], tried[first - 1]) if first else 0.0
    high = _edge(decays, tried[last], tried[last + 1]) if last + 1 < TRIED else np.inf
    return Range(low, high)


def _edge(decays: Test, good: float, bad: float) -> float:
    """A gain with a positive rate, next to one without."""
    for _ in range(HALVINGS):
        middle = float(np.sqrt(good * bad))
        good, bad = (middle, bad) if decays(middle) else (good, middle)
    return good


def _proved_edge(certified: Test, edge: float, way: float) -> float:
    """The first gain of a few digits that is certified, going up or down from an edge; the far end if there is none."""
    if edge == 0.0 or not np.isfinite(edge):
        return edge
    for step in SLACK * (2.0 ** np.arange(STEPS) - 1.0):
        beta = _rounded(edge * (1.0 + step) ** way, way)
        if certified(beta):
            return beta
    return np.inf if way > 0.0 else 0.0


def _rounded(gain: float, way: float) -> float:
    context = Context(prec=DIGITS, rounding=ROUND_CEILING if way > 0.0 else ROUND_FLOOR)
    return float(context.create_decimal_from_float(gain))


def _range(loop: Loop, motion: Payout, proved: Range, too_small: bool) -> Problem:
    low, high = (f"{gain:.{DIGITS}g}" for gain in proved)
    edge, near = (f"must be at least {low} m/s", low) if too_small else (f"must not exceed {high} m/s", high)
    top = f" to {high} m/s" if np.isfinite(proved.high) else " m/s upward"
    span = f"{low}{top}" if proved.low else f"up to {high} m/s"
    proof = f"proved at {near} m/s, by samples {span}, with {SLACK:.1%} of each bound left free"
    does = _what_the_winch_does(motion)
    reason, fix = f"{does}, V is proved to decay only with such gains", f"slope_gain {edge} for {does}"
    return Problem("control.law.slope_gain", f"{loop.beta:g} m/s", proof, reason, fix)


def _single(loop: Loop, motion: Payout, gain: float) -> Problem:
    found, does = f"{gain:.{DIGITS}g} m/s", _what_the_winch_does(motion)
    reason = f"{does}, V is proved to decay with this gain and was not with yours"
    fix = f"slope_gain = {found} for {does}"
    return Problem("control.law.slope_gain", f"{loop.beta:g} m/s", f"proved at {found}", reason, fix)


def _winch(loop: Loop, motion: Payout, changes: dict[str, float], beta: float) -> Problem:
    slower = " and ".join(f"winch.{key} = {value:g}" for key, value in changes.items())
    gain = "" if beta == loop.beta else f", with control.law.slope_gain = {beta:g}"
    reason, does = "no slope_gain that was tried is certified for this motion", _what_the_winch_does(motion)
    return Problem("winch", does, f"proved with {slower}{gain}", reason, f"a slower winch: {slower}{gain}")


def _what_the_winch_does(motion: Payout) -> str:
    fastest_in, fastest_out, jerk = -float(motion.v.min()), float(motion.v.max()), float(motion.relative_jerk.min())
    parts = []
    if fastest_in > 0.0:
        parts.append(f"hauling in at {fastest_in:.3g} m/s")
    elif fastest_out > 0.0:
        parts.append(f"paying out at {fastest_out:.3g} m/s")
    if jerk < 0.0:
        parts.append(f"a jerk a'/(g - a) down to {jerk:.2g} 1/s")
    return " and ".join(parts) or "a cable of fixed length"
