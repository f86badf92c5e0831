"""The static slope under loads that last: closed forms, the plant itself, and what is refused or told."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from umbilical.errors import ScenarioError
from umbilical.library import admit
from umbilical.plant.checks.moving import MovingCable
from umbilical.plant.checks.statics import Steady, statics, steady_slope
from umbilical.scenario import Scenario


def of(scenario: Scenario) -> Steady:
    return steady_slope(MovingCable.of(scenario), scenario.control)


def constant(value: float) -> list[dict[str, Any]]:
    return [{"kind": "constant", "value": value}]


def along(signal: list[dict[str, Any]], profile: dict[str, Any] | None = None) -> list[dict[str, Any]]:
    return [{"profile": profile or {"shape": "uniform"}, "signal": signal}]


DEEP = {"winch": {"law": "constant", "length": 3000.0}, "environment.payload_force": [], "duration": 300.0}
UNCONTROLLED = {"control.law": {"kind": "none"}}


def test_a_uniform_load_and_a_force_have_closed_forms() -> None:
    scenario = umbilical.load("paper", DEEP | UNCONTROLLED | {"environment.cable_load": along(constant(5.0))})
    gravity = scenario.environment.gravity
    top = (scenario.payload.mass + 3000.0 * scenario.cable.line_density) * gravity
    assert of(scenario) == (pytest.approx(5.0 * 3000.0 / top, rel=1e-9), 0.0, True)
    pushed = umbilical.load("paper", DEEP | UNCONTROLLED | {"environment.payload_force": constant(-400.0)})
    assert of(pushed) == (pytest.approx(400.0 / (500.0 * gravity), rel=1e-9), 1.0, True)
    held = umbilical.load("paper", DEEP | {"environment.payload_force": constant(-400.0)})
    assert of(held).slope == 0.0


@pytest.mark.parametrize("law", ["none", "boundary", "pd"])
def test_the_plant_comes_to_rest_there(law: str) -> None:
    preset = {"none": "paper-none", "boundary": "paper", "pd": "paper-pd"}[law]
    gaussian = {"shape": "gaussian", "center": 0.6, "width": 0.3}
    changes = {
        "winch": {"law": "constant", "length": 100.0}, "duration": 240.0, "initial": {"shape": "straight"},
        "environment.payload_force": constant(300.0), "environment.cable_load": along(constant(4.0), gaussian),
        "cable.damping": 0.5, "payload.damping": 300.0, "grid.elements": 8, "output.interval": 10.0,
        "ideal_thruster": True,
    }  # fmt: skip
    scenario = umbilical.load(preset, changes)
    run = umbilical.simulate(scenario)
    assert np.abs(run["velocity"].values[-1]).max() < 1e-3
    found = of(scenario)
    rest = np.abs(run["slope"].values[-1])
    # The boundary law lets the ROV creep for hours, and what lasts is what was there first.
    assert found.slope == pytest.approx(rest.max(), rel=0.05 if law == "boundary" else 0.01)
    assert run["sigma"].values[np.argmax(rest)] == pytest.approx(found.sigma, abs=0.05)


@pytest.mark.parametrize("load", [4.0, 46.0])
def test_refused_above_three_tenths_and_each_fix_holds(load: float) -> None:
    deep = DEEP | {"environment.cable_load": along(constant(load))}
    with pytest.raises(ScenarioError, match=r"a static slope") as caught:
        umbilical.load("paper", deep)
    problem = caught.value.problems[0]
    share = float(problem.fix.partition("loads below ")[2].split()[0])
    eased = DEEP | {"environment.cable_load": along(constant(0.999 * share * load))}
    assert of(umbilical.load("paper", eased)).slope == pytest.approx(0.3, abs=0.002)
    assert umbilical.load("paper", deep | {"model": "rope"}).model == "rope"


def test_a_slower_current_is_a_fix() -> None:
    """Drag is quadratic, so the share of the current is a root."""
    current = {"depths": [0.0, 1000.0], "speeds": [2.0, 1.0]}
    preset, key = "work-class-1000m-current", "environment.water.current.speeds"
    with pytest.raises(ScenarioError, match=r"a static slope") as caught:
        umbilical.load(preset, {key: current["speeds"]})
    share = float(caught.value.problems[0].fix.partition("current below ")[2].split()[0])
    slower = umbilical.load(preset, {key: [0.999 * share * speed for speed in current["speeds"]]})
    assert of(slower).slope == pytest.approx(0.3, abs=0.002)


@pytest.mark.parametrize(
    "station",
    [{}, {"station_gain": 0.1}, {"washout_time": 120.0}, {"station_gain": 0.1, "washout_time": 120.0, "station": 8.0}],
)
def test_the_plant_comes_to_rest_there_in_a_current(station: dict[str, float]) -> None:
    options = {"station_gain": None, "washout_time": None} | station
    changes: dict[str, Any] = {f"control.law.{name}": value for name, value in options.items()}
    scenario = umbilical.load("work-class-1000m-current", changes | {"grid.elements": 16})
    rest = np.abs(umbilical.simulate(scenario)["slope"].values[-1])
    assert of(scenario).slope == pytest.approx(rest.max(), rel=0.01)


def test_slope_and_tension_of_the_preset_in_a_current_are_told() -> None:
    found = statics(umbilical.load("work-class-1000m-current"))
    assert found is not None
    assert (found.least, found.largest) == pytest.approx((35e3, 35e3 + 4.124 * 9.81 * 1000.0))
    assert 0.02 < found.slope < 0.05
    assert statics(umbilical.load("observation-300m")) is None


@pytest.mark.parametrize("lasting", [False, True])
def test_only_what_lasts_counts(lasting: bool) -> None:
    """Half a period of the slowest wave is some 90 s here."""
    pulse = [{"kind": "pulse", "value": 46.0, "start": 50.0, "end": 200.0 if lasting else 90.0}]
    scenario = DEEP | UNCONTROLLED | {"environment.cable_load": along(pulse)}
    if lasting:
        with pytest.raises(ScenarioError, match="static slope"):
            umbilical.load("paper", scenario)
    else:
        assert of(umbilical.load("paper", scenario)).slope == 0.0
    sine = [{"kind": "sine", "amplitude": 46.0, "frequency": 0.5}]
    assert of(umbilical.load("paper", DEEP | UNCONTROLLED | {"environment.cable_load": along(sine)})).slope == 0.0


def test_a_run_too_short_to_get_there_is_told_only() -> None:
    short = DEEP | {"duration": 10.0, "environment.cable_load": along(constant(46.0))}
    assert any("static slope" in str(notice) for notice in admit(umbilical.load("paper", short)))


def test_a_slack_cable_has_no_static_shape_and_is_refused_by_what_it_is() -> None:
    """Found by fuzzing: the square root of a negative tension was no number."""
    with pytest.raises(ScenarioError, match="must stay above 0"):
        admit(umbilical.load("paper", {"environment.gravity": 1e-9, "duration": 0.02}))
