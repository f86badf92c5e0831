"""However a run ends, it is a run: status, time, reason and the data so far."""

from __future__ import annotations

import numpy as np
import pytest

import umbilical
from tests.support.controllers import Answering
from tests.support.scenarios import open_loop, small
from umbilical import Command, Run, Status

pytestmark = pytest.mark.nojit


def step_load(value: float) -> list[dict[str, object]]:
    return [{"kind": "step", "value": value, "time": 0.02}]


def check_kept(result: Run, until: float, unknown: tuple[str, ...] = ()) -> None:
    """Samples up to the end, none after, all of them numbers but for what is ``unknown``."""
    times = result["time"].values
    np.testing.assert_allclose(times, np.arange(times.size) * 0.01)
    assert until - 0.01 - 1e-9 <= times[-1] <= until + 1e-9
    for name in result.data.data_vars:
        if not str(name).startswith("metric_") and name not in unknown:
            assert np.isfinite(result[name].values).all(), name


def test_a_cable_too_steep() -> None:
    result = umbilical.simulate(small("crosscheck-none", environment__payload_force=step_load(5e7)))
    assert result.status is Status.DIVERGED
    assert 0.02 < result.end_time < 0.1
    assert "slope reached" in result.reason
    assert f"t = {result.end_time:g} s" in result.reason
    assert result.metrics["slope_peak"] > 1.0
    check_kept(result, result.end_time)


def test_a_slope_just_below_the_bound_goes_on() -> None:
    start = {"shape": "sine", "amplitude": 0.95 * 400.0 / (np.pi), "half_waves": 1.0}
    kept = umbilical.simulate(open_loop(winch__length=400.0, initial=start, duration=0.01, grid__elements=8))
    assert kept.status is Status.COMPLETED
    start["amplitude"] = 1.05 * 400.0 / np.pi
    steep = umbilical.simulate(open_loop(winch__length=400.0, initial=start, duration=0.01, grid__elements=8))
    assert steep.status is Status.DIVERGED
    assert steep.end_time == 0.0
    assert steep["time"].size == 0


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_thrust_that_is_not_a_number(bad: float) -> None:
    controller = Answering(lambda t: Command(thrust=bad if t > 0.0305 else 1.0))
    result = umbilical.simulate(small("crosscheck-none"), controller)
    assert result.status is Status.DIVERGED
    assert result.end_time == pytest.approx(0.031)
    assert "no longer finite" in result.reason
    check_kept(result, 0.031)


def test_a_voltage_that_is_not_a_number() -> None:
    controller = Answering(lambda t: Command(voltage=np.array([1.0, np.nan if t > 0.0305 else 1.0])))
    result = umbilical.simulate(small("paper"), controller)
    assert result.status is Status.DIVERGED
    assert result.end_time == pytest.approx(0.031)
    check_kept(result, 0.031, unknown=("thrust_command", "disturbance"))  # who gives voltages commands no thrust


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # what compiled code does without a word
def test_a_motor_that_runs_away_is_noticed() -> None:
    controller = Answering(lambda t: Command(voltage=np.array([1e200, 0.0])))
    result = umbilical.simulate(small("paper"), controller)
    assert result.status is Status.DIVERGED
    assert result.end_time < 0.02


def test_interrupted_between_stretches(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("umbilical.engine.schedule.STEPS_AT_ONCE", 20)
    shares: list[float] = []

    def progress(share: float) -> None:
        shares.append(share)
        if share > 0.5:
            raise KeyboardInterrupt

    result = umbilical.simulate(small("paper"), progress=progress)
    assert result.status is Status.INTERRUPTED
    assert shares == pytest.approx([0.2, 0.4, 0.6])
    assert result.end_time == pytest.approx(0.059)
    assert "interrupted at t = 0.059 s" in result.reason
    check_kept(result, 0.059)
    whole = umbilical.simulate(small("paper"))
    np.testing.assert_array_equal(result["displacement"].values, whole["displacement"].values[: result["time"].size])


def test_interrupted_inside_a_controller() -> None:
    def answer(t: float) -> Command:
        if t > 0.0405:
            raise KeyboardInterrupt
        return Command(thrust=0.0)

    result = umbilical.simulate(small("paper"), Answering(answer))
    assert result.status is Status.INTERRUPTED
    assert result.end_time == pytest.approx(0.04)
    check_kept(result, 0.04)


def test_interrupted_before_the_first_sample() -> None:
    def answer(t: float) -> Command:
        raise KeyboardInterrupt

    result = umbilical.simulate(small("paper"), Answering(answer))
    assert result.status is Status.INTERRUPTED
    assert result["time"].size == 0
    assert result.end_time == 0.0


def test_the_last_sample_is_stored_even_between_intervals() -> None:
    result = umbilical.simulate(small("paper", duration=0.035))
    assert result.status is Status.COMPLETED
    np.testing.assert_allclose(result["time"].values, [0.0, 0.01, 0.02, 0.03, 0.035])
    longer = umbilical.simulate(small("paper", duration=0.035, output__interval=0.005))
    np.testing.assert_array_equal(result["displacement"].values[-1], longer["displacement"].values[-1])
    assert result["tip_displacement"].values[-1] == result.metrics["tip_end"]


def test_a_grid_that_takes_much_of_the_energy_is_told() -> None:
    """The vessel's velocity jumps at the points of a linear table: a front as sharp as the grid lets it be."""
    times, values = [0.25 * k for k in range(25)], [0.5 * (k % 2) for k in range(25)]
    table = {"kind": "table", "times": times, "values": values, "interpolation": "linear"}
    sine = {"kind": "sine", "amplitude": 0.5, "frequency": 0.7, "phase": 0.0}
    told = {}
    for motion in (sine, table):
        changes = {"duration": 6.0, "grid.elements": 8, "environment.vessel_ramp": 1.0}
        scenario = umbilical.load("crosscheck-none", changes | {"environment.vessel_motion": [motion]})
        told[motion["kind"]] = umbilical.simulate(scenario)
    assert told["sine"].metrics["grid_loss"] < 0.1 < told["table"].metrics["grid_loss"]
    assert told["sine"].notices == ()
    assert told["table"].notices[-1].startswith("grid.elements: the grid took ")
