"""Deflection under a steady force P on the ROV: ``y = P/(rho g) ln((m + rho l)/(m + rho (l - x)))``."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.modes import released_tip
from tests.support.scenarios import UNDAMPED, constant, open_loop, run

FORCE = 100.0
TOLERANCE = 1e-5


def closed_form(sigma: np.ndarray, length: float = 500.0) -> np.ndarray:
    return FORCE / 20.0 * np.log((500.0 + 2.0 * length) / (500.0 + 2.0 * length * (1.0 - sigma)))


def test_stiffness_at_the_payload() -> None:
    assert FORCE / closed_form(np.array([1.0]))[0] == pytest.approx(18.2, abs=0.01)


@pytest.mark.parametrize("damping", [0.0, 0.001])
def test_static_shape_stays(damping: float) -> None:
    scenario = open_loop(initial={"shape": "static", "force": FORCE}, duration=40.0, cable__damping=damping)
    found = run(scenario.replace({"environment.payload_force": [constant(FORCE)]}))["displacement"]
    exact = closed_form(found["sigma"].values)
    np.testing.assert_allclose(found.values[0], exact, rtol=1e-13, atol=1e-14)
    assert np.abs(found.values - exact).max() < TOLERANCE * exact[-1]


def test_cable_settles_in_the_static_shape() -> None:
    """Proportional damping takes 0.15 1/s out of every mode: after 120 s nothing else is left."""
    scenario = open_loop(duration=120.0, cable__damping=0.6, payload__damping=150.0)
    found = run(scenario.replace({"environment.payload_force": [constant(FORCE)]}))["displacement"]
    exact = closed_form(found["sigma"].values)
    assert np.abs(found.values[-1] - exact).max() < TOLERANCE * exact[-1]


def test_release_is_the_sum_of_the_modes() -> None:
    scenario = open_loop(initial={"shape": "static", "force": FORCE}, duration=60.0).replace(UNDAMPED)
    found = run(scenario)["tip_displacement"]
    exact = released_tip(FORCE, 2.0, 500.0, 500.0, found["time"].values)
    assert np.abs(found.values - exact).max() < TOLERANCE * np.abs(exact).max()
