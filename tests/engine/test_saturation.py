"""Drives at their limit and commands beyond the thrusters: measured at every control sample, and told."""

from __future__ import annotations

import json

import numpy as np
import pytest

import umbilical
from umbilical.control.contract import Command
from umbilical.engine.saturation import thrust_capability
from umbilical.engine.simulate import measure
from umbilical.plant.motors import make_motors, net_torque
from umbilical.relations.formulas import motor_constants
from umbilical.studies.rows import NAMES

EVERY_SAMPLE = {"duration": 0.5, "output.interval": 0.001}
LIMITS = {"motors.1.voltage_limit": 8.0, "motors.2.voltage_limit": 8.0}


def stored(run: umbilical.Run, name: str) -> np.ndarray:
    return run[name].values


@pytest.mark.parametrize("limits", [LIMITS, {"motors.2.voltage_limit": 8.0}], ids=["both", "one of two"])
def test_share_and_gap_are_those_of_the_stored_samples(limits: dict[str, float]) -> None:
    run = umbilical.simulate(umbilical.load("ringdown", EVERY_SAMPLE | limits))
    limited = [int(key.split(".")[1]) - 1 for key in limits]
    at_limit = np.abs(stored(run, "motor_voltage")[:, limited]) >= 8.0
    assert run.metrics["saturated_share"] == pytest.approx(at_limit.mean(), abs=1e-12)
    assert 0.01 < at_limit.mean() < 0.99
    gap = stored(run, "thrust_command") - stored(run, "thrust")
    assert run.metrics["thrust_gap"] == pytest.approx(np.sqrt(np.mean(gap**2)), rel=1e-12)
    assert [note.split(":")[0] for note in run.notices if "at its limit" in note] == list(limits)


def test_what_there_is_nothing_to_measure_of_is_absent() -> None:
    unlimited = umbilical.simulate(umbilical.load("paper", {"duration": 0.1}))
    assert "saturated_share" not in unlimited.metrics
    assert "thrust_gap" in unlimited.metrics
    ideal = umbilical.simulate(umbilical.load("crosscheck-proposed", {"duration": 0.1}))
    assert not {"saturated_share", "thrust_gap"} & ideal.metrics.keys()


class Volts:
    """Gives voltages, and no thrust."""

    period = 1e-3

    def start(self, measurement):
        return None

    def update(self, t, measurement, state):
        return Command(voltage=np.array([100.0, 0.0])), state


@pytest.mark.nojit
def test_voltages_without_a_thrust_leave_no_gap_and_no_effort() -> None:
    run = umbilical.simulate(umbilical.load("paper", {"duration": 0.1} | LIMITS), Volts())
    assert not {"effort_rms", "thrust_gap"} & run.metrics.keys()
    assert np.isfinite(list(run.metrics.values())).all()
    assert run.metrics["saturated_share"] == 0.5
    assert [note.split(":")[0] for note in run.notices] == ["motors.1.voltage_limit"]


def test_a_command_that_ran_away_is_told_and_stored(tmp_path) -> None:
    pulse = {"kind": "pulse", "value": 2000.0, "start": 1.0, "end": 4.0}
    gust = {"duration": 6.0, "environment.payload_force": [pulse]}
    run = umbilical.simulate(umbilical.load("paper", gust | LIMITS))
    assert run.status.name == "COMPLETED"
    assert run.metrics["saturated_share"] > 0.5
    told = next(note for note in run.notices if note.startswith("control:"))
    assert f"give {thrust_capability(run.scenario):.3g} N" in told
    run.save(tmp_path / "run.nc")
    again = umbilical.open_run(tmp_path / "run.nc")
    assert again.notices == run.notices
    assert told in again.summary()
    assert json.loads(again.data.attrs["notices"]) == list(run.notices)


def test_voltages_are_measured_over_all_motors() -> None:
    run = umbilical.simulate(umbilical.load("paper", EVERY_SAMPLE))
    assert run.metrics["motor_voltage_rms"] == pytest.approx(np.sqrt(np.mean(stored(run, "motor_voltage") ** 2)))


def test_the_motor_observer_knows_the_limit_of_its_drive() -> None:
    """Held at 1 V while kilovolts are wanted, it estimates the disturbance that is there: none."""
    quiet = {f"motors.{k}.{name}_disturbance": [] for k in (1, 2) for name in ("torque", "voltage")}
    limits = {f"motors.{k}.voltage_limit": 1.0 for k in (1, 2)}
    shape = {"initial": {"shape": "static", "force": 2000.0}}
    run = umbilical.simulate(umbilical.load("paper", EVERY_SAMPLE | quiet | limits | shape))
    assert run.metrics["saturated_share"] > 0.9
    of_one_volt = motor_constants(run.scenario.motors[0]).f23
    assert np.abs(stored(run, "motor_disturbance_estimate")[100:]).max() < 0.01 * of_one_volt


def test_capability_is_the_steady_thrust_at_the_limits() -> None:
    scenario = umbilical.load("paper", LIMITS)
    motors, total = make_motors(scenario.motors), 0.0
    for k, motor in enumerate(scenario.motors):
        speed = np.sqrt(thrust_capability(scenario.replace({"motors": [motor]})) / abs(motor.thrust_coefficient))
        current = (8.0 - motor.back_emf_constant * speed) / motor.resistance
        assert net_torque(motors[k], speed, current, 0.0) == pytest.approx(0.0, abs=1e-9)
        total += abs(motor.thrust_coefficient) * speed**2
    assert thrust_capability(scenario) == pytest.approx(total)
    assert thrust_capability(umbilical.load("paper")) == np.inf


@pytest.mark.parametrize(("noise", "told"), [(1.0, True), (0.0, False)])
def test_without_limits_the_command_is_held_against_what_was_delivered(noise: float, told: bool) -> None:
    run = umbilical.simulate(umbilical.load("paper", {"duration": 2.0, "sensors.tip_displacement.noise": noise}))
    assert any("delivered" in note for note in run.notices) is told


@pytest.mark.parametrize("preset", ["paper", "paper-stuck-adaptive", "haul-in", "ringdown"])
def test_the_presets_are_followed(preset: str) -> None:
    assert umbilical.simulate(umbilical.load(preset, {"grid.elements": 8})).notices == ()


def test_studies_have_both() -> None:
    assert {"saturated_share", "thrust_gap"} <= set(NAMES)
    scenario = umbilical.load("paper", {"duration": 0.2} | LIMITS)
    both = measure(scenario).metrics, umbilical.simulate(scenario).metrics
    assert both[0]["saturated_share"] == both[1]["saturated_share"]
    assert both[0]["thrust_gap"] == both[1]["thrust_gap"] > 0.0
