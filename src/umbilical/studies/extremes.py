"""What a Gumbel distribution fitted to the largest values of runs says, and how sure that is."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.stats import gumbel_r

from umbilical.analysis.paired import LEVEL, Estimate

Gumbel = tuple[float, float]
"""Location and scale."""


def fit_gumbel(
    values: np.ndarray, read: Callable[[Gumbel], float], *, again: int, seed: int,
    fit: Callable[[np.ndarray], Gumbel] = gumbel_r.fit,
) -> tuple[Gumbel, Estimate]:  # fmt: skip
    """A Gumbel distribution and what is read off it, with the interval of the parametric bootstrap.

    Args:
        values: the largest values, shape (blocks,).
        read: what is read off a distribution.
        again: samples drawn from the distribution, which are fitted and read in their turn.
        seed: of those samples.
        fit: location and scale of a sample; by maximum likelihood by default.
    """
    best = fit(values)
    drawn = gumbel_r.rvs(*best, size=(again, values.size), random_state=np.random.default_rng(seed))
    low, high = np.quantile([read(fit(sample)) for sample in np.asarray(drawn)], [0.5 - LEVEL / 2.0, 0.5 + LEVEL / 2.0])
    return (float(best[0]), float(best[1])), Estimate(float(read(best)), float(low), float(high))
