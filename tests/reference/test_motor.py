"""The motor of eq. (15): steady state, step from rest, poles, reversal through zero, and L -> 0."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from tests.support.motors import MOTOR, drive, integrate
from tests.support.scenarios import constant
from umbilical.relations.formulas import steady_speed
from umbilical.scenario.hardware import Motor

VOLTAGE = 75.015


def test_steady_state() -> None:
    """75.015 V hold 50 rad/s: K_t i = B w + K_Q w^2 = 2500.75 N m, U = R i + K_b w."""
    result = drive([constant(VOLTAGE)], 1.0)
    assert result["motor_speed"].values[-1, 0] == pytest.approx(50.0, rel=1e-9)
    assert result["motor_current"].values[-1, 0] == pytest.approx(625.1875, rel=1e-9)
    assert steady_speed(Motor.model_validate(MOTOR), VOLTAGE) == pytest.approx(50.0, rel=1e-14)
    assert steady_speed(Motor.model_validate(MOTOR), -VOLTAGE) == pytest.approx(-50.0, rel=1e-14)


def test_step_from_rest() -> None:
    result = drive([constant(VOLTAGE)], 0.3)
    exact = integrate(VOLTAGE, (0.0, 0.0), result["time"].values)
    for name, row in (("motor_speed", 0), ("motor_current", 1)):
        assert np.abs(result[name].values[:, 0] - exact[row]).max() < 1e-6 * np.abs(exact[row]).max()


def test_reversal_through_zero() -> None:
    """|w| w is only once differentiable at 0, which costs digits; the jump is an instant between two steps."""
    jump = 0.1003
    result = drive([constant(50.0), {"kind": "step", "value": -100.0, "time": jump}], 0.3)
    instants = result["time"].values
    before = integrate(50.0, (0.0, 0.0), np.append(instants[instants < jump], jump))
    after = integrate(-50.0, tuple(before[:, -1]), np.append(jump, instants[instants > jump]))
    exact = np.concatenate([before[:, :-1], after[:, 1:]], axis=1)
    assert exact[0].max() > 30.0
    assert exact[0].min() < -30.0
    for name, row in (("motor_speed", 0), ("motor_current", 1)):
        assert np.abs(result[name].values[:, 0] - exact[row]).max() < 3e-6 * np.abs(exact[row]).max()


def test_poles_without_the_propeller() -> None:
    """With K_Q = 0 the motor is linear: its answer to a step is that of the two poles of its matrix."""
    result = drive([constant(1.0)], 0.2, load_coefficient=0.0)
    matrix = np.array([[-0.015 / 0.5, 4.0 / 0.5], [-0.5 / 0.002, -0.08 / 0.002]])
    steady = np.linalg.solve(matrix, [0.0, -1.0 / 0.002])
    exact = np.array([steady - expm(matrix * t) @ steady for t in result["time"].values])
    assert np.abs(result["motor_speed"].values[:, 0] - exact[:, 0]).max() < 1e-6 * np.abs(exact[:, 0]).max()
    assert np.linalg.eigvals(matrix).imag.max() > 20.0, "the poles are a pair, so the answer rings"


def test_poles_at_speed() -> None:
    """Around 50 rad/s the motor is linear to first order: the difference of two runs follows its matrix."""
    change, begin = 1e-3, 0.5
    step = [constant(VOLTAGE), {"kind": "step", "value": change, "time": begin}]
    perturbed, steady = drive(step, 0.6), drive([constant(VOLTAGE)], 0.6)
    matrix = np.array([[-(0.015 + 2.0 * 50.0) / 0.5, 4.0 / 0.5], [-0.5 / 0.002, -0.08 / 0.002]])
    final = np.linalg.solve(matrix, [0.0, -change / 0.002])
    instants = perturbed["time"].values
    late = instants >= begin
    exact = np.array([final - expm(matrix * t) @ final for t in instants[late] - instants[late][0]])
    found = (perturbed["motor_speed"].values - steady["motor_speed"].values)[late, 0]
    assert np.abs(found - exact[:, 0]).max() < 1e-4 * np.abs(exact[:, 0]).max()


def test_vanishing_inductance() -> None:
    """As L -> 0, J w' = G - b w - K_Q w^2 with a tanh for its answer; the distance falls with L."""
    b, g = 0.015 + 4.0 * 0.5 / 0.08, 4.0 * VOLTAGE / 0.08
    root = np.sqrt(b * b / 4.0 + g)
    errors = []
    for inductance in (4e-5, 2e-5):
        result = drive([constant(VOLTAGE)], 0.02, step=2.5e-4, inductance=inductance)
        t = result["time"].values
        exact = root * np.tanh(root * t / 0.5 + np.arctanh(b / 2.0 / root)) - b / 2.0
        errors.append(np.abs(result["motor_speed"].values[:, 0] - exact).max() / 50.0)
    assert errors[1] < 0.1
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.3)
