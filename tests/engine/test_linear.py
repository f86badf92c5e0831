"""The step as a matrix is the step that runs."""

from __future__ import annotations

import numpy as np
import pytest

import umbilical
from tests.support.scenarios import constant, open_loop, run, sine
from umbilical.engine.linear import step_matrix

pytestmark = pytest.mark.nojit


def test_its_powers_are_a_run() -> None:
    start = {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5}
    scenario = open_loop(
        winch__length=100.0, grid__elements=4, initial=start, duration=0.05, output__interval=1e-3, cable__damping=0.3,
        payload__damping=20.0,
    )  # fmt: skip
    result, matrix = run(scenario), step_matrix(scenario)
    y, w = (result[name].values[:, 1:] for name in ("displacement", "velocity"))
    # The acceleration it keeps at first is that of the start: what one step makes of rest in this shape.
    acceleration = (matrix[16:32, :16] @ y[0] - w[0]) / 1e-3
    state = np.concatenate([y[0], w[0], acceleration])
    state[32:] = np.linalg.lstsq(matrix[16:32, 32:], w[1] - matrix[16:32, :32] @ state[:32], rcond=None)[0]
    for k in range(1, 51):
        state = matrix @ state
        np.testing.assert_allclose(state[:16], y[k], atol=1e-12)
        np.testing.assert_allclose(state[16:32], w[k], atol=1e-12 * np.abs(w).max() + 1e-12)


def test_loads_motors_and_vessel_are_left_out() -> None:
    grid = {"grid.elements": 4, "winch": {"law": "constant", "length": 450.0}}
    bare = step_matrix(umbilical.load("paper-none", grid | {"environment.payload_force": []}))
    loud = {
        "environment.vessel_motion": [sine(1.0, 2.0, np.pi / 2)],
        "environment.vessel_ramp": 1.0,
        "environment.cable_load": [{"profile": {"shape": "uniform"}, "signal": [constant(3.0)]}],
    }
    np.testing.assert_array_equal(step_matrix(umbilical.load("paper-adaptive", grid | loud)), bare)


def test_the_winch_stops_where_it_is_asked_to() -> None:
    scenario = umbilical.load("paper", {"grid.elements": 4})
    at_end = step_matrix(scenario, 50.0)
    fixed = step_matrix(scenario.replace({"winch": {"law": "constant", "length": 500.0}}))
    np.testing.assert_allclose(at_end, fixed, rtol=1e-12, atol=1e-15)
    assert np.abs(at_end - step_matrix(scenario, 0.0)).max() > 1e-9
