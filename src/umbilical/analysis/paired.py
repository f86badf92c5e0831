"""Statistics of paired samples: the same draws, treated in two ways or more.

A sample may hold infinities, for what is worse than any number (a run that diverged), and not-a-numbers, for what is
no possible system and is left out of every comparison. So order statistics are used, never means, and nothing is
interpolated. Resampling has a fixed seed: the same samples have the same intervals.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

LEVEL = 0.95
"""Confidence of every interval."""
_RESAMPLES = 2000
_SEED = 20221110
_AT_ONCE = 2_000_000


class Estimate(NamedTuple):
    """A number with the bounds of its 95 % confidence interval."""

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
    """Quantile of a sample with its bootstrap interval.

    >>> quantile(np.arange(1.0, 102.0), 0.5).value
    51.0
    """
    return _bootstrap(values[~np.isnan(values)], share)


def exceedance(values: np.ndarray, limit: float) -> Estimate:
    """Probability that a value exceeds a limit, with its Wilson interval.

    Wilson's interval (1927) keeps its confidence for probabilities near 0 and 1, where the usual one has no width.

    >>> exceedance(np.zeros(100), 1.0).value, round(exceedance(np.zeros(100), 1.0).high, 3)
    (0.0, 0.037)
    """
    sound = values[~np.isnan(values)]
    return share(int(np.count_nonzero(sound > limit)), sound.size)


def share(count: float, of: int) -> Estimate:
    """A share with its Wilson interval; all of it open where nothing was seen."""
    from scipy.special import ndtri

    if of == 0:
        return Estimate(float("nan"), 0.0, 1.0)
    z, p = float(ndtri(0.5 + LEVEL / 2.0)), count / of
    centre, spread = p + z * z / (2 * of), z * float(np.sqrt(p * (1 - p) / of + z * z / (4 * of * of)))
    scale = 1.0 + z * z / of
    low, high = (centre - spread) / scale, (centre + spread) / scale
    return Estimate(float(p), low if count > 0 else 0.0, high if count < of else 1.0)


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
    return Comparison(one.size, _bootstrap(ratio, 0.5), _bootstrap(difference, 0.5), share(wins, one.size))


def _bootstrap(sample: np.ndarray, share: float) -> Estimate:
    """An order statistic with its percentile bootstrap interval (Efron)."""
    if sample.size == 0:
        return Estimate(float("nan"), float("nan"), float("nan"))
    ordered = np.sort(sample)
    rank = _rank(share, ordered.size)
    generator = np.random.default_rng(_SEED)
    found: list[np.ndarray] = []
    at_once = max(1, _AT_ONCE // ordered.size)
    for begin in range(0, _RESAMPLES, at_once):
        size = (min(at_once, _RESAMPLES - begin), ordered.size)
        drawn = generator.integers(0, ordered.size, size, dtype=np.int32)
        found.append(np.partition(drawn, rank, axis=1)[:, rank])  # the order of places is that of values
    places = np.sort(np.concatenate(found))
    low, high = (places[_rank(level, places.size)] for level in ((1 - LEVEL) / 2, (1 + LEVEL) / 2))
    return Estimate(float(ordered[rank]), float(ordered[low]), float(ordered[high]))


def _rank(share: float, size: int) -> int:
    """Place of a quantile in a sorted sample: the smallest value that the share of all does not exceed."""
    return min(max(int(np.ceil(share * size)) - 1, 0), size - 1)
