"""What would mend a certificate that does not hold: the slope gains that can be certified, found by trying them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from umbilical.analysis.certificate.conditions import rates
from umbilical.analysis.certificate.search import best_weights
from umbilical.analysis.certificate.setting import Loop, Motion
from umbilical.errors import Problem

TRIED, HALVINGS = 25, 10


def cures(loop: Loop, motion: Motion) -> tuple[Problem, ...]:
    """The range of ``control.law.slope_gain`` in which a positive rate can be certified, or that there is none."""
    thin = Motion(*(part[:, :: (part.shape[1] - 1) // 2 or 1] for part in motion))

    def certified(beta: float) -> bool:
        return best_rate(loop._replace(beta=beta), thin, enough=0.0) > 0.0

    slowest_wave = float(np.sqrt(loop.m * (loop.g - motion.a.max()) / loop.rho))
    tried = slowest_wave * np.geomspace(1e-4, 1e4, TRIED)
    good = [k for k in range(TRIED) if certified(tried[k])]
    if not good:
        return (_no_gain(motion),)
    first, last = good[0], good[-1]
    low = _edge(certified, tried[first], tried[first - 1]) if first else 0.0
    high = _edge(certified, tried[last], tried[last + 1]) if last + 1 < TRIED else np.inf
    return (_range(loop, motion, low, high),)


def best_rate(loop: Loop, motion: Motion, *, enough: float = np.inf) -> float:
    """The largest smallest rate of V over the samples, 1/s, or one above ``enough``.

    Minus infinity where K1, K2 and K4 leave no room.
    """
    found = best_weights(loop, motion, enough=enough)
    return -np.inf if found is None else float(rates(loop, motion, *found).min())


def _edge(certified: Callable[[float], bool], good: float, bad: float) -> float:
    """A gain that can be certified, next to one that cannot."""
    for _ in range(HALVINGS):
        middle = float(np.sqrt(good * bad))
        good, bad = (middle, bad) if certified(middle) else (good, middle)
    return good


def _range(loop: Loop, motion: Motion, low: float, high: float) -> Problem:
    too_small = loop.beta < low
    edge = f"must exceed {low:.3g} m/s" if too_small else f"must stay below {high:.3g} m/s"
    top = f" to {high:.3g} m/s" if np.isfinite(high) else " m/s upward"
    return Problem(
        "control.law.slope_gain",
        f"{loop.beta:g} m/s",
        f"{low:.3g}{top}" if low else f"below {high:.3g} m/s",
        f"{_what_the_winch_does(motion)}, V decays for certain only with such gains",
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
