"""Order in the time step on a moving domain: 3, growing and shrinking, for y, Dy/Dt and the ROV."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from tests.support.manufactured import GROWING, SHRINKING, solve
from tests.support.orders import orders

STEPS = (4e-3, 2e-3, 1e-3, 5e-4)
DRIFTS = pytest.mark.parametrize("drift", [GROWING, SHRINKING], ids=["growing", "shrinking"])


@DRIFTS
def test_order_in_the_step(drift: float) -> None:
    """Differences of successive solutions on one grid: the grid's own error drops out."""
    solutions = [solve(drift, 8, step) for step in STEPS]
    for field in range(2):
        changes = [b[field] - a[field] for a, b in pairwise(solutions)]
        for observed in (orders([np.abs(c).max() for c in changes]), orders([abs(c[-1]) for c in changes])):
            assert observed[-1] == pytest.approx(3.0, abs=0.1)


@DRIFTS
def test_size_of_the_error(drift: float) -> None:
    """At 1 ms: below the leading term 3/8 dt^3 y_tttt t for y of size 1 and rates up to 2.5 rad/s."""
    (coarse, _), (fine, _) = solve(drift, 16, 1e-3), solve(drift, 16, 2.5e-4)
    assert np.abs(coarse - fine).max() < 3.0 / 8.0 * 1e-9 * 2.5**4 * 2.0 * 5.0
