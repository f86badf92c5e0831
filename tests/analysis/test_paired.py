"""Intervals cover what they claim to, and infinities and gaps are treated as documented."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from umbilical.analysis.paired import compare, exceedance, quantile, share


@pytest.mark.parametrize(("count", "of"), [(0, 50), (1, 50), (25, 50), (50, 50), (731, 1000)])
def test_the_interval_of_a_share_is_wilsons(count, of):
    truth = stats.binomtest(count, of).proportion_ci(method="wilson")
    assert share(count, of)[1:] == pytest.approx((truth.low, truth.high), abs=1e-12)


def test_of_nothing_nothing_is_known():
    assert share(0, 0)[1:] == (0.0, 1.0)


@pytest.mark.parametrize("level", [0.5, 0.9])
def test_the_interval_of_a_quantile_covers_it_as_often_as_it_says(level):
    """300 samples of 80: 95 % of the intervals hold the truth; one resampled without spread would not."""
    generator = np.random.default_rng(3)
    truth = stats.norm.ppf(level)
    found = [quantile(generator.normal(size=80), level) for _ in range(300)]
    covered = np.mean([low <= truth <= high for _, low, high in found])
    assert 0.90 < covered < 0.99
    assert np.mean([low <= truth + 0.5 <= high for _, low, high in found]) < 0.5


def test_intervals_are_the_same_again():
    sample = np.random.default_rng(1).normal(size=200)
    assert quantile(sample, 0.5) == quantile(sample.copy(), 0.5)


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
    assert exceedance(values, 1.0).value == pytest.approx(4 / 5)
    assert quantile(np.array([1.0, 2.0, np.inf]), 0.95).value == np.inf
