"""The closed loop: peaks that two other codes agree on, and the law in continuous time in one integration."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.verdicts import assert_holds, each
from umbilical.verify import whole_loop
from umbilical.verify.cases import Case


@each(whole_loop.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)


@pytest.mark.slow
def test_the_reference_does_not_depend_on_its_degree() -> None:
    """To a fifth of what the case asks of the engine, the displacement to a hundredth."""
    for found, finer, share in zip(whole_loop.reference(), whole_loop.reference(32), (5e-6, 1e-6, 4e-6), strict=True):
        assert np.abs(found - finer).max() < share * np.abs(found).max()
