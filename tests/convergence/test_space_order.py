"""Order in the element size on a moving domain: 4 for Dy/Dt, 5 for y, growing and shrinking.

The scheme has no dissipation, so errors of waves that the grid carries wrongly stay and interfere: orders of
single pairs of grids scatter by half of one about these.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.support.manufactured import GROWING, SHRINKING, exact, solve
from tests.support.orders import orders
from umbilical.plant.layout import quadrature

GRIDS = (8, 16, 32)


@cache
def errors(drift: float, elements: int) -> tuple[float, float]:
    """Root mean squares of the errors of y and Dy/Dt, the error in time taken out by extrapolation."""
    weights = quadrature(elements)
    coarse, fine = (solve(drift, elements, step) for step in (8e-4, 4e-4))
    found = [(4.0 * f - c) / 3.0 for c, f in zip(coarse, fine, strict=True)]
    y, w = (np.sqrt(weights @ (f - e) ** 2) for f, e in zip(found, exact(drift, elements), strict=True))
    return float(y), float(w)


@pytest.mark.parametrize("drift", [GROWING, SHRINKING], ids=["growing", "shrinking"])
def test_order_in_the_element_size(drift: float) -> None:
    displacement, velocity = (orders([errors(drift, n)[k] for n in GRIDS]) for k in range(2))
    assert displacement.mean() > 4.9
    assert velocity.mean() > 3.9
    assert displacement[-1] > 4.5
    assert velocity[-1] > 3.9
    assert velocity.max() < 5.5, "a higher order than stated wants an explanation"


@pytest.mark.parametrize("drift", [GROWING, SHRINKING], ids=["growing", "shrinking"])
def test_size_of_the_error(drift: float) -> None:
    """Three elements per wave of 44 m (n = 4 on 60 m) give three digits, eight times as many give eight."""
    assert errors(drift, 8)[0] < 5e-6
    assert errors(drift, 32)[0] < 5e-9
