"""The explicit limits against what they are the limits of: the steps themselves, done on small matrices."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.admission import load
from umbilical.admission.steps import fastest_pole, plant_step, reachable_speed
from umbilical.errors import ScenarioError
from umbilical.plant.elements import LARGEST_EIGENVALUE, highest_frequency
from umbilical.scenario import Scenario
from umbilical.scenario.hardware import Motor


def motor(**constants: float) -> Motor:
    return load("paper").motors[0].model_copy(update=constants)


def stated_limit(scenario: Scenario, key: str) -> float:
    """The largest step that the refusal of a far too large one allows."""
    with pytest.raises(ScenarioError) as caught:
        load("paper", {"control.period": 1.0, "output.interval": 1.0, "grid.step": 1.0} | {key: scenario.grid.elements})
    bound = next(p.bound for p in caught.value.problems if p.key == "grid.step" and "elements" in p.reason)
    return float(bound.removeprefix("at most ").removesuffix(" s"))


def test_steps_divide_the_period() -> None:
    paper = load("paper")
    assert plant_step(paper.control, paper.grid) == 1e-3
    assert plant_step(paper.control, paper.grid.model_copy(update={"step": 0.3e-3})) == 0.25e-3
    assert plant_step(paper.control, paper.grid.model_copy(update={"step": 1.0})) == 1e-3


def test_cable_limit_is_that_of_verlet_on_the_grid() -> None:
    """Between 80 % and 91 % of 2/omega with the frequency bound of the longest cable of the run."""
    elements = load("paper").grid.elements
    limit = stated_limit(load("paper"), "grid.elements")
    fastest = max(
        highest_frequency(np.sqrt((500.0 + 2.0 * length) * 10.0 / 2.0), length / elements)
        for length in np.linspace(450.0, 500.0, 51)
    )
    assert 0.8 < limit * fastest / 2.0 < 0.91


def test_largest_eigenvalue_is_the_stability_bound_of_verlet() -> None:
    """Velocity Verlet of one free element: stable just below 2/omega, growing just above."""
    from umbilical.plant.elements import STIFFNESS, WEIGHTS

    omega = np.sqrt(LARGEST_EIGENVALUE)
    for factor, grows in ((0.99, False), (1.01, True)):
        y, w, h = np.array([1.0, -1.0, 1.0, -1.0, 1.0]), np.zeros(5), factor * 2.0 / omega
        for _ in range(400):
            w = w - h * (STIFFNESS @ y) / WEIGHTS
            y = y + h * w
        assert (np.abs(y).max() > 1e3) == grows


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
