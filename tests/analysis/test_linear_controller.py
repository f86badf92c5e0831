"""The controller's matrices are what its kernels do."""

from __future__ import annotations

import numpy as np
import pytest

import umbilical
from umbilical.analysis.controller import motor_law, outer_law, root_slope, shares
from umbilical.analysis.discrete import Discrete, delayed, held
from umbilical.control import cascade
from umbilical.control.contract import make_decision, make_readings
from umbilical.frames import numbers
from umbilical.relations.formulas import soft_signed_root

PAPER = umbilical.load("paper")


def outer_step(scenario, start: np.ndarray) -> np.ndarray:
    """States and command after one update of the real outer law, from states and the four readings."""
    settings, state = cascade.make_settings(scenario), cascade.make_state(scenario)
    readings, decision = make_readings(2), make_decision(2)
    state.outer[0] = (1, tuple(start[:2]), tuple(start[2:4]), (start[4],))
    decision.outer[0].thrust_command = start[5]
    readings.tip[0] = tuple(start[6:])
    cascade.update_outer(settings.outer, state, readings, decision)
    _, velocity, slope, disturbance = numbers(state.outer[0])
    return np.array([*velocity, *slope, *disturbance, decision.outer[0].thrust_command])


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"control.law.slope_gain": 7.0, "control.slope_observer.damping": 0.8, "payload.damping": 30.0},
        {"control.disturbance_observer.enabled": False},
        {"control.law.rates": "sensor", "sensors.ideal_velocity": True},
    ],
)
def test_outer_law(changes):
    scenario = umbilical.load("paper", changes)
    law = outer_law(cascade.make_settings(scenario).outer)
    expected = np.stack([outer_step(scenario, unit) for unit in np.eye(10)], axis=1)
    np.testing.assert_allclose(np.hstack([law.a, law.b]), expected, rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(np.hstack([law.c, law.d])[0], expected[-1], rtol=1e-11, atol=1e-11)


def test_pd_law():
    scenario = umbilical.load("paper-pd")
    law = outer_law(cascade.make_settings(scenario).outer)
    start = np.random.default_rng(3).normal(size=10)
    assert (law.c @ start[:6] + law.d @ start[6:])[0] == pytest.approx(outer_step(scenario, start)[-1], rel=1e-12)


def motor_step(scenario, start: np.ndarray) -> np.ndarray:
    """Memory and voltage of motor 1 after one update of its real loop, from memory, demand, speed and current."""
    settings, state = cascade.make_settings(scenario), cascade.make_state(scenario)
    readings, decision = make_readings(2), make_decision(2)
    state.outer[0].updates = 1
    state.motors[0] = (tuple(start[:3]), *start[3:5])
    decision.motors[0].demand = start[5]
    readings.motors[0] = tuple(start[6:])
    cascade.update_motors(settings.motors, state, readings, decision)
    reference, *rest = numbers(state.motors[0])
    return np.array([*reference, *rest, decision.motors[0].motor_voltage])


@pytest.mark.parametrize("demand", [30.0, -200.0])
def test_motor_law_is_the_central_difference_at_a_steady_speed(demand):
    motors = cascade.make_settings(PAPER).motors
    constants = motors.nominal[0]
    speed = soft_signed_root(demand, motors.command_filter.width)
    current = -(constants.f11 + constants.f12 * abs(speed)) * speed / constants.current_scale
    drive = -constants.f21 * speed - constants.f22 * constants.current_scale * current
    ups = -motors.observer_gain * constants.current_scale * current
    steady = np.array([speed, 0.0, 0.0, ups, drive, demand, speed, current])
    np.testing.assert_allclose(motor_step(PAPER, steady)[:5], steady[:5], rtol=1e-9, atol=1e-6)
    sizes = np.array([1e-4, 1e-2, 1.0, 1.0, 1.0, 1e-3, 1e-4, 1e-4])
    columns = [
        (motor_step(PAPER, steady + step) - motor_step(PAPER, steady - step)) / (2.0 * size)
        for size, step in zip(sizes, np.diag(sizes), strict=True)
    ]
    expected = np.stack(columns, axis=1)
    law = motor_law(motors, constants, speed, demand)
    scale = np.abs(expected).max(axis=1, keepdims=True)
    np.testing.assert_allclose(np.hstack([law.a, law.b]) / scale[:5], expected[:5] / scale[:5], atol=2e-4)
    np.testing.assert_allclose(np.hstack([law.c, law.d])[0] / scale[5], expected[5] / scale[5], atol=2e-4)
    broken = motor_law(motors, constants, 2.0 * speed, demand)  # negative control: another speed is noticed
    assert np.abs(broken.d[0] - expected[5, 5:]).max() > 100.0 * np.abs(law.d[0] - expected[5, 5:]).max()


def test_root_slope():
    for demand in (0.0, 1e-4, 0.3, -50.0):
        step = 1e-6
        slope = (soft_signed_root(demand + step, 1e-3) - soft_signed_root(demand - step, 1e-3)) / (2.0 * step)
        assert root_slope(demand, 1e-3) == pytest.approx(slope, rel=1e-5)


def test_shares_deliver_what_is_commanded():
    known = cascade.make_settings(PAPER).motors
    assert shares(known, np.zeros(3)) @ np.array([1.2, 0.8]) == pytest.approx(1.0)
    adaptive = cascade.make_settings(umbilical.load("paper-adaptive")).motors
    np.testing.assert_array_equal(shares(adaptive, np.array([0.25, 0.0, 0.0])), [0.25, 0.25])


def test_a_late_input_is_a_power_of_z():
    system = Discrete(np.array([[0.5]]), np.array([[1.0, 2.0]]), np.array([[3.0]]), np.array([[0.1, 0.2]]))
    z = np.exp(1j * np.array([0.1, 1.0, 3.0]))
    late = delayed(system, (0, 2)).response(z)[:, 0]
    np.testing.assert_allclose(late[:, 0], system.response(z)[:, 0, 0], rtol=1e-13)
    np.testing.assert_allclose(late[:, 1], system.response(z)[:, 0, 1] / z**2, rtol=1e-13)


def test_held_input():
    a, b = held(np.array([[-2.0]]), np.array([[2.0, 4.0]]), 0.5)
    np.testing.assert_allclose(a, [[np.exp(-1.0)]])
    np.testing.assert_allclose(b, [[1.0 - np.exp(-1.0), 2.0 * (1.0 - np.exp(-1.0))]])
