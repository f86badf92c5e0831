"""The explicit limits against what they are the limits of: the steps themselves, done on small matrices."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.engine.linear import linearise_plant
from umbilical.errors import ScenarioError
from umbilical.library import load
from umbilical.plant.checks.steps import chosen_step, fastest_pole, plant_step, reachable_speed
from umbilical.plant.multistep import DECAY_LIMIT, amplification, courant_limit
from umbilical.scenario.hardware import Motor


def motor(**constants: float) -> Motor:
    return load("paper").motors[0].model_copy(update=constants)


def test_steps_divide_the_period() -> None:
    paper = load("paper")
    assert plant_step(paper.control, paper.grid) == 1e-3
    assert plant_step(paper.control, paper.grid.model_copy(update={"step": 0.3e-3})) == 0.25e-3
    assert plant_step(paper.control, paper.grid.model_copy(update={"step": 1.0})) == 1e-3


@pytest.mark.parametrize("elements", [64, 400])
def test_the_waves_shorten_the_step(elements: int) -> None:
    """A whole part of the period, below the limit for the fastest wave and the shortest element of the run."""
    scenario = load("paper", {"grid.elements": elements, "grid.step": 1.0})
    crossing = min(x / elements / np.sqrt((500.0 + 2.0 * x) * 10.0 / 2.0) for x in np.linspace(450.0, 500.0, 51))
    step, limit = chosen_step(scenario), 0.9 * courant_limit() * crossing
    assert round(1e-3 / step) == pytest.approx(1e-3 / step)
    assert step <= limit < 2.0 * step or step == 1e-3 < limit


def test_the_cable_is_stable_at_the_limit_and_grows_at_twice_of_it() -> None:
    """The whole cable with its ROV, not the uniform one that the limit is computed for."""
    scenario = load("crosscheck-none", {"grid.elements": 8})
    product = np.linalg.eigvals(linearise_plant(scenario).a.toarray())
    limit = 0.9 * courant_limit() * 500.0 / 8 / np.sqrt(1500.0 * 10.0 / 2.0)
    assert amplification(limit * product).max() < 1.0 + 1e-9
    assert amplification(2.0 * limit * product).max() > 1.1


def test_a_light_payload_needs_a_short_step() -> None:
    """The ROV decays at ``sqrt(rho m g)/m``: just above the stated mass that is just below the method's limit."""
    with pytest.raises(ScenarioError) as caught:
        load("crosscheck-none", {"payload.mass": 5e-5})
    (problem,) = (p for p in caught.value.problems if p.key == "payload.mass")
    limit = float(problem.bound.removeprefix("at least ").split(" kg")[0])
    assert np.sqrt(2.0 * 5e-5 * 10.0) / limit * 1e-3 == pytest.approx(0.9 * DECAY_LIMIT, rel=1e-4)


def test_reachable_speed_and_poles_of_the_paper_motor() -> None:
    """Verification 8: 75.015 V holds 50 rad/s; the poles at 100 rad/s reach 394 1/s."""
    assert reachable_speed(motor(voltage_limit=75.015)) == pytest.approx(50.0, rel=1e-9)
    assert reachable_speed(motor()) == 100.0
    assert fastest_pole(motor(), 100.0) == pytest.approx(394.0, abs=0.5)


def test_motor_limit_is_that_of_runge_kutta() -> None:
    """The step the refusal allows keeps the fastest pole of the motor stable; 1.2 of it does not."""
    with pytest.raises(ScenarioError) as caught:
        load("paper", {"motors.1.inductance": 1e-6})
    (problem,) = (p for p in caught.value.problems if p.key == "grid.step")
    limit = float(problem.bound.removeprefix("at most ").removesuffix(" s"))
    pole = fastest_pole(motor(inductance=1e-6), 100.0)
    for factor, grows in ((1.0, False), (1.2, True)):
        z = -pole * limit * factor
        assert (abs(1.0 + z + z**2 / 2.0 + z**3 / 6.0 + z**4 / 24.0) > 1.0) == grows


def test_a_frictionless_unbounded_motor_has_a_speed() -> None:
    free = motor(viscous_friction=0.0, load_coefficient=0.0, back_emf_constant=0.0, voltage_limit=10.0)
    assert reachable_speed(free) == 100.0
