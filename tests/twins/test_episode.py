"""An episode driven by hand is the run that `simulate` makes, and can go back."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from tests.support.scenarios import small
from tests.twins.test_loops import FAULTS, NOISY
from umbilical import Command, Episode, Measurement, Run, Scenario, Status
from umbilical.control.cascade import Cascade
from umbilical.errors import ControllerError, ScenarioError

pytestmark = [pytest.mark.nojit, pytest.mark.bounds]


class Thrust:
    """A thrust from displacement, its integral and the motors; logs the integral."""

    period = 0.007

    def start(self, measurement: Measurement) -> float:
        return 0.0

    def update(self, t: float, m: Measurement, state: float) -> tuple[Command, float]:
        state += self.period * m.tip_displacement
        thrust = -300.0 * m.tip_displacement - 20.0 * state - 1e-3 * float(np.sum(m.motor_speed))
        return Command(thrust=thrust, log={"integral": state}), state


class Voltage(Thrust):
    """Voltages from what the motors do; now and then with a thrust."""

    period = 0.002

    def update(self, t: float, m: Measurement, state: float) -> tuple[Command, float]:
        voltage = -5.0 * m.tip_displacement - 0.01 * m.motor_speed + 0.1
        return Command(voltage=voltage, thrust=1.0 if state % 3 else None), state + 1


CASES: dict[str, tuple[Scenario, Any]] = {
    "thrust": (small("paper"), Thrust()),
    "thrust, noise and faults": (small("paper-adaptive").replace(NOISY | FAULTS), Thrust()),
    "thrust, ideal": (small("crosscheck-pd"), Thrust()),
    "voltage, noise and faults": (small("paper").replace(NOISY | FAULTS), Voltage()),
    "voltage, hauling in": (small("haul-in"), Voltage()),
    "built in": (small("paper-stuck"), Cascade(small("paper-stuck"))),
}


def drive(episode: Episode, controller: Any, state: Any = None, until: float = np.inf) -> Any:
    """Step an episode by a controller's own commands; the controller's state."""
    state = controller.start(episode.measurement) if state is None else state
    while not episode.over and episode.time < until:
        command, state = controller.update(episode.time, episode.measurement, state)
        episode.step(command)
    return state


def finish(episode: Episode, controller: Any, state: Any) -> Run:
    """The run, with the command that is due at its end."""
    due = controller.update(episode.time, episode.measurement, state)[0] if episode.commanded else None
    return episode.finish(due)


def assert_same(found: Run, wanted: Run) -> None:
    assert list(found.data.variables) == list(wanted.data.variables)
    for name, values in wanted.data.variables.items():
        np.testing.assert_array_equal(found.data[name].values.view(np.int64), values.values.view(np.int64), str(name))
    assert (found.status, found.reason) == (wanted.status, wanted.reason)


@pytest.mark.parametrize("steps", [None, 7])
@pytest.mark.parametrize(("scenario", "controller"), CASES.values(), ids=CASES)
def test_it_is_the_run_of_simulate(
    scenario: Scenario, controller: Any, steps: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever the stretches in which the outside world is sampled."""
    wanted = umbilical.simulate(scenario, controller)
    if steps:
        monkeypatch.setattr("umbilical.engine.schedule.STEPS_AT_ONCE", steps)
    episode = Episode(scenario, controller.period)
    found = finish(episode, controller, drive(episode, controller))
    assert_same(found, wanted)
    assert np.abs(found["tip_displacement"].values).max() > 0.0


@pytest.mark.parametrize(("scenario", "controller"), [CASES["thrust, noise and faults"], CASES["voltage, hauling in"]])
def test_back_to_a_mark_gives_the_same_bytes(scenario: Scenario, controller: Any) -> None:
    """From the middle of a run, after its end, and in another episode of the same scenario."""
    episode, other = Episode(scenario, controller.period), Episode(scenario, controller.period)
    state = drive(episode, controller, until=0.04)
    mark = episode.save()
    first = finish(episode, controller, drive(episode, controller, state))
    episode.restore(mark)
    assert episode.status is None
    while not episode.over:  # a branch that is given up
        episode.step(Command(voltage=np.ones(2)))
    episode.finish()
    for again in (episode, other):
        again.restore(mark)
        assert_same(finish(again, controller, drive(again, controller, state)), first)


def test_holding_is_saying_it_again() -> None:
    scenario = small("paper").replace(NOISY)
    one, many = Episode(scenario, period=0.01), Episode(scenario)
    for thrust in 30.0 * np.cos(0.5 * np.arange(10)):
        one.step(Command(thrust=thrust))
        for _ in range(10):
            many.step(Command(thrust=thrust))
    assert one.over
    assert many.over
    assert_same(one.finish(), many.finish())


def test_what_a_controller_logs_is_in_the_run() -> None:
    scenario, controller = CASES["thrust"]
    run = umbilical.simulate(scenario, controller)
    logged = run["controller_integral"].values
    assert logged.shape == run["time"].shape
    assert np.isfinite(logged).all()
    assert len(np.unique(logged)) > 5
    with pytest.raises(ControllerError, match="logs 'integral'"):
        Episode(scenario).step(Command(thrust=0.0, log={"integral": "much"}))  # pyright: ignore[reportArgumentType]


def test_an_episode_that_is_left_early_is_a_run() -> None:
    episode = Episode(small("paper"), period=0.01)
    episode.step(Command(thrust=1.0))
    run = episode.finish()
    assert run.status is Status.INTERRUPTED
    assert run.end_time == pytest.approx(0.009)
    assert episode.finish() is run


def test_what_is_refused() -> None:
    with pytest.raises(ScenarioError, match=r"Episode\.period"):
        Episode(small("paper"), period=0.0015)
    episode = Episode(small("paper"), period=0.1)
    with pytest.raises(ControllerError, match="gives no thrust or voltage"):
        episode.step(Command())
    while not episode.over:
        episode.step(Command(thrust=0.0))
    with pytest.raises(ControllerError, match="the episode is over"):
        episode.step(Command(thrust=0.0))
    assert episode.finish().status is Status.COMPLETED


def test_a_model_that_ends_is_over() -> None:
    """It is not measured after that."""
    episode = Episode(small("crosscheck-none", duration=0.5), period=0.001)
    while not episode.over:
        episode.step(Command(thrust=1e9))
    assert episode.status is Status.DIVERGED
    assert episode.finish().status is Status.DIVERGED
