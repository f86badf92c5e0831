"""The table of forces: everything that works is in it, and says truly how it damps."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical import Scenario
from umbilical.engine.linear import linearise_plant
from umbilical.engine.setup import set_up
from umbilical.engine.stepping import enter_step, find_rates
from umbilical.plant.cable import PRESENT, RATES
from umbilical.plant.equilibrium import equilibrium
from umbilical.plant.exogenous import Outside, Steps
from umbilical.plant.forces.force import Force
from umbilical.plant.forces.table import FORCES, WORKS, decays
from umbilical.plant.layout import positions, to_nodal
from umbilical.quantities import CHANNELS
from umbilical.relations.water import line_inertia, payload_inertia
from umbilical.verify.engine import open_loop

CURRENT = {"depths": [0.0, 30.0, 60.0], "speeds": [0.6, 0.4, -0.3]}
STILL = open_loop(
    grid={"elements": 4, "step": 1e-3},
    winch={"law": "constant", "length": 40.0},
    environment__water={"current": CURRENT},
    cable__damping=0.0,
    payload__damping=0.0,
    cable__wet_line_density=1.4,
    cable__water={"diameter": 0.03, "normal_drag": 0.0, "tangential_drag": 0.0},
    payload__wet_weight=2500.0,
    payload__water={"added_mass": 300.0},
)
KEYS = {
    "work_cable_damping": {"cable.damping": 0.7},
    "work_payload_damping": {"payload.damping": 20.0},
    "work_drag": {"cable.water.normal_drag": 1.2, "cable.water.tangential_drag": 0.01},
    "work_body_drag": {"payload.water.linear_drag": 30.0, "payload.water.quadratic_drag": 400.0},
}
"""What switches a force on that damps."""


def test_every_work_of_a_run_is_that_of_a_force_in_the_table() -> None:
    assert {name for name in CHANNELS if name.startswith("work_")} >= set(WORKS)
    assert [name for name in CHANNELS if name in WORKS] == list(WORKS)


def accelerations(scenario: Scenario, velocity: float) -> tuple[np.ndarray, float]:
    """Of the nodes and of the ROV, m/s2, while all of it moves at one velocity."""
    world = set_up(scenario).world
    enter_step(world.plant, world.state, Outside(scenario).sample(Steps(np.zeros(1), np.full(1, 1e-3), np.zeros(0))), 0)
    n = scenario.grid.elements
    world.state.blocks[PRESENT][:, n:] = velocity
    world.state.now[0].ends.tip_velocity = velocity
    find_rates(world.plant, world.state)
    return to_nodal(world.state.blocks[RATES][:, n:]), float(world.state.now[0].ends.tip_rates[0])


@pytest.mark.parametrize("force", FORCES, ids=WORKS)
def test_a_force_damps_as_it_says(force: Force) -> None:
    """Differences of the engine's own rates, against those of the plant without it."""
    step, place = 2.0**-12, ("cable", "payload").index(force.on)
    with_it = STILL.replace(KEYS.get(force.work, {}))
    change = [accelerations(s, w)[place] for s in (with_it, STILL) for w in (step, -step)]
    inertia = (line_inertia(STILL.cable, STILL.payload, STILL.environment), payload_inertia(STILL.payload))[place]
    found = -inertia * (change[0] - change[1] - change[2] + change[3]) / (2.0 * step)
    rest = equilibrium(with_it)
    water = np.interp(positions(STILL.grid.elements), rest.sigma, rest.water)
    stated = force.damping(with_it, water) + 0.0 * np.asarray(found)
    inside = slice(1, None) if place == 0 else ...  # the vessel's node does not move along
    np.testing.assert_allclose(np.asarray(found)[inside], stated[inside], rtol=1e-7, atol=1e-7)
    assert (force.work in KEYS) == bool(np.any(stated))


def test_the_table_knows_the_fastest_decays() -> None:
    scenario = STILL.replace({**KEYS["work_cable_damping"], **KEYS["work_payload_damping"]})
    found = {d.key: d.coefficient / d.inertia for d in decays(scenario.cable, scenario.payload, scenario.environment)}
    inertia = line_inertia(STILL.cable, STILL.payload, STILL.environment)
    assert found["cable.damping"] == 0.7 / inertia
    assert found["payload.damping"] == 20.0 / payload_inertia(STILL.payload)
    assert found["cable.water.normal_drag"] == found["payload.water"] == 0.0


def test_drag_at_rest_changes_no_matrix_and_in_a_current_by_its_slope() -> None:
    """The trap of a Jacobian at finite motion: in still water a quadratic drag has no slope."""
    drags = {**KEYS["work_drag"], "payload.water.quadratic_drag": 400.0}
    still = STILL.replace({"environment.water": {}})
    bare, dragged = (linearise_plant(s).a.toarray() for s in (still, still.replace(drags)))
    assert np.abs(dragged - bare).max() < 1e-3 * 1.2
    flowing = STILL.replace(drags)
    change = linearise_plant(flowing).a.toarray() - linearise_plant(STILL).a.toarray()
    water = np.interp(40.0, CURRENT["depths"], CURRENT["speeds"])
    assert change[-1, -1] == pytest.approx(-2.0 * 400.0 * abs(water) / payload_inertia(STILL.payload), rel=1e-5)
    expected = -1025.0 * 1.2 * 0.03 * 0.6 / line_inertia(STILL.cable, STILL.payload, STILL.environment)
    assert change[4, 4] == pytest.approx(expected, rel=1e-5)  # the first node's velocity, at the vessel
