"""The rope behind the engine: scenarios of the string on it, episodes, sensors, user controllers, how runs end."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from umbilical import Command, Measurement, Status
from umbilical.engine.episode import Episode
from umbilical.engine.simulate import measure, simulate
from umbilical.errors import ScenarioError
from umbilical.library import load

SMALL = {"environment.payload_force": [{"kind": "sine", "amplitude": 1.0, "frequency": 0.5}]}
ROPE = {"model": "rope", "duration": 4.0}
SHORT = {"depths": [0.0, 500.0], "speeds": [0.1, 0.1], "speeds_across": [0.1]}
SLOW = {"rope.elements": 400, "cable.axial_stiffness": 1e12, "output.interval": 100.0, "duration": 5e4}


@pytest.mark.parametrize("name", ["crosscheck-none", "crosscheck-pd", "crosscheck-proposed", "paper", "paper-dead"])
def test_one_key_takes_a_scenario_of_the_string_to_the_rope(name: str) -> None:
    scenario = load(name, SMALL | {"duration": 10.0})
    string, rope = simulate(scenario), simulate(scenario.replace({"model": "rope"}))
    assert rope.status is Status.COMPLETED
    for metric in ("tip_peak", "tip_rms"):
        assert rope.metrics[metric] == pytest.approx(string.metrics[metric], rel=1e-3)
    assert rope.metrics["energy_balance_residual"] < 1e-6
    assert any("cable.axial_stiffness" in notice and "assumed" in notice for notice in rope.notices)


def test_the_plane_is_turned_with_the_loads() -> None:
    """What acts along y moves the body along y as what acts along x moves it along x."""
    along = simulate(load("crosscheck-none", SMALL | ROPE))
    across = {"environment.payload_force": [], "rope.force_across": SMALL["environment.payload_force"]}
    turned = simulate(load("crosscheck-none", across | ROPE))
    x, y = along["body_position"].values, turned["body_position"].values
    assert np.abs(x[:, 0]).max() > 1e-3
    np.testing.assert_allclose(y[:, 1], x[:, 0], atol=1e-9)
    np.testing.assert_allclose(y[:, 0], x[:, 1], atol=1e-9)


def test_control_of_both_directions_with_ideal_thrusters() -> None:
    both = SMALL | ROPE | {"rope.force_across": SMALL["environment.payload_force"]}
    run = simulate(load("crosscheck-proposed", both))
    place = run["body_position"].values
    np.testing.assert_allclose(place[:, 0], place[:, 1], atol=1e-10)
    np.testing.assert_allclose(run["thrust_command"], run["thrust_command_across"], atol=1e-7)
    assert np.abs(place[:, :2]).max() < 1e-4


def test_directed_motors_push_where_they_point() -> None:
    """Two motors, one along each axis: the force across is met by the second alone."""
    changes = {"environment.payload_force": [], "rope.force_across": SMALL["environment.payload_force"]}
    run = simulate(load("paper", ROPE | changes | {"rope.thrust_directions": [0.0, np.pi / 2.0]}))
    thrust = run["body_thrust"].values
    assert np.abs(thrust[:, 1]).max() > 0.5
    assert np.abs(thrust[:, 0]).max() < 0.1


class Watching:
    """Pushes against the body's velocity along both directions, and keeps what it saw."""

    period = 0.01

    def start(self, measurement: Measurement) -> list[Measurement]:
        return [measurement]

    def update(self, t: float, measurement: Measurement, state: Any) -> tuple[Command, Any]:
        state.append(measurement)
        across = measurement.across
        assert across is not None
        return Command(thrust=-measurement.tip_displacement, thrust_across=-across.tip_displacement), state


def test_a_python_controller_gets_both_directions_and_the_tension() -> None:
    scenario = load("crosscheck-none", SMALL | ROPE | {"rope.force_across": [{"kind": "constant", "value": 5.0}]})
    seen: list[Measurement] = []

    class Keeping(Watching):
        def start(self, measurement: Measurement) -> list[Measurement]:
            return seen

    run = simulate(scenario, Keeping())
    assert run.status is Status.COMPLETED
    assert seen[-1].tip_tension == pytest.approx(5000.0, rel=1e-2)
    assert seen[-1].across is not None
    assert seen[-1].across.tip_displacement > 0.0
    assert run["thrust_command_across"].values[-1] < 0.0


def test_an_episode_goes_back_to_a_mark() -> None:
    episode = Episode(load("crosscheck-pd", SMALL | ROPE), 0.5)
    episode.step(Command(thrust=1.0, thrust_across=2.0))
    mark = episode.save()
    first = episode.step(Command(thrust=3.0))
    episode.restore(mark)
    again = episode.step(Command(thrust=3.0))
    assert again.tip_displacement == first.tip_displacement
    assert again.across == first.across


def test_noise_of_the_direction_x_is_that_of_the_string() -> None:
    noisy = {"sensors.tip_displacement.noise": 1e-3, "duration": 0.2}
    string = simulate(load("crosscheck-pd", noisy))
    rope = simulate(load("crosscheck-pd", noisy | {"model": "rope"}))
    np.testing.assert_allclose(rope["thrust_command"], string["thrust_command"], rtol=1e-3, atol=1e-3)


def test_a_run_is_stored_and_read(tmp_path: Any) -> None:
    run = simulate(load("paper", ROPE | {"duration": 0.5}))
    path = run.save(tmp_path / "rope.nc")
    again = umbilical.open_run(path)
    assert again["position"].dims == ("time", "axis", "sigma")
    np.testing.assert_array_equal(again["position"], run["position"])
    assert again.scenario == run.scenario


def test_snaps_are_counted_and_slack_is_measured() -> None:
    heave = {
        "environment.vessel_heave": [{"kind": "sine", "amplitude": 3.0, "frequency": 2.0}],
        "environment.vessel_ramp": 2.0,
        "payload.water": {"vertical_drag": 500.0, "vertical_added_mass": 400.0},
        "payload.wet_weight": 5000.0,
        "environment.water": {},
        "cable.axial_stiffness": 1e7,
    }
    run = simulate(load("paper-none", {"model": "rope", "duration": 12.0, "output.interval": 0.01} | heave))
    assert run.status is Status.COMPLETED
    assert run.metrics["snaps"] >= 2
    assert run.metrics["largest_snap"] > 2.0 * run["top_tension"].values[0]
    assert 0.0 < run.metrics["slack_share"] < 1.0
    assert run["lowest_tension"].values.min() == 0.0
    assert all(np.isfinite(run[str(name)].values).all() for name in run.data.data_vars)


def test_a_cable_that_parts_ends_the_run_with_a_reason() -> None:
    pulled = {
        "rope.force_up": [{"kind": "constant", "value": -2e7}], "cable.axial_stiffness": 1.5e6,
        "winch.start_length": 50.0, "winch.end_length": 50.0,
    }  # fmt: skip
    run = simulate(load("paper-none", ROPE | pulled))
    assert run.status is Status.DIVERGED
    assert "parted" in run.reason


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"cable.axial_stiffness": 1e4}, "cable.axial_stiffness"),
        ({"cable.wet_line_density": -20.0}, "payload.wet_weight"),
        ({"environment.water": {"current": SHORT}}, "environment.water.current.speeds_across"),
        (SLOW, "rope.elements"),
        ({"rope.thrust_directions": [0.0, 1.0, 2.0]}, "rope.thrust_directions"),
        ({"rope.vessel_across": [{"kind": "step", "time": 1.0, "value": 1.0}]}, "rope.vessel_across.1.kind"),
    ],
)  # fmt: skip
def test_what_cannot_be_run_is_refused(changes: dict[str, Any], key: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        load("paper", {"model": "rope"} | changes)
    assert key in {problem.key for problem in caught.value.problems}


def test_the_number_of_steps_and_the_time_they_take_are_said() -> None:
    with pytest.raises(ScenarioError, match=r"steps, not .* hours"):
        load("paper", {"model": "rope"} | SLOW)


def test_metrics_do_not_depend_on_what_is_stored() -> None:
    scenario = load("crosscheck-pd", SMALL | ROPE)
    stored = simulate(scenario).metrics
    assert measure(scenario).metrics.items() <= stored.items()


def test_a_run_says_what_thrusters_without_a_limit_gave():
    run = simulate(load("observation-300m", {"duration": 1.0}))
    (notice,) = (notice for notice in run.notices if notice.startswith("ideal_thruster"))
    assert f"{run.metrics['thrust_peak']:.4g} N along x" in notice
    idle = simulate(load("observation-300m", {"duration": 1.0, "control.law": {"kind": "none"}}))
    assert not any(notice.startswith("ideal_thruster") for notice in idle.notices)
