"""The step as a matrix is the step that runs."""

from __future__ import annotations

import numpy as np
import pytest

import umbilical
from tests.support.scenarios import constant, open_loop, sine
from tests.support.spectra import step_poles
from umbilical.engine import linear as module
from umbilical.engine.linear import linearise_plant, step_matrix
from umbilical.engine.loop import World, advance_period
from umbilical.engine.schedule import stretch
from umbilical.engine.sensing import read_truth
from umbilical.engine.setup import set_up
from umbilical.engine.stepping import DRY, enter_step
from umbilical.frames import numbers
from umbilical.plant.cable import PRESENT
from umbilical.plant.exogenous import Outside, Steps

pytestmark = pytest.mark.nojit


def test_its_powers_are_a_run() -> None:
    """From the fourth instant on, when the multistep method has the past it needs."""
    start = {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5}
    scenario = open_loop(
        winch__length=100.0, grid__elements=4, initial=start, duration=0.05, output__interval=1e-3, cable__damping=0.3,
        payload__damping=20.0,
    )  # fmt: skip
    matrix, linear = step_matrix(scenario), linearise_plant(scenario)
    setup = set_up(scenario)
    inputs = Outside(scenario).sample(stretch(setup.clock, 0, 50).steps)
    enter_step(setup.world.plant, setup.world.state, inputs, 0)
    states = [state_of(setup.world)]
    for k in range(50):
        advance_period(setup.world, inputs, k, k + 1, DRY)
        states.append(state_of(setup.world))
    augmented = np.concatenate([states[3], linear.a @ states[2], linear.a @ states[1]])
    for k in range(4, 51):
        augmented = matrix @ augmented
        np.testing.assert_allclose(augmented[: states[k].size], states[k], atol=1e-11 * np.abs(states[k]).max())


def state_of(world: World) -> np.ndarray:
    return np.append(world.state.blocks[PRESENT].ravel(), world.state.now[0].ends.tip_velocity)


def test_samples_are_what_the_sensors_read() -> None:
    scenario = open_loop(
        winch__length=100.0, grid__elements=4, initial={"shape": "sine", "amplitude": 1.0, "half_waves": 1.5},
        sensors__ideal_velocity=True,
    )  # fmt: skip
    world = set_up(scenario).world
    world.state.now[0].ends.tip_velocity = 0.3
    inputs = Outside(scenario).sample(Steps(np.zeros(1), np.full(1, 1e-3), np.zeros(0)))
    enter_step(world.plant, world.state, inputs, 0)
    read_truth(world.state, world.readings)
    found = linearise_plant(scenario).c @ state_of(world)
    np.testing.assert_allclose(found, numbers(world.readings.tip[0]), rtol=1e-11, atol=1e-14)


def test_poles_are_those_of_the_step_matrix() -> None:
    scenario = open_loop(winch__length=100.0, grid__elements=4, cable__damping=0.3, payload__damping=20.0)
    factors = np.linalg.eigvals(step_matrix(scenario))
    for pole in step_poles(scenario):
        assert np.abs(factors - np.exp(pole * scenario.grid.step)).min() < 1e-9


def test_a_held_force_in_terms_of_the_shift() -> None:
    """The formula of :class:`Linear`: a force ``z^k`` held for each step, found again in a run of the matrix."""
    scenario = open_loop(winch__length=100.0, grid__elements=4, cable__damping=0.3)
    linear, z = linearise_plant(scenario), np.exp(0.03j)
    one = np.eye(linear.a.shape[0])
    rates = linear.a.toarray()
    system = (z - 1.0) * one - linear.step * (23.0 - 16.0 / z + 5.0 / z**2) / 12.0 * rates
    x = np.linalg.solve(system, linear.step * linear.b[:, 0])
    forced = np.concatenate([x, rates @ x / z, rates @ x / z**2])
    pushed = step_matrix(scenario) @ forced
    pushed[: x.size] += linear.step * linear.b[:, 0]
    np.testing.assert_allclose(pushed[: x.size], z * x, rtol=1e-9)


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


@pytest.mark.parametrize("current", [0.0, 0.4])
def test_a_quadratic_drag_counts_with_its_slope(monkeypatch: pytest.MonkeyPatch, current: float) -> None:
    """Rates of ``-k |v - c| (v - c)`` on every node: nothing at rest in still water, ``-2 k |c|`` in a current c."""
    k, scenario = 3.0, open_loop(winch__length=100.0, grid__elements=4, cable__damping=0.3)
    plain = linearise_plant(scenario).a.toarray()
    find_rates = module.find_rates

    def dragged(plant, state) -> None:
        find_rates(plant, state)
        half = state.blocks.shape[2] // 2
        velocity = state.blocks[PRESENT, :, half:] - current
        state.blocks[module.RATES, :, half:] -= k * np.abs(velocity) * velocity

    monkeypatch.setattr(module, "find_rates", dragged)
    change = linearise_plant(scenario).a.toarray() - plain
    velocities = np.zeros(change.shape[0])
    velocities[:-1].reshape(5, -1)[:, 4:] = 1.0
    np.testing.assert_allclose(change, np.diag(-2.0 * k * abs(current) * velocities), atol=1e-4 * k)
