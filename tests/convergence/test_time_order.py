"""Order in the time step on a moving domain: 2, growing and shrinking, for y, Dy/Dt and the ROV."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from tests.support.manufactured import GROWING, SHRINKING, exact, solve
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
            assert observed[-1] == pytest.approx(2.0, abs=0.1)


@DRIFTS
def test_size_of_the_error(drift: float) -> None:
    """At 1 ms, 16 elements: below the leading term dt^2/24 y_tttt t^2/2 for y of size 1 and rates up to 2.5 rad/s."""
    displacement, _ = solve(drift, 16, 1e-3)
    assert np.abs(displacement - exact(drift, 16)[0]).max() < 1e-6 / 24.0 * 2.5**4 * 2.0**2 / 2.0
