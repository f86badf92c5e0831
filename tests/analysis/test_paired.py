"""Intervals cover what they claim to, and infinities and gaps are treated as documented."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from umbilical.analysis.paired import LEVEL, compare, exceedance_probability, proportion, quantile, ranks

SHARES = (0.5, 0.9, 0.95, 0.99)
SIZES = range(8, 1001)


def coverage(low: int, high: int, size: int, share: float) -> float:
    """Probability that a quantile lies between two ranks: as many values as a binomial number are below it."""
    return float(stats.binom.cdf(high - 1, size, share) - stats.binom.cdf(low - 1, size, share))


@pytest.mark.parametrize("level", SHARES)
def test_the_interval_of_a_quantile_covers_it_as_often_as_it_says(level):
    """Computed, not sampled: for every size at least 95 %, and no more than 2.5 % to either side."""
    for size in SIZES:
        low, high = ranks(level, size)
        assert coverage(low, high, size, level) >= LEVEL
        assert stats.binom.cdf(low, size, level) > 0.025, "the next rank would be too high"
        assert stats.binom.sf(high - 2, size, level) > 0.025, "the last rank would be too low"


@pytest.mark.parametrize(("level", "enough"), [(0.5, 6), (0.9, 36), (0.95, 72), (0.99, 368)])
def test_an_end_is_open_until_the_sample_is_large_enough(level, enough):
    ends = [quantile(np.arange(float(size)), level).high for size in range(1, 1001)]
    assert [np.isfinite(end) for end in ends] == [size >= enough for size in range(1, 1001)]
    assert quantile(np.arange(5.0), 0.5)[1:] == (-np.inf, np.inf)


def test_the_test_of_coverage_finds_resampled_intervals_too_narrow():
    """Negative control: the ranks of a percentile bootstrap, 95 % quantile of 20 and median of 8."""
    assert coverage(17, 20, 20, 0.95) < 0.7
    assert coverage(2, 6, 8, 0.5) < 0.85


@pytest.mark.parametrize(("size", "level"), [(20, 0.95), (100, 0.95), (80, 0.5)])
def test_so_it_does_of_samples_that_are_drawn_continuous_or_not(size, level):
    generator = np.random.default_rng(3)
    for drawn, truth in (
        (generator.normal(size=(400, size)), stats.norm.ppf(level)),
        (generator.poisson(3.0, size=(400, size)).astype(float), stats.poisson.ppf(level, 3.0)),
    ):
        found = [quantile(sample, level) for sample in drawn]
        assert np.mean([low <= truth <= high for _, low, high in found]) > 0.93
        assert np.mean([low <= truth - 2.0 for _, low, _ in found]) < 0.8


@pytest.mark.parametrize("size", [8, 20, 50, 200, 1000])
def test_the_interval_of_a_share_covers_it_as_often_as_it_says(size):
    intervals = np.array([proportion(count, size)[1:] for count in range(size + 1)])
    for truth in np.linspace(0.001, 0.999, 250):
        held = (intervals[:, 0] <= truth) & (truth <= intervals[:, 1])
        assert stats.binom.pmf(np.arange(size + 1), size, truth)[held].sum() >= LEVEL - 1e-12


@pytest.mark.parametrize(("count", "of"), [(0, 50), (1, 50), (25, 50), (50, 50), (731, 1000)])
def test_the_interval_of_a_share_is_that_of_clopper_and_pearson(count, of):
    truth = stats.binomtest(count, of).proportion_ci(method="exact")
    assert proportion(count, of)[1:] == pytest.approx((truth.low, truth.high), abs=1e-9)
    assert proportion(max(count - 0.5, 0), of).low <= truth.low


def test_of_nothing_nothing_is_known():
    assert proportion(0, 0)[1:] == (0.0, 1.0)


def test_pairing_finds_what_two_samples_hide():
    """A gain of 1 % under a spread of a factor of ten: certain by pairs, invisible without them."""
    generator = np.random.default_rng(2)
    reference = np.exp(generator.normal(0.0, 1.0, 300))
    values = reference * 0.99 * np.exp(generator.normal(0.0, 0.005, 300))
    found = compare(values, reference)
    assert found.ratio.high < 1.0
    assert found.ratio.low < 0.99 < found.ratio.high
    assert found.better.low > 0.9
    shuffled = compare(generator.permutation(values), reference)
    assert shuffled.ratio.low < 1.0 < shuffled.ratio.high


def test_diverged_is_worse_than_any_number_and_refused_is_left_out():
    reference = np.array([1.0, 1.0, np.inf, np.inf, np.nan])
    values = np.array([0.5, np.inf, 2.0, np.inf, 3.0])
    found = compare(values, reference)
    assert found.members == 4
    assert found.better.value == pytest.approx((2 + 0.5) / 4)
    assert exceedance_probability(values, 1.0).value == pytest.approx(4 / 5)
    assert quantile(np.array([1.0, 2.0, np.inf]), 0.95).value == np.inf
