"""Orbital motion from its tables against the sum of Airy's waves, and a string that feels it."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import pytest

from tests.plant.test_water import at_sea as shallow
from umbilical import Scenario, simulate
from umbilical.engine.setup import set_up
from umbilical.engine.stepping import enter_step
from umbilical.errors import ScenarioError
from umbilical.library.admit import admit
from umbilical.plant import orbital
from umbilical.plant.exogenous import Outside, Steps
from umbilical.plant.layout import positions, to_nodal
from umbilical.plant.rope.outside import RopeSampler
from umbilical.plant.rope.water import flow_at, stir
from umbilical.plant.seaway import waves_of
from umbilical.plant.signals import fade
from umbilical.scenario.document import freeze
from umbilical.scenario.environment import Environment
from umbilical.sea.waves import orbital_velocity, wave_number

pytestmark = pytest.mark.nojit

SHIP = {"kind": "box", "length": 93.0, "breadth": 20.0, "draught": 6.6, "block_coefficient": 0.75}
SYSTEM = {"significant_height": 2.5, "peak_period": 8.0, "heading": 2.0, "components": 40}


def at_sea(**changes: Any) -> Environment:
    sea = {"systems": [SYSTEM], "vessel": SHIP | {"sheave_forward": 10.0, "sheave_up": 8.0}, "orbital_below": 6.6}
    return Environment.model_validate(freeze({"gravity": 9.81, "vessel_ramp": 30.0, "sea": sea | changes}))


def read(environment: Environment, depth: float, t: float) -> np.ndarray:
    """Velocity and rate in three directions, shape (2, 3), as a kernel reads them."""
    tables, now = orbital.orbits(environment), np.zeros((2, 3, orbital.LEVELS))
    first, rows = tables.rows(t - 1.0, t + 1.0)
    orbital.look_at_waves(rows, t / orbital.STEP - first, now)
    level = orbital.find_level(tables.levels, depth)
    return np.array([[orbital.at_level(now[kind, d], level) for d in range(3)] for kind in range(2)])


def exact(environment: Environment, depth: float, t: float) -> np.ndarray:
    """The sum over all waves, as :func:`read`."""
    sea, found = environment.sea, np.zeros((2, 3))
    assert sea is not None
    ramp, rate, *_ = fade(np.array(t), environment.vessel_ramp, "right")
    for heading, waves in waves_of(sea):
        k = wave_number(waves.omega)
        turn = np.exp(1j * (waves.omega * t + waves.phase - k * 10.0 * np.cos(heading)))
        speed = waves.amplitude * orbital_velocity(waves.omega, 8.0 - depth) * turn
        parts = np.outer([np.cos(heading - sea.plane), np.sin(heading - sea.plane), 1j], speed)
        value, change = parts.sum(axis=1).real, (1j * waves.omega * parts).sum(axis=1).real
        found += np.array([ramp * value, ramp * change + rate * value])
    return found


@pytest.mark.parametrize("t", [12.34, 71.29, 512.0])
@pytest.mark.parametrize("depth", [14.7, 25.0, 60.0, 110.0])
def test_the_tables_give_the_sum_of_the_waves(depth: float, t: float) -> None:
    environment = at_sea(systems=[SYSTEM, SYSTEM | {"peak_period": 12.0, "heading": 1.0, "spreading": 4.0}])
    largest = abs(exact(environment, 14.7, 80.0)).max()
    np.testing.assert_allclose(read(environment, depth, t), exact(environment, depth, t), atol=0.006 * largest)


def test_nothing_moves_above_the_keel_nor_far_below() -> None:
    environment = at_sea()
    assert not read(environment, 14.5, 80.0).any()
    assert read(environment, 14.7, 80.0).any()
    assert not read(environment, 900.0, 80.0).any()


def test_stretches_meet() -> None:
    tables = orbital.orbits(at_sea(), 1)
    first, rows = tables.rows(40.0, 120.0)
    again, other = tables.rows(90.0, 130.0)
    np.testing.assert_array_equal(rows[again - first :][:50], other[:50])


def test_a_calm_sea_moves_nothing() -> None:
    assert not read(at_sea(systems=[SYSTEM | {"significant_height": 0.0}]), 20.0, 80.0).any()


def string(**changes: Any) -> Scenario:
    """A string in water that the waves of :func:`at_sea` move."""
    sea = at_sea(**changes).model_dump(mode="json")["sea"]
    return shallow(**{"environment.sea": sea, "environment.vessel_ramp": 30.0, "duration": 120.0, "grid.elements": 6})


def test_a_string_feels_it_at_its_nodes() -> None:
    scenario, t = string(), 71.3
    setup = set_up(scenario)
    plant, state = setup.world.plant, setup.world.state
    enter_step(plant, state, Outside(scenario).sample(Steps(np.array([t]), np.array([t + 0.01]), np.zeros(0))), 0)
    depths, flow = 100.0 * positions(6)[:20], state.water
    still = np.array([np.interp(depth, [0.0, 200.0], [0.5, 0.1]) for depth in depths])
    waves = np.array([exact(scenario.environment, depth, t)[:, 0] * (depth > 14.6) for depth in depths])
    np.testing.assert_allclose(to_nodal(flow.speed[None])[0, :20], still + waves[:, 0], atol=0.006)
    np.testing.assert_allclose(to_nodal(flow.rate[None])[0, :20], waves[:, 1], atol=0.006)


@pytest.mark.skipif(os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="45 s of a run take minutes as plain Python")
def test_the_balance_of_powers_closes_in_waves() -> None:
    run = simulate(string().replace({"duration": 45.0, "grid.elements": 24}))
    assert run.metrics["energy_balance_residual"] < 2e-4
    calm = simulate(string(orbital_below=None).replace({"duration": 45.0, "grid.elements": 24}))
    assert abs(run["displacement"].values - calm["displacement"].values).max() > 5e-3


SPREAD = [SYSTEM | {"spreading": 3.0, "directions": 5}]


def rope(**changes: Any) -> Scenario:
    """A rope under the waves of :func:`at_sea`, in a current."""
    sea = at_sea(**changes).model_dump(mode="json")["sea"]
    current = {"depths": [0.0, 200.0], "speeds": [0.5, 0.5], "speeds_across": [-0.2, -0.2]}
    there = {"model": "rope", "rope.elements": 4, "cable.axial_stiffness": 2e7, "environment.water.current": current}
    return shallow(**there, **{"environment.sea": sea, "environment.vessel_ramp": 30.0, "duration": 0.05})


@pytest.mark.parametrize("systems", [[SYSTEM], SPREAD], ids=["long-crested", "spread"])
@pytest.mark.parametrize(("stage", "at"), [(0, 0.0), (1, 1.0), (2, 0.5)])
def test_a_rope_feels_it_in_three_directions(stage: int, at: float, systems: list[Any]) -> None:
    scenario, t, dt = rope(systems=systems), 71.3, 0.02
    inputs = RopeSampler(scenario).sample(Steps(np.array([t]), np.array([t + dt]), np.zeros(0)))
    place, found = inputs.plane.world["wave_place"][:, 0], np.zeros((3, 6))
    stir(inputs.water, inputs.world[0], inputs.plane.orbits, place[0], place[1])
    largest = abs(exact(scenario.environment, 14.7, 80.0)).max()
    for row, height in zip(found, (-10.0, -20.0, -70.0), strict=True):
        flow_at(inputs.water, stage, height, row, 0, 1)
    waves = [np.zeros((2, 3)), *(exact(scenario.environment, depth, t + at * dt) for depth in (20.0, 70.0))]
    current = np.array([0.5, -0.2, 0.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(found, [current + both.ravel() for both in waves], atol=0.006 * largest)


def test_a_rope_in_a_calm_sea_is_one_without_waves() -> None:
    calm = rope(systems=[SYSTEM | {"significant_height": 0.0}])
    with_table, without = simulate(calm), simulate(calm.replace({"environment.sea": None}))
    np.testing.assert_array_equal(with_table["tension"].values, without["tension"].values)
    np.testing.assert_array_equal(with_table["position"].values, without["position"].values)


def test_waves_need_water_and_a_grid_that_sees_them() -> None:
    dry = {"environment.water": None, "cable.water": None, "payload.water": None}
    with pytest.raises(ScenarioError, match="drag and moved mass need water"):
        admit(string().replace(dry))
    with pytest.raises(ScenarioError, match="drag and moved mass need water"):
        admit(string().replace({"model": "rope", **dry}))
    coarse = string().replace({"winch.length": 3000.0, "environment.water.current": None})
    assert "63 grid.elements would see it" in " ".join(map(str, admit(coarse)))
    deep = rope().replace({"winch.length": 3000.0, "environment.water.current": None, "duration": 20.0})
    assert "63 rope.elements would see it" in " ".join(map(str, admit(deep)))
