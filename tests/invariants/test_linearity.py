"""The open loop is linear: scaled by a power of two it is the same to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.verify.invariance import response

FIELDS = ("displacement", "velocity", "tip_slope", "vessel_slope")


@pytest.mark.parametrize("factor", [-1.0, 2.0**20, 2.0**-30])
def test_scaling_by_a_power_of_two_is_exact(factor: float) -> None:
    """2^20 would be steeper than the model allows, so the larger of the two starts small."""
    start = 1e-3 * min(1.0, 1.0 / abs(factor))
    one, scaled = response((110.0, 100.0), start, []), response((110.0, 100.0), factor * start, [])
    for name in FIELDS:
        np.testing.assert_array_equal(scaled[name].values, factor * one[name].values)
