"""The order of one update: sample, estimate, decide, hold; periods; limits; what the controller believes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import umbilical
from tests.support.scenarios import run, small
from umbilical import Command, Measurement
from umbilical.control.cascade import Cascade, to_readings
from umbilical.frames import numbers
from umbilical.relations.formulas import soft_signed_root

pytestmark = pytest.mark.nojit

SAMPLE = Measurement(
    tip_displacement=0.2, tip_slope=0.01, motor_speed=np.array([3.0, -2.0]), motor_current=np.array([5.0, -4.0]),
    length=450.0, payout_speed=0.5, payout_acceleration=0.1,
)  # fmt: skip


def updates(controller: Cascade, samples: list[Measurement]) -> tuple[list[Command], Any]:
    state, out = controller.start(samples[0]), []
    for k, sample in enumerate(samples):
        command, state = controller.update(k * controller.period, sample, state)
        out.append(command)
    return out, state


def test_first_update_advances_no_filter() -> None:
    """On the first sample the observers are at rest, so the law sees slope and tension only."""
    (command,), (memory, decision, _) = updates(Cascade(umbilical.load("paper")), [SAMPLE])
    tension = 500.0 * (10.0 - 0.1)
    assert command.thrust == pytest.approx(-1e4 * 0.01 * 0.01 + tension * 0.01, rel=1e-14)
    outer = memory.outer[0]
    assert numbers(outer.observers) == ((0.2, 0.0), (0.01, 0.0))
    assert decision.motors["speed_reference"].tolist() == [0.0, 0.0], "the command filters are at zero"
    assert outer.updates == 1


def test_second_update_advances_every_filter_once() -> None:
    moved = replace(SAMPLE, tip_displacement=0.21, tip_slope=0.012)
    _, (memory, decision, _) = updates(Cascade(umbilical.load("paper")), [SAMPLE, moved])
    eps, h = 0.005, 1e-3
    step = h / eps * np.exp(-h / eps)  # pi2 after one period of a unit step
    assert memory.outer[0].observers.velocity.filtered_rate == pytest.approx(0.01 * step, rel=1e-9)
    assert memory.outer[0].observers.slope.filtered_rate == pytest.approx(0.002 * step, rel=1e-9)
    assert decision.outer[0].tip_velocity_estimate == pytest.approx(0.01 * step / eps, rel=1e-9)
    root, x = soft_signed_root(decision.motors[0].demand, 1e-3), 200.0 * h
    first, second = decision.motors["speed_reference"]
    assert first == pytest.approx(root * (1.0 - np.exp(-x) * (1.0 + x + x * x / 2.0)), rel=1e-9)
    assert first == second != 0.0


def test_outer_law_keeps_to_its_own_period() -> None:
    scenario = umbilical.load("paper", {"control.outer_period": 2e-3})
    samples = [replace(SAMPLE, tip_displacement=0.2 + 0.001 * k) for k in range(7)]
    commands, _ = updates(Cascade(scenario), samples)
    thrusts = [c.thrust for c in commands]
    assert thrusts[0] == thrusts[1] != thrusts[2] == thrusts[3] != thrusts[4] == thrusts[5] != thrusts[6]
    voltages = [c.voltage[0] for c in commands if c.voltage is not None]
    assert len(set(voltages)) == 7, "the motor loops go on between the outer samples"


def test_voltage_is_clipped_at_the_believed_limit() -> None:
    scenario = umbilical.load("paper", {"motors.1.voltage_limit": 0.5, "motors.2.voltage_limit": 0.25})
    result = run(scenario.replace({"grid.elements": 4, "duration": 0.1}))
    assert np.abs(result["motor_voltage"].values).max(axis=0).tolist() == [0.5, 0.25]


def test_no_control_commands_nothing() -> None:
    (command, _), _ = updates(Cascade(umbilical.load("paper", {"control.law": {"kind": "none"}})), [SAMPLE, SAMPLE])
    assert command.thrust == 0.0
    assert command.voltage is not None
    assert not command.voltage.any()


@pytest.mark.parametrize("source", ["sensor", "observer"])
def test_pd_takes_its_velocity_from_where_it_is_told(source: str) -> None:
    scenario = umbilical.load("paper-pd", {"sensors.ideal_velocity": True, "control.law.velocity": source})
    (command,), _ = updates(Cascade(scenario), [replace(SAMPLE, tip_velocity=0.7, tip_slope_rate=0.0)])
    assert command.thrust == pytest.approx(-100.0 * 0.2 - (10.0 * 0.7 if source == "sensor" else 0.0), rel=1e-14)


def test_boundary_law_with_ideal_sensors() -> None:
    scenario = umbilical.load(
        "crosscheck-no-observer",
        {"sensors.ideal_velocity": True, "control.law.rates": "sensor", "control.law.slope_gain": 2.0},
    )
    sample = replace(SAMPLE, motor_speed=np.zeros(0), motor_current=np.zeros(0), tip_velocity=0.3, tip_slope_rate=-0.02)
    (command,), _ = updates(Cascade(scenario), [sample])
    known = 500.0 * 9.9 * 0.01 + 0.001 * 0.3
    assert command.thrust == pytest.approx(-1e4 * (0.3 + 2.0 * 0.01) + 2.0 * 500.0 * 0.02 + known, rel=1e-13)
    assert command.voltage is None


def test_beliefs_are_the_controllers_and_not_the_plants() -> None:
    beliefs = {
        "control.nominal.payload_mass": 400.0, "control.nominal.gravity": 9.0, "control.nominal.payload_damping": 2.0,
    }  # fmt: skip
    (command,), _ = updates(Cascade(umbilical.load("paper", beliefs)), [SAMPLE])
    assert command.thrust == pytest.approx(-1e4 * 0.01 * 0.01 + 400.0 * 8.9 * 0.01, rel=1e-14)
    believing = small("paper-none", control__nominal={"payload_mass": 400.0})
    np.testing.assert_array_equal(
        run(believing)["displacement"].values, run(small("paper-none"))["displacement"].values
    )


def test_believed_factors_share_the_thrust() -> None:
    believed = {"control.nominal.thrust_coefficients": [3.0, -1.0]}
    (command,), (_, decision, _) = updates(Cascade(umbilical.load("paper", believed)), [SAMPLE])
    assert command.thrust is not None
    assert decision.motors["demand"].tolist() == [command.thrust / 4.0, -command.thrust / 4.0]


def test_absent_sensors_read_not_a_number() -> None:
    readings = to_readings(SAMPLE)
    displacement, slope, *rates = numbers(readings.tip[0])
    assert np.isnan(rates).all()
    assert (displacement, slope, *numbers(readings.winch[0])) == (0.2, 0.01, 450.0, 0.5, 0.1, 0.0)
    assert [numbers(motor) for motor in readings.motors] == [(3.0, 5.0), (-2.0, -4.0)]
