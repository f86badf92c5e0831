"""The table of forces: everything that works is in it, and says truly how it damps."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical import Scenario
from umbilical.engine.setup import set_up
from umbilical.engine.stepping import enter_step, find_rates
from umbilical.plant.cable import PRESENT, RATES
from umbilical.plant.exogenous import Outside, Steps
from umbilical.plant.forces.force import Force, OperatingPoint
from umbilical.plant.forces.table import FORCES, WORKS, decays
from umbilical.plant.layout import node_count, to_nodal
from umbilical.quantities import CHANNELS
from umbilical.verify.ours import open_loop

STILL = open_loop(grid={"elements": 4, "step": 1e-3}, winch={"law": "constant", "length": 40.0})
DAMPED = {"cable.damping": 0.7, "payload.damping": 20.0}


def test_every_work_of_a_run_is_that_of_a_force_in_the_table() -> None:
    assert tuple(name for name in CHANNELS if name.startswith("work_")) == WORKS


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
    """Differences of the engine's own rates, against those of the plant without any damping."""
    step = 1e-3
    scenario = STILL.replace(DAMPED)
    alone = scenario.replace({key: 0.0 for key in DAMPED if key != key_of(force)})
    bare = scenario.replace(dict.fromkeys(DAMPED, 0.0))
    rates = [np.subtract(accelerations(alone, w)[i], accelerations(bare, w)[i]) for w in (step, -step) for i in (0, 1)]
    inertia = scenario.cable.line_density if force.on == "cable" else scenario.payload.mass
    found = -inertia * (rates[0] - rates[2] if force.on == "cable" else rates[1] - rates[3]) / (2.0 * step)
    nodes = np.zeros(node_count(scenario.grid.elements))
    stated = force.damping(scenario, OperatingPoint(40.0, nodes, nodes))
    np.testing.assert_allclose(found[1:] if force.on == "cable" else found, stated, rtol=1e-9, atol=1e-9)


def key_of(force: Force) -> str:
    """Of the coefficient; a force without any has none."""
    found = force.decay(cable=STILL.cable, payload=STILL.payload, environment=STILL.environment)
    return found.key if found else ""


def test_the_table_knows_the_fastest_decays() -> None:
    scenario = STILL.replace(DAMPED)
    found = {d.key: d.coefficient / d.inertia for d in decays(scenario.cable, scenario.payload, scenario.environment)}
    expected = {"cable.damping": 0.7 / scenario.cable.line_density, "payload.damping": 20.0 / scenario.payload.mass}
    assert found == expected
