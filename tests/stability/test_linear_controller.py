"""The controller's matrices, taken from its kernels, are those of the equations; so are those of Python's updates."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from tests.support import laws as by_hand
from umbilical import Command
from umbilical.control import cascade
from umbilical.control.cascade import Cascade
from umbilical.control.contract import Measurement
from umbilical.engine.linearise import Linear, LinearisationPoint, delayed, hold_input, linearise
from umbilical.relations.formulas import soft_signed_root
from umbilical.stability.laws import linear_motor_law, linear_outer_law, root_slope, shares, soft_square
from umbilical.stability.updates import Doubt, Rest, find_numbers, linearise_controller, write_numbers

PAPER = umbilical.load("paper")
REST = Rest(Measurement(0.0, 0.0, np.array([5.0]), np.array([2.0]), 400.0, 0.0, 0.0), 10.0)


def test_what_is_linear_comes_out_to_the_last_bit() -> None:
    a, b = np.random.default_rng(1).normal(size=(2, 3, 3))
    found = linearise(lambda x, u: (a @ x, b @ u), LinearisationPoint(np.zeros(3), np.zeros(3)))
    np.testing.assert_array_equal(np.hstack([found.a, found.d]), np.hstack([a, b]))


def assert_same(found: Linear, expected: Linear, tolerance: float) -> None:
    """Every row of both, relative to its largest entry."""
    one, other = (np.block([[s.a, s.b], [s.c, s.d]]) for s in (found, expected))
    scale = np.abs(other).max(axis=1, keepdims=True) + (np.abs(other).max(axis=1, keepdims=True) == 0.0)
    np.testing.assert_allclose(one / scale, other / scale, atol=tolerance)


@pytest.mark.parametrize(
    ("preset", "changes"),
    [
        ("paper", {}),
        (
            "paper",
            {"control.law.slope_gain": 7.0, "control.slope_observer.damping": 0.8, "payload.damping": 30.0},
        ),
        ("paper", {"control.disturbance_observer.enabled": False}),
        ("paper", {"control.law.station_gain": 0.1, "control.law.washout_time": 200.0}),
        ("paper", {"control.law.rates": "sensor", "sensors.ideal_velocity": True}),
        ("paper-pd", {}),
    ],
)
def test_outer_law(preset, changes):
    outer = cascade.make_settings(umbilical.load(preset, changes)).outer
    found = linear_outer_law(outer)
    assert_same(found, by_hand.outer_law(outer), 1e-14)
    assert found.names.states[-1] == "thrust_command"
    assert found.names.inputs[0] == "tip_displacement"


@pytest.mark.parametrize("demand", [30.0, 200.0])
def test_motor_law(demand):
    motors = cascade.make_settings(PAPER).motors
    speed = soft_signed_root(demand, motors.command_filter.width)
    assert soft_square(speed, motors.command_filter.width) == pytest.approx(demand, rel=1e-12)
    expected = by_hand.motor_law(motors, motors.nominal[0], speed, demand)
    assert_same(linear_motor_law(motors, 0, speed), expected, 1e-7)
    with pytest.raises(AssertionError):  # another speed is noticed
        assert_same(linear_motor_law(motors, 0, 2.0 * speed), expected, 1e-7)
    random = by_hand.motor_law(motors, motors.nominal[0], speed, 0.0, spread=demand)
    assert_same(linear_motor_law(motors, 0, speed, 0.0, spread=demand), random, 1e-7)


class Damper:
    """Thrust against a velocity from a first-order filter; memory in the state."""

    period = 2e-3
    share = 0.04

    def start(self, measurement):
        return measurement.tip_displacement, {"velocity": np.zeros(1)}

    def update(self, t, measurement, state):
        before, memory = state
        now, rate = measurement.tip_displacement, memory["velocity"]
        rate = rate + self.share * ((now - before) / self.period - rate)
        return Command(thrust=-1e3 * float(rate[0])), (now, {"velocity": rate})


class InItself(Damper):
    """The same with its memory in the object, where it does not belong."""

    def start(self, measurement):
        self.memory = super().start(measurement)

    def update(self, t, measurement, state):
        command, self.memory = super().update(t, measurement, self.memory)
        return command, None


@pytest.mark.parametrize("law", [Damper(), InItself()])
def test_a_controller_in_python(law) -> None:
    found = linearise_controller(law, REST)
    p, s = Damper.period, Damper.share
    np.testing.assert_allclose(found.a, [[0.0, 0.0], [-s / p, 1.0 - s]], rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(found.b, [[1.0, 0.0, 0.0, 0.0], [s / p, 0.0, 0.0, 0.0]], rtol=1e-11)
    np.testing.assert_allclose(found.c, [[1e3 * s / p, -1e3 * (1.0 - s)]], rtol=1e-11)
    assert "memory" not in vars(law) or isinstance(law, InItself)


def test_the_built_in_one_behind_the_contract() -> None:
    """Its transfer function; its states are those that change, in another order."""
    scenario = umbilical.load("paper", {"ideal_thruster": True})
    z = np.exp(1j * np.array([0.01, 0.3, 2.0]))
    expected = linear_outer_law(cascade.make_settings(scenario).outer).response(z)
    np.testing.assert_allclose(linearise_controller(Cascade(scenario), REST).response(z), expected, rtol=1e-9)


class Odd:
    """A damper that is changed by a test."""

    period = 1e-3

    def __init__(self, answer: Any, state: Any = 0.0) -> None:
        self.answer, self.state = answer, state

    def start(self, measurement):
        return self.state

    def update(self, t, measurement, state):
        answer = self.answer(t, measurement)
        return answer if isinstance(answer, Command) else Command(thrust=answer), state


@pytest.mark.parametrize(
    ("answer", "why"),
    [
        (lambda t, m: 5.0 * np.sign(m.tip_displacement), "not smooth"),
        (lambda t, m: (-1e3 if t < 3.0 else -2e3) * m.tip_displacement, "from t = 5 s on"),
        (lambda t, m: -1e3 * m.tip_displacement + m.motor_speed[0], "something else"),
        (lambda t, m: 1e3 * round(m.tip_displacement, 3), "answers no reading"),
        (lambda t, m: Command(thrust=0.0, voltage=np.zeros(1)), "voltages itself"),
        (lambda t, m: -m.tip_displacement if m.tip_displacement <= 0.0 else 1.0 / 0.0, "it fails near"),
    ],
)
def test_what_no_linear_system_speaks_for_is_said(answer, why) -> None:
    with pytest.raises(Doubt, match=why):
        linearise_controller(Odd(answer), REST)


def test_memory_that_grows_or_never_rests_is_said() -> None:
    class Growing(Odd):
        def update(self, t, measurement, state):
            command, _ = super().update(t, measurement, state)
            return command, [*state, measurement.tip_displacement]

    class Restless(Odd):
        def update(self, t, measurement, state):
            command, _ = super().update(t, measurement, state)
            return command, state + 1.0

    for law in (Growing(lambda t, m: -m.tip_displacement, []), Restless(lambda t, m: -m.tip_displacement)):
        with pytest.raises(Doubt, match="does not come to rest"):
            linearise_controller(law, REST)


def test_numbers_in_nested_memory() -> None:
    memory = ({"a": [1.0, 2]}, cascade.OuterMemory.many(1), 3.0)
    found = find_numbers(memory)
    assert found[(0, "a", 0)] == 1.0
    assert found[(2,)] == 3.0
    assert (0, "a", 1) not in found
    written = write_numbers(memory, {path: 7.0 + k for k, path in enumerate(found)})
    assert find_numbers(written) == {path: 7.0 + k for k, path in enumerate(found)}


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
    system = Linear(np.array([[0.5]]), np.array([[1.0, 2.0]]), np.array([[3.0]]), np.array([[0.1, 0.2]]))
    z = np.exp(1j * np.array([0.1, 1.0, 3.0]))
    late = delayed(system, (0, 2)).response(z)[:, 0]
    np.testing.assert_allclose(late[:, 0], system.response(z)[:, 0, 0], rtol=1e-13)
    np.testing.assert_allclose(late[:, 1], system.response(z)[:, 0, 1] / z**2, rtol=1e-13)


def test_held_input():
    a, b = hold_input(np.array([[-2.0]]), np.array([[2.0, 4.0]]), 0.5)
    np.testing.assert_allclose(a, [[np.exp(-1.0)]])
    np.testing.assert_allclose(b, [[1.0 - np.exp(-1.0), 2.0 * (1.0 - np.exp(-1.0))]])
