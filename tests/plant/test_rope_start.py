"""How a rope starts: at rest in its current, held where something holds it, or in a shape of the string's."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from umbilical.errors import ScenarioError
from umbilical.library import load
from umbilical.plant.exogenous import Steps
from umbilical.plant.rope.assemble import at_rest, initial_rope, rope_of
from umbilical.plant.rope.outside import RopeSampler, still_water
from umbilical.plant.rope.rates import evaluate_rope
from umbilical.plant.rope.water import stir

pytestmark = pytest.mark.nojit
CURRENT = {
    "depths": [0.0, 1000.0], "speeds": [0.5, 0.1], "speeds_across": [0.0, 0.2],
    "variation": [{"kind": "constant", "value": -0.5}, {"kind": "sine", "amplitude": 0.2, "frequency": 0.3}],
}  # fmt: skip
HELD: dict[str, Any] = {"model": "rope", "rope.elements": 3, "environment.water.current": CURRENT}


def started(changes: dict[str, Any]) -> Any:
    scenario = load("work-class-1000m-current", HELD | changes)
    rope, water = rope_of(scenario), still_water(scenario)
    return scenario, rope, water, initial_rope(scenario, rope, water)


@pytest.mark.parametrize("tip", [None, 0.0, 3.0])
def test_it_is_at_rest_in_the_current_and_where_it_is_held(tip: float | None) -> None:
    load_there = [{"profile": {"shape": "uniform"}, "signal": [{"kind": "constant", "value": 0.2}]}]
    scenario, rope, water, state = started({"initial.tip": tip, "environment.cable_load": load_there})
    evaluate_rope(rope, state, state.outside[0], np.array([0.2]), water, 0, False)
    assert np.abs(state.rate).max() < 1e-3  # 0.03 m/s2 without the load
    assert np.abs(state.body[2]).max() < 1e-4
    force = at_rest(scenario, rope, water)[1].force
    if tip is None:
        assert not force.any()
    else:
        np.testing.assert_allclose(state.joints[:2, -1], [tip, 0.0], atol=1e-3)
        assert force[0] < -100.0
        assert force[1] < -10.0


def test_the_current_follows_its_factor_of_time() -> None:
    scenario = load("work-class-1000m-current", HELD)
    inputs = RopeSampler(scenario).sample(Steps(np.array([2.0]), np.array([2.4]), np.zeros(0)))
    stir(inputs.water, inputs.world[0], inputs.plane.orbits, 0.0, 0.0)
    t = np.array([2.0, 2.4, 2.2])
    np.testing.assert_allclose(inputs.water.flow[:, 0, 0], 0.5 * (0.5 + 0.2 * np.sin(0.3 * t)), rtol=1e-12)
    np.testing.assert_allclose(inputs.water.flow[:, 1, 4], 0.2 * 0.06 * np.cos(0.3 * t), rtol=1e-12)


def test_a_shape_of_the_string_is_where_the_string_has_it() -> None:
    state = started({"initial": {"shape": "sine", "amplitude": 2.0, "half_waves": 1.0}})[-1]
    np.testing.assert_allclose(state.joints[0], 2.0 * np.sin(np.pi * np.arange(4) / 3.0), atol=1e-5)


def test_a_shape_longer_than_its_cable_is_refused() -> None:
    steep = {"initial": {"shape": "sine", "amplitude": 400.0, "half_waves": 1.0}}
    with pytest.raises(ScenarioError, match="no cable of this length"):
        load("work-class-1000m-current", HELD | steep)


TIMES = {"times": [0.0, 2.0, 1.0, 2000.0], "values": [1.0, 2.0]}


@pytest.mark.parametrize(
    ("key", "broken"),
    [
        ("environment.water.current", {"depths": [0.0, 1100.0, 300.0], "speeds": [0.6, 0.3]}),
        ("environment.payload_force", [{"kind": "table"} | TIMES]),
        ("winch", {"law": "table", "times": TIMES["times"], "lengths": [900.0, 901.0, 902.0, 903.0, 904.0]}),
        ("initial", {"shape": "table", "positions": [0.0, 1.0, 0.5], "displacements": [0.0, 1.0]}),
    ],
)
def test_a_broken_table_is_refused_and_not_computed_with(key: str, broken: Any) -> None:
    with pytest.raises(ScenarioError) as caught:
        load("work-class-1000m-current", {"model": "rope", "cable.axial_stiffness": 2.6e7, key: broken})
    assert all(problem.key.startswith(key) for problem in caught.value.problems)
    assert len(caught.value.problems) == 2
