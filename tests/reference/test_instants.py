"""Pulses and faults act at their instant: the momentum they leave, against a mass on a semi-infinite string."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.verdicts import assert_holds, each
from umbilical.verify import instants
from umbilical.verify.cases import Case


@each(instants.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)


def test_a_fault_from_the_start_and_one_at_the_end() -> None:
    assert (instants.stuck(0.0)["thrust"].values == 80.0).all()
    assert not instants.stuck(0.1)["displacement"].values.any()


def test_at_first_a_force_is_all_momentum() -> None:
    assert instants.velocity_after(80.0, np.array(1e-6)) == pytest.approx(80.0 * 1e-6 / 500.0, rel=1e-6)
