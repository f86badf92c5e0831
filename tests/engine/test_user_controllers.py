"""A controller of the user: how it is called, and what happens when it breaks its contract."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from tests.support.controllers import Answering, Recorder
from tests.support.scenarios import run, small
from umbilical import Command, Controller, Status
from umbilical.errors import ControllerError, ScenarioError

pytestmark = pytest.mark.nojit


def test_called_once_per_period_from_start_to_end() -> None:
    recorder = Recorder(Command(thrust=0.0))
    run(small("paper"), recorder)
    np.testing.assert_allclose(recorder.times, np.arange(101) * 1e-3, atol=1e-15)
    assert len(recorder.starts) == 1
    assert recorder.starts[0] is recorder.seen[0]
    assert isinstance(recorder, Controller)


def test_a_slower_controller_is_called_at_its_own_period() -> None:
    recorder = Recorder(Command(thrust=50.0), period=0.005)
    result = run(small("paper"), recorder)
    np.testing.assert_allclose(recorder.times, np.arange(21) * 5e-3, atol=1e-15)
    assert len(np.unique(result["motor_voltage"].values[1:, 0])) == 10, "the motor loops go on in between"


@pytest.mark.parametrize("period", [0.0, -1e-3, 4e-4, 1.5e-3, float("nan"), float("inf")])
def test_a_period_that_does_not_fit(period: float) -> None:
    with pytest.raises(ScenarioError, match=r"Recorder\.period"):
        umbilical.simulate(small("paper"), Recorder(Command(thrust=0.0), period))


@pytest.mark.parametrize(
    ("preset", "answer", "message"),
    [
        ("paper", None, "is a NoneType"),
        ("paper", 3.0, "is a float"),
        ("paper", Command(), "gives no thrust or voltage"),
        ("crosscheck-none", Command(voltage=np.zeros(0)), "gives no thrust .the thruster is ideal"),
        ("paper", Command(voltage=np.zeros(3)), r"shape \(3,\); there are 2 motors"),
        ("paper", Command(voltage=np.float64(1.0)), r"shape \(\); there are 2 motors"),  # pyright: ignore[reportArgumentType]
    ],
)
def test_what_is_not_a_command(preset: str, answer: Any, message: str) -> None:
    with pytest.raises(ControllerError, match=message) as caught:
        umbilical.simulate(small(preset), Answering(lambda t: answer if t > 0.0205 else Command(0.0)))
    assert "t = 0.021 s" in str(caught.value)


def test_an_error_inside_the_controller_names_it_and_the_time() -> None:
    def answer(t: float) -> Command:
        return Command(thrust=1.0 / (0.0 if t > 0.0205 else 1.0))

    with pytest.raises(ControllerError, match=r"Answering failed at t = 0.021 s: ZeroDivisionError") as caught:
        umbilical.simulate(small("paper"), Answering(answer))
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    assert "(controllers.py, line " in str(caught.value)


def test_the_samples_up_to_a_failure_are_kept() -> None:
    scenario = small("paper")

    def answer(t: float) -> Command:
        return Command(thrust=1.0 / (0.0 if t > 0.0205 else 1.0))

    with pytest.raises(ControllerError) as caught:
        umbilical.simulate(scenario, Answering(answer))
    kept = caught.value.run
    whole = umbilical.simulate(scenario, Answering(lambda t: Command(thrust=1.0)))
    assert kept is not None
    assert kept.status is Status.FAILED
    assert kept.end_time == pytest.approx(0.02)
    assert "Answering failed at t = 0.021 s" in kept.reason
    samples = kept.data.sizes["time"]
    assert 1 <= samples < whole.data.sizes["time"]
    assert (kept["tip_displacement"].values == whole["tip_displacement"].values[:samples]).all()


def test_a_controller_that_fails_at_once_leaves_a_run_without_samples() -> None:
    with pytest.raises(ControllerError) as caught:
        umbilical.simulate(small("paper"), Answering(lambda t: Command()))
    assert caught.value.run is not None
    assert caught.value.run.data.sizes["time"] == 0


def test_an_answer_without_a_state() -> None:
    class Forgetful(Recorder):
        def update(self, t: float, measurement: Any, state: Any) -> Any:
            return Command(thrust=0.0)

    with pytest.raises(ControllerError, match="Forgetful failed at t = 0 s"):
        umbilical.simulate(small("paper"), Forgetful(None))


def test_thrust_alone_reaches_an_ideal_thruster_at_once() -> None:
    result = run(small("crosscheck-none"), Answering(lambda t: Command(thrust=7.0)))
    assert (result["thrust"].values == 7.0).all()


def test_voltages_reach_the_motors_and_end_at_the_drives_limit() -> None:
    """20 V wanted, 4 V to be had: the same motor as with 4 V wanted."""
    limits = {"motors__1__voltage_limit": 4.0, "motors__2__voltage_limit": 4.0}
    wanted, had = (
        run(small("paper", **limits), Answering(lambda t, v=v: Command(voltage=np.array([v, -v])))) for v in (20.0, 4.0)
    )
    for name in ("motor_speed", "motor_current", "thrust"):
        np.testing.assert_array_equal(wanted[name].values, had[name].values, name)
    assert np.abs(had["motor_speed"].values).max() > 1.0


def test_the_controller_cannot_reach_into_the_plant() -> None:
    class Meddler(Recorder):
        def update(self, t: float, measurement: Any, state: Any) -> Any:
            measurement.motor_speed[:] = 1e3
            measurement.motor_current[:] = 1e3
            return super().update(t, measurement, state)

    honest, meddled = (run(small("paper"), kind(Command(voltage=np.ones(2)))) for kind in (Recorder, Meddler))
    np.testing.assert_array_equal(honest["motor_speed"].values, meddled["motor_speed"].values)
