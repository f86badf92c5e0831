"""What would mend a certificate that does not hold: the slope gains that can be certified.

Samples find the edges of their range. What is printed lies inside of them and is itself proved, digit by digit: a
cure that is followed is certified.
"""

from __future__ import annotations

from collections.abc import Callable
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from typing import NamedTuple

import numpy as np

from umbilical.analysis.certificate.attempt import Task, attempt
from umbilical.analysis.certificate.conditions import SLACK, rates
from umbilical.analysis.certificate.search import best_weights
from umbilical.analysis.certificate.setting import Loop, Motion
from umbilical.errors import Problem

TRIED, HALVINGS = 25, 10
DIGITS = 4
"""Digits of a gain that is recommended; it is tried with just these."""
STEPS = 8
"""Steps away from the sampled edge, each twice as long as the last, until a gain is proved."""

Test = Callable[[float], bool]


class Range(NamedTuple):
    """Gains that can be certified: from ``low`` to ``high``, m/s; 0 and infinity where nothing was in the way."""

    low: float
    high: float


def cures(loop: Loop, task: Task) -> tuple[Problem, ...]:
    """The range of ``control.law.slope_gain`` in which a positive rate is proved, or that there is none."""
    found = _sampled_range(loop, task.motion)
    if found is None:
        return (_no_gain(task.motion),)

    def certified(beta: float) -> bool:
        return attempt(loop._replace(beta=beta), task).certified

    too_small = loop.beta < np.sqrt(found.low * min(found.high, 1e300))
    low = max(found.low, loop.beta) if too_small else found.low
    high = found.high if too_small else min(found.high, loop.beta)
    proved = Range(_proved_edge(certified, low, 1.0), _proved_edge(certified, high, -1.0))
    if not proved.low < proved.high:
        return (_no_gain(task.motion),)
    return (_range(loop, task.motion, proved, too_small),)


def best_rate(loop: Loop, motion: Motion, *, enough: float = np.inf) -> float:
    """The largest smallest rate of V over the samples, 1/s, or one above ``enough``.

    Minus infinity where K1, K2 and K4 leave no room.
    """
    found = best_weights(loop, motion, enough=enough)
    return -np.inf if found is None else float(rates(loop, motion, *found).min())


def _sampled_range(loop: Loop, motion: Motion) -> Range | None:
    """From the smallest to the largest gain with a positive rate at three samples of each slab."""
    thin = Motion(*(part[:, :: (part.shape[1] - 1) // 2 or 1] for part in motion))

    def decays(beta: float) -> bool:
        return best_rate(loop._replace(beta=beta), thin, enough=0.0) > 0.0

    slowest_wave = float(np.sqrt(loop.m * (loop.g - motion.a.max()) / loop.rho))
    tried = slowest_wave * np.geomspace(1e-4, 1e4, TRIED)
    good = [k for k in range(TRIED) if decays(tried[k])]
    if not good:
        return None
    first, last = good[0], good[-1]
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


def _range(loop: Loop, motion: Motion, proved: Range, too_small: bool) -> Problem:
    low, high = (f"{gain:.{DIGITS}g}" for gain in proved)
    edge = f"must be at least {low} m/s" if too_small else f"must not exceed {high} m/s"
    top = f" to {high} m/s" if np.isfinite(proved.high) else " m/s upward"
    return Problem(
        "control.law.slope_gain",
        f"{loop.beta:g} m/s",
        (f"{low}{top}" if proved.low else f"up to {high} m/s") + f", with {SLACK:.1%} of each bound left free",
        f"{_what_the_winch_does(motion)}, V is proved to decay only with such gains",
        f"slope_gain {edge} for {_what_the_winch_does(motion)}",
    )


def _no_gain(motion: Motion) -> Problem:
    return Problem(
        "winch",
        _what_the_winch_does(motion),
        "a gentler motion",
        "no slope_gain can be certified for it",
        "a slower winch, or one that speeds up and brakes more gently",
    )


def _what_the_winch_does(motion: Motion) -> str:
    fastest_in, fastest_out, jerk = -float(motion.v.min()), float(motion.v.max()), float(motion.jerk.min())
    parts = []
    if fastest_in > 0.0:
        parts.append(f"hauling in at {fastest_in:.3g} m/s")
    elif fastest_out > 0.0:
        parts.append(f"paying out at {fastest_out:.3g} m/s")
    if jerk < 0.0:
        parts.append(f"a jerk a'/(g - a) down to {jerk:.2g} 1/s")
    return " and ".join(parts) or "a cable of fixed length"
