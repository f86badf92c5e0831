"""Statistics of paired samples: the same draws, treated in two ways or more.

A sample may hold infinities, for what is worse than any number (a run that diverged), and not-a-numbers, for what is
no possible system and is left out of every comparison. So order statistics are used, never means, and nothing is
interpolated. Intervals are exact: for independent draws from whatever distribution they hold the truth at least as
often as they say, for any number of draws.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

LEVEL = 0.95
"""Confidence of every interval."""
_TAIL = (1.0 - LEVEL) / 2.0


class Estimate(NamedTuple):
    """A number with the bounds of its 95 % confidence interval; an infinite bound is an open end."""

    value: float
    low: float
    high: float


class Comparison(NamedTuple):
    """One treatment against another on the same draws.

    Attributes:
        members: draws compared.
        ratio: median over draws of the one's value over the other's.
        difference: median over draws of the one's value less the other's.
        better: share of draws in which the one is smaller; both equal counts half.
    """

    members: int
    ratio: Estimate
    difference: Estimate
    better: Estimate


def quantile(values: np.ndarray, share: float) -> Estimate:
    """Quantile of a sample with its exact interval, which ends at two of the sample's values.

    An end is open where the sample is too small: the 95 % quantile has an upper bound from 72 values on.

    >>> quantile(np.arange(1.0, 102.0), 0.5)
    Estimate(value=51.0, low=41.0, high=61.0)
    >>> quantile(np.arange(1.0, 21.0), 0.95)
    Estimate(value=19.0, low=17.0, high=inf)
    """
    ordered = np.sort(values[~np.isnan(values)])
    if ordered.size == 0:
        return Estimate(float("nan"), float("nan"), float("nan"))
    low, high = ranks(share, ordered.size)
    bounded = np.concatenate([[-np.inf], ordered, [np.inf]])
    return Estimate(float(ordered[_rank(share, ordered.size)]), float(bounded[low]), float(bounded[high]))


def ranks(share: float, size: int) -> tuple[int, int]:
    """Ranks, from 1, of the two values of a sorted sample between which a quantile lies with at least 95 %.

    As many values as a binomial number, of ``size`` and ``share``, lie below the quantile; 2.5 % at most are left out
    on either side (Conover, Practical Nonparametric Statistics, 3.2). Rank 0 and rank ``size`` + 1 are open ends.

    >>> ranks(0.5, 100), ranks(0.95, 71), ranks(0.95, 72)
    ((40, 61), (63, 72), (64, 72))
    """
    from scipy.special import bdtr

    below = bdtr(np.arange(size + 1), size, share)
    return int(np.searchsorted(below, _TAIL)), int(np.searchsorted(below, 1.0 - _TAIL)) + 1


def exceedance_probability(values: np.ndarray, limit: float) -> Estimate:
    """Probability that a value exceeds a limit, with its exact interval.

    >>> exceedance_probability(np.zeros(100), 1.0).value, round(exceedance_probability(np.zeros(100), 1.0).high, 3)
    (0.0, 0.036)
    """
    sound = values[~np.isnan(values)]
    return proportion(int(np.count_nonzero(sound > limit)), sound.size)


def proportion(count: float, of: int) -> Estimate:
    """A share with the interval of Clopper and Pearson (1934); all of it open where nothing was seen.

    Halves may be counted, for ties: the bounds grow with the count, and lie between those of its neighbours.
    """
    from scipy.special import betaincinv

    if of == 0:
        return Estimate(float("nan"), 0.0, 1.0)
    low = float(betaincinv(count, of - count + 1, _TAIL)) if count > 0 else 0.0
    high = float(betaincinv(count + 1, of - count, 1.0 - _TAIL)) if count < of else 1.0
    return Estimate(count / of, low, high)


def compare(values: np.ndarray, reference: np.ndarray) -> Comparison:
    """Compare paired samples; where both are infinite they are equal.

    >>> found = compare(np.array([1.0, 2.0, np.inf]), np.array([2.0, 4.0, np.inf]))
    >>> found.ratio.value, round(found.better.value, 3)
    (0.5, 0.833)
    """
    sound = ~(np.isnan(values) | np.isnan(reference))
    one, other = values[sound], reference[sound]
    equal = one == other
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.where(equal, 1.0, one / other)
        difference = np.where(equal, 0.0, one - other)
    wins = float(np.count_nonzero(one < other) + 0.5 * np.count_nonzero(equal))
    return Comparison(one.size, quantile(ratio, 0.5), quantile(difference, 0.5), proportion(wins, one.size))


def _rank(share: float, size: int) -> int:
    """Place of a quantile in a sorted sample: the smallest value that the share of all does not exceed."""
    return min(max(int(np.ceil(share * size)) - 1, 0), size - 1)
