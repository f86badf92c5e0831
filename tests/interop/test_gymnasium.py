"""The environment: what Gymnasium asks of one, equal bits for equal seeds, the run of simulate, baselines' returns."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from umbilical import Command, Measurement, load, simulate
from umbilical.errors import ControllerError, MissingPartnerError, ScenarioError
from umbilical.scenario.scenario import Scenario

gymnasium = pytest.importorskip("gymnasium", reason="needs the extra `rl`")
from gymnasium.utils.env_checker import check_env  # noqa: E402

from umbilical.interop.policies import Nothing, OuterLaw, play  # noqa: E402

TIP = "umbilical.interop.gymnasium:Umbilical/Tip-v0"
TRUTH = "umbilical.interop.gymnasium:Umbilical/TipPrivileged-v0"
SHORT = {"duration": 2.0, "grid.elements": 8}
NOISE = {"sensors.tip_displacement.noise": 1e-3, "sensors.motor_speed.dropout": 0.1}
FASTER = {f"control.{name}_observer.time_constant": 0.2 for name in ("velocity", "slope")}


def make(name: str = TIP, scenario: str = "paper", changes: Any = None, **options: Any) -> Any:
    return gymnasium.make(name, scenario=load(scenario, SHORT | (changes or {})), step=0.1, **options)


@pytest.mark.parametrize(
    ("name", "changes", "options"),
    [
        (TIP, {}, {}),
        (TIP, NOISE, {"mode": "voltage"}),
        (TRUTH, {"sensors.ideal_velocity": True}, {"render_mode": "rgb_array"}),
    ],
)
def test_gymnasium_accepts_it_without_a_warning(name: str, changes: dict[str, Any], options: dict[str, Any]) -> None:
    check_env(make(name, changes=changes, **options).unwrapped)


def episode(env: Any, seed: int, policy: Any = None) -> tuple[list[bytes], list[float]]:
    """Observations as bytes, and rewards."""
    observation, _ = env.reset(seed=seed)
    env.action_space.seed(seed)
    seen, rewards, over = [observation.tobytes()], [], False
    while not over:
        action = env.action_space.sample() if policy is None else policy(observation)
        observation, reward, terminated, truncated, _ = env.step(action)
        seen.append(observation.tobytes())
        rewards.append(reward)
        over = terminated or truncated
    return seen, rewards


@pytest.mark.parametrize("changes", [{}, NOISE])
def test_equal_seeds_give_equal_bits(changes: dict[str, Any]) -> None:
    one, other = make(changes=changes), make(changes=changes)
    assert episode(one, 5) == episode(other, 5) == episode(one, 5)
    still = episode(one, 6, Nothing(one))[0] != episode(other, 7, Nothing(other))[0]
    assert still is bool(changes)


class Replay:
    """Recorded commands as a controller."""

    period = 0.1

    def __init__(self, commands: list[Command]) -> None:
        self._commands = commands

    def start(self, measurement: Measurement) -> int:
        return 0

    def update(self, t: float, measurement: Measurement, state: int) -> tuple[Command, int]:
        return self._commands[min(state, len(self._commands) - 1)], state + 1


@pytest.mark.parametrize("mode", ["thrust", "voltage"])
def test_it_is_the_run_of_simulate(mode: str) -> None:
    env, commands = make(mode=mode), []
    env.reset(seed=0)
    env.action_space.seed(0)
    over, info = False, {}
    while not over:
        action = env.action_space.sample()
        commands.append(env.unwrapped.command(action.astype(float)))
        *_, truncated, info = env.step(action)
        over = truncated
    expected = simulate(env.unwrapped.scenario, Replay(commands))
    assert info["time"] == pytest.approx(2.0)
    assert info["tip_displacement"] == expected["tip_displacement"].values[-1]
    for name in ("tip_peak", "tip_end", "mid_peak", "thrust_peak", "motor_speed_peak"):
        assert info["metrics"][name] == expected.metrics[name], name


def test_observations_are_readings_and_never_the_truth() -> None:
    env = make(changes={"sensors.tip_displacement.bias": 0.5})
    observation, info = env.reset(seed=0)
    seen = env.unwrapped.readings(observation)
    winch, motors = {"length", "payout_speed", "payout_acceleration"}, {"motor_speed", "motor_current"}
    assert set(seen) == {"tip_displacement", "tip_slope"} | winch | motors
    assert seen["tip_displacement"] == pytest.approx(0.5)
    assert info["tip_displacement"] == 0.0
    told = make(TRUTH, changes={"sensors.tip_displacement.bias": 0.5})
    observation, _ = told.reset(seed=0)
    assert told.unwrapped.readings(observation)["true_tip_displacement"] == 0.0


def test_a_seed_draws_a_member_of_a_study() -> None:
    env = gymnasium.make(TIP, study="paper-robustness", arm="proposed", step=0.5)
    masses = set()
    for seed in (1, 2, 1):
        env.reset(seed=seed, options={"changes": {"grid.elements": 8}})
        masses.add(env.unwrapped.episode.scenario.payload.mass)
        assert env.unwrapped.episode.scenario.grid.elements == 8
        assert env.unwrapped.episode.scenario.control.nominal.payload_mass == 500.0
    assert len(masses) == 2
    with pytest.raises(ScenarioError, match="one of PD"):
        gymnasium.make(TIP, study="paper-robustness", arm="nobody")


def test_a_model_that_ends_terminates_and_never_pays() -> None:
    """Too steep a cable: the rest of the run costs more than any way through it."""
    env = make("umbilical.interop.gymnasium:Umbilical/Tip-v0", thrust_scale=1e6)
    env.reset(seed=0)
    observation, reward, terminated, truncated, _ = env.step(np.ones(1, np.float32))
    while not (terminated or truncated):
        observation, reward, terminated, truncated, _ = env.step(np.ones(1, np.float32))
    assert (terminated, truncated) == (True, False)
    assert reward < -1000.0
    assert np.isfinite(observation).all()
    with pytest.raises(ControllerError, match="over"):
        env.unwrapped.step(np.ones(1))


def test_a_reward_of_ones_own_sees_measurement_and_command() -> None:
    env = make(reward=lambda measurement, command: -abs(command.thrust) + measurement.length)
    env.reset(seed=0)
    reward = env.step(np.full(1, 0.5, np.float32))[1]
    expected = env.unwrapped.episode.measurement.length - 0.5 * env.unwrapped.thrust_scale
    assert reward == pytest.approx(0.1 * expected)


def test_it_shows_the_cable() -> None:
    env = make(render_mode="rgb_array")
    env.reset(seed=0)
    before = env.render()
    for _ in range(20):
        env.step(np.ones(1, np.float32))
    after = env.render()
    assert (before.shape, before.dtype) == ((360, 240, 3), np.uint8)
    assert (before != after).any()


@pytest.mark.parametrize(
    ("options", "key"),
    [
        ({"mode": "torque"}, "mode"),
        ({"thrust_scale": -1.0}, "thrust_scale"),
        ({"voltage_scale": float("inf")}, "voltage_scale"),
        ({"arm": "proposed"}, "arm"),
    ],
)
def test_wrong_arguments_are_refused(options: dict[str, Any], key: str) -> None:
    with pytest.raises(ScenarioError) as refused:
        make(**options)
    assert [problem.key for problem in refused.value.problems] == [key]


def test_other_refusals() -> None:
    with pytest.raises(ScenarioError, match="no motors to drive"):
        make(scenario="crosscheck-pd", mode="voltage")
    with pytest.raises(ScenarioError, match="in one plane"):
        make(changes={"model": "rope"})
    with pytest.raises(ScenarioError, match=r"step\.period"):
        gymnasium.make(TIP, scenario="paper", step=0.00015)
    env = make()
    with pytest.raises(ScenarioError, match=r"options\.change = "):
        env.reset(seed=0, options={"change": {"payload.mass": 550.0}})
    env.reset(seed=0)
    with pytest.raises(ControllerError, match="not finite"):
        env.unwrapped.step(np.full(1, np.nan))
    with pytest.raises(ScenarioError, match="no sensor of the rates"):
        OuterLaw(env, load("paper-pd"))
    with pytest.raises(ScenarioError, match="none decides nothing"):
        OuterLaw(env, load("paper-none"))
    with pytest.raises(ScenarioError, match="commands a thrust"):
        OuterLaw(make(mode="voltage"))


def test_without_gymnasium_the_extra_is_named() -> None:
    script = (
        "import sys; sys.modules['gymnasium'] = None\n"
        "try:\n    import umbilical.interop.gymnasium\n"
        "except Exception as error:\n    print(type(error).__name__, error)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.startswith(MissingPartnerError.__name__)
    assert "umbilical[rl]" in done.stdout


def law(name: str) -> Scenario | None:
    laws = {
        "nothing": None,
        "PD": load("paper-pd", {"control.law.velocity": "observer"}),
        "boundary law": load("paper"),
        "boundary law, slower": load("paper", {"control.law.damping_gain": 1000.0} | FASTER),
    }
    return laws[name]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "step", "expected"),
    [
        ("nothing", 0.1, -177717.0),
        ("PD", 0.1, -6233.3),
        ("boundary law, slower", 0.1, -69.18),
        ("nothing", 0.02, -177562.0),
        ("PD", 0.02, -5945.2),
        ("boundary law", 0.02, -0.3344),
    ],
)
def test_returns_of_the_baselines(name: str, step: float, expected: float) -> None:
    """As docs/bridges.md prints them: the whole run of the preset `paper`."""
    env = gymnasium.make(TIP, scenario="paper", step=step)
    policy = Nothing(env) if (given := law(name)) is None else OuterLaw(env, given)
    assert play(env, policy, seed=0) == pytest.approx(expected, rel=1e-3)
    page = (Path(__file__).parents[2] / "docs" / "bridges.md").read_text(encoding="utf-8")
    assert f"| {name} | {step:g} s | {expected:g} |" in page


@pytest.mark.slow
@pytest.mark.parametrize("options", [{}, {"mode": "voltage"}])
def test_stable_baselines3_accepts_it_without_a_warning(options: dict[str, Any]) -> None:
    checker = pytest.importorskip(
        "stable_baselines3.common.env_checker", reason="stable-baselines3 is not installed; it brings torch"
    )
    checker.check_env(make(**options).unwrapped, warn=True)


@pytest.mark.slow
def test_several_at_once() -> None:
    for mode in ("sync", "async"):
        envs = gymnasium.make_vec(TIP, num_envs=2, vectorization_mode=mode, scenario=load("paper", SHORT), step=0.5)
        observations, _ = envs.reset(seed=3)
        assert observations.shape[0] == 2
        for _ in range(5):
            observations, *_ = envs.step(envs.action_space.sample())
        assert np.isfinite(observations).all()
        envs.close()


def test_a_scenario_beside_a_study_is_refused():
    with pytest.raises(ScenarioError, match="none beside a study"):
        gymnasium.make(TIP, scenario="paper", study="paper-robustness")
