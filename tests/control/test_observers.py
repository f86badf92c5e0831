"""Observers: where they start, what an absent one says, and the exact discrete form they share.

Their responses are cases of the verification, tests/reference/test_observers.py.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from umbilical.control.linear import held_input_form
from umbilical.control.observers.disturbance import (
    DisturbanceMemory,
    advance_disturbance,
    disturbance_estimate,
    make_disturbance,
    start_disturbance,
)
from umbilical.scenario.control import DisturbanceObserver
from umbilical.verify.control import PERIOD, estimated_derivative

pytestmark = pytest.mark.nojit


def test_high_gain_starts_at_rest_on_the_first_sample() -> None:
    assert np.abs(estimated_derivative(np.full(50, 7.0))).max() < 1e-11


def test_held_input_form_against_an_integration() -> None:
    a, b = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-8e6, -1.2e5, -600.0]]), np.array([0.0, 0.0, 8e6])
    form = held_input_form(a, b, PERIOD)
    for state, value in (([1.0, 0.0, 0.0], 0.0), ([0.3, -2.0, 50.0], 1.5)):
        exact = solve_ivp(
            lambda _, x, u=value: a @ x + b * u, (0.0, PERIOD), state, "DOP853", rtol=1e-12, atol=1e-12
        ).y[:, -1]
        np.testing.assert_allclose(form @ [*state, value], exact, rtol=1e-10)


@pytest.mark.parametrize("record", [None, DisturbanceObserver(enabled=False, gain=5.0, coupling=1.0)])
def test_absent_disturbance_observer_estimates_nothing(record: DisturbanceObserver | None) -> None:
    observer = make_disturbance(record, PERIOD)
    memory = DisturbanceMemory.one()
    start_disturbance(observer, memory, 500.0, 1.0)
    advance_disturbance(observer, memory, 500.0, 1.0, 1.0, 100.0)
    assert disturbance_estimate(observer, memory, 500.0, 1.0) == 0.0
