"""Order in the element size on a moving domain, growing and shrinking: 5 for Dy/Dt, one more for y, 8 at the ROV.

The displacement is the integral of its slope, which gains an order; at the ROV, where waves leave through the
upwind flux, an element of degree 4 is known to be accurate to order 2 * 4 and more.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.support.manufactured import GROWING, SHRINKING, exact, solve
from tests.support.orders import orders
from umbilical.plant.layout import quadrature

GRIDS = (4, 8, 16, 32)
DRIFTS = pytest.mark.parametrize("drift", [GROWING, SHRINKING], ids=["growing", "shrinking"])


@cache
def errors(drift: float, elements: int) -> tuple[float, float, float, float]:
    """Root mean squares of the errors of y and Dy/Dt, then both at the ROV; the error in time is extrapolated away."""
    weights = quadrature(elements)
    coarse, fine = (solve(drift, elements, step) for step in (4e-4, 2e-4))
    found = [(8.0 * f - c) / 7.0 for c, f in zip(coarse, fine, strict=True)]
    off = [f - e for f, e in zip(found, exact(drift, elements), strict=True)]
    y, w = (float(np.sqrt(weights @ o**2)) for o in off)
    return y, w, abs(float(off[0][-1])), abs(float(off[1][-1]))


@DRIFTS
def test_order_in_the_element_size(drift: float) -> None:
    displacement, velocity, tip, tip_velocity = (orders([errors(drift, n)[k] for n in GRIDS[:3]]) for k in range(4))
    finest = orders([errors(drift, n)[1] for n in GRIDS[2:]])
    assert finest[-1] > 4.9
    assert velocity[-1] > 4.7
    assert 5.8 < displacement[-1] < 6.5
    assert min(tip[-1], tip_velocity[-1]) > 7.5


@DRIFTS
def test_size_of_the_error(drift: float) -> None:
    """Three elements per wave of 44 m (n = 4 on 60 m) give three digits, eight times as many give eight."""
    assert errors(drift, 4)[0] < 5e-4
    assert errors(drift, 32)[0] < 5e-9
