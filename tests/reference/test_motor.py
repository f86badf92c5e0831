"""The motor of eq. (15): steady state, step from rest, reversal through zero, poles, and L -> 0."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.verdicts import assert_holds, each
from umbilical.relations.formulas import steady_speed
from umbilical.scenario.hardware import Motor
from umbilical.verify import control
from umbilical.verify.cases import Case
from umbilical.verify.control import MOTOR, VOLTAGE
from umbilical.verify.references.motor import steady_state


@each(control.MOTORS)
def test_case(case: Case) -> None:
    assert_holds(case)


def test_the_steady_state_is_the_printed_one() -> None:
    """75.015 V hold 50 rad/s at 625.1875 A."""
    assert steady_state(MOTOR, VOLTAGE) == pytest.approx((50.0, 625.1875), rel=1e-13)
    for sign in (1.0, -1.0):
        assert steady_speed(Motor.model_validate(MOTOR), sign * VOLTAGE) == pytest.approx(sign * 50.0, rel=1e-14)


def test_the_poles_without_a_propeller_are_a_pair() -> None:
    """So the answer rings, and a step of real exponentials would be noticed."""
    matrix = np.array([[-0.015 / 0.5, 4.0 / 0.5], [-0.5 / 0.002, -0.08 / 0.002]])
    assert np.linalg.eigvals(matrix).imag.max() > 20.0
