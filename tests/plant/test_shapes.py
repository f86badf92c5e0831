"""Shapes at the start and profiles of the loads, at the nodes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.scenarios import constant, open_loop
from umbilical.plant.exogenous import profiles
from umbilical.plant.initial import initial_slopes
from umbilical.plant.layout import integrate, positions
from umbilical.plant.signals import vessel

pytestmark = pytest.mark.nojit

SIGMA = positions(6)


def started(**overrides: Any) -> np.ndarray:
    scenario = open_loop(winch__length=200.0, grid__elements=6, **overrides)
    return vessel(scenario.environment, 0.0)[0] + integrate(initial_slopes(scenario))


@pytest.mark.parametrize(
    ("shape", "exact"),
    [
        ({"shape": "straight"}, 0.0 * SIGMA),
        ({"shape": "sine", "amplitude": 0.3, "half_waves": 1.5}, 0.3 * np.sin(1.5 * np.pi * SIGMA)),
        (
            {"shape": "gaussian", "amplitude": 2.0, "distance": 80.0, "width": 15.0},
            2.0 * np.exp(-(((200.0 * (1.0 - SIGMA) - 80.0) / 15.0) ** 2)),
        ),
        ({"shape": "static", "force": 50.0}, 50.0 / 20.0 * np.log(900.0 / (500.0 + 400.0 * (1.0 - SIGMA)))),
        (
            {"shape": "table", "positions": [0.0, 0.3, 0.6, 1.0], "displacements": [0.0, 0.027, 0.216, 1.0]},
            SIGMA**3,
        ),
    ],
    ids=lambda value: value["shape"] if isinstance(value, dict) else "",
)
def test_shapes_at_the_start(shape: dict[str, Any], exact: np.ndarray) -> None:
    """At the interfaces to the last digits; inside, as near as a polynomial of an element comes."""
    found = started(initial=shape)
    np.testing.assert_allclose(found[::4], exact[::4], atol=1e-12)
    np.testing.assert_allclose(found, exact, atol=4e-2 if shape["shape"] == "gaussian" else 2e-5)


def test_static_shape_under_constant_tension_is_a_line() -> None:
    shape = started(initial={"shape": "static", "force": 50.0}, cable__wet_line_density=0.0)
    np.testing.assert_allclose(shape, 50.0 * 200.0 * SIGMA / 5000.0, rtol=1e-13, atol=1e-14)


def test_static_shape_of_a_very_light_cable_keeps_its_digits() -> None:
    shape = started(initial={"shape": "static", "force": 50.0}, cable__wet_line_density=1e-9)
    np.testing.assert_allclose(shape, 50.0 * 200.0 * SIGMA / 5000.0, rtol=1e-8, atol=1e-14)


def test_the_upper_end_is_where_the_vessel_is() -> None:
    shape = {"shape": "table", "positions": [0.0, 0.3, 0.6, 1.0], "displacements": [0.7, 0.4, 0.2, 0.0]}
    shifted = started(initial=shape, environment__vessel_motion=[constant(0.7)])
    assert shifted[0] == 0.7
    assert shifted[-1] == pytest.approx(0.0, abs=1e-15)


def test_profiles_of_the_loads() -> None:
    shapes: list[dict[str, Any]] = [
        {"shape": "uniform"},
        {"shape": "sine", "half_waves": 3},
        {"shape": "gaussian", "center": 0.4, "width": 0.1},
        {"shape": "table", "positions": [0.0, 0.5, 1.0], "values": [1.0, 0.0, 2.0]},
    ]
    loads = [{"profile": shape, "signal": [constant(1.0)]} for shape in shapes]
    found = profiles(open_loop(grid__elements=6, environment__cable_load=loads))
    exact = [
        np.ones_like(SIGMA),
        np.sin(3.0 * np.pi * SIGMA),
        np.exp(-(((SIGMA - 0.4) / 0.1) ** 2)),
        np.where(SIGMA < 0.5, 1.0 - 2.0 * SIGMA, 4.0 * SIGMA - 2.0),
    ]
    np.testing.assert_allclose(found, exact, atol=1e-15)
    assert profiles(open_loop(grid__elements=6)).shape == (0, 25)
