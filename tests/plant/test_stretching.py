"""Heave in the tension of a cable that stretches: against the frequency domain, its rates, what is told and refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.plant.test_heaving_sea import SEA
from umbilical import Scenario, simulate
from umbilical.errors import ScenarioError
from umbilical.library.admit import admit
from umbilical.plant.rope.assemble import stiffness
from umbilical.plant.stretching import stretching
from umbilical.plant.top import top_at
from umbilical.screening import load_operation, respond
from umbilical.sea import Spectrum
from umbilical.verify.engine import open_loop, sine

STILL = {"law": "constant", "length": 3000.0}
BOW_QUARTER = 2.356194490192345
PAYLOAD = {"mass": 9000.0, "wet_weight": 35e3, "damping": 0.0,
           "water": {"vertical_added_mass": 8000.0, "vertical_drag": 4500.0}}  # fmt: skip
WAVES = SEA["systems"][0] | {"heading": BOW_QUARTER, "components": 200}
SHIP = SEA["vessel"] | {"sheave_forward": 10.0}


def work_class(**more: Any) -> Scenario:
    """The work-class cable and body as a string without sideways loads."""
    return open_loop(winch=STILL).replace({
        "cable.line_density": 5.412, "cable.wet_line_density": 4.124, "cable.axial_stiffness": 2.6e7,
        "payload": PAYLOAD, "environment.gravity": 9.81, "environment.water": {},
        "environment.sea": SEA | {"systems": [WAVES], "vessel": SHIP}, "environment.vessel_ramp": 30.0,
        "duration": 120.0, **more,
    })  # fmt: skip


def tops(scenario: Scenario, t: np.ndarray) -> Any:
    sections = scenario.winch, scenario.environment, scenario.cable, scenario.payload, scenario.duration
    return top_at(scenario.winch, t, environment=scenario.environment, stretching=stretching(*sections))


def dynamic(scenario: Scenario, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tension beyond the static one at ROV and sheave, N, of a winch that stands still."""
    top = tops(scenario, t)
    drag = 4500.0 * abs(top.sink_speed) * top.sink_speed
    end = top.elastic_tension - 17e3 * top.sink_acceleration - drag
    return end, end + 3000.0 * (top.elastic_gradient - 5.412 * top.sink_acceleration)


def test_its_spread_is_that_of_the_frequency_domain() -> None:
    end, top = dynamic(work_class(), np.arange(60.0, 10800.0, 0.5))
    found = respond(load_operation("work-class"), Spectrum(2.5, 8.0), depth=3000.0, heading=BOW_QUARTER)
    assert end.std() == pytest.approx(float(found.end.rms), rel=0.015)
    assert top.std() == pytest.approx(float(found.top.rms), rel=0.015)


@pytest.mark.parametrize("ramp", [0.0, 30.0])
@pytest.mark.parametrize("winch", [STILL, {"law": "speed", "start_length": 1400.0, "speed": 1.0}])
def test_its_rates_are_derivatives(winch: dict[str, Any], ramp: float) -> None:
    scenario, t, h = work_class(winch=winch, **{"environment.vessel_ramp": ramp}), np.linspace(1.0, 60.0, 400), 1e-4
    before, now, after = (tops(scenario, t + shift) for shift in (-h, 0.0, h))
    for name in ("elastic_tension", "elastic_gradient"):
        rate = (getattr(after, name) - getattr(before, name)) / (2.0 * h)
        assert abs(getattr(now, f"{name}_rate") - rate).max() < 1e-4 * abs(rate).max(), name


def test_the_balance_of_powers_closes_while_the_cable_is_paid_out() -> None:
    run = simulate(work_class(
        winch={"law": "speed", "start_length": 1400.0, "speed": 1.0}, duration=60.0,
        grid={"elements": 16, "step": 0.02},
        initial={"shape": "gaussian", "amplitude": 5.0, "distance": 700.0, "width": 150.0},
    ))  # fmt: skip
    assert run.metrics["energy_balance_residual"] < 1e-4
    assert abs(run["work_tension"].values).max() > 0.01 * abs(run["energy"].values).max()


def test_long_waves_find_a_cable_that_does_not_stretch() -> None:
    slow = work_class(**{"environment.sea": None, "environment.vessel_heave": [sine(1.0, 0.02)]})
    assert "as of a cable that does not stretch" in told(slow)
    assert abs(tops(slow, np.linspace(0.0, 600.0, 200)).elastic_tension).max() == 0.0
    near = work_class(**{"environment.sea": None, "environment.vessel_heave": [sine(1.0, 0.3)]})
    assert "by the axial transfer" in told(near)


def test_both_ways_meet_in_long_waves() -> None:
    scenario = work_class(**{"environment.sea": None, "environment.vessel_heave": [sine(1.0, 0.3), sine(2.0, 0.03)],
                             "payload.water.vertical_drag": 0.0})  # fmt: skip
    t = np.linspace(0.0, 400.0, 4001)
    only = scenario.replace({"environment.vessel_heave": [sine(1.0, 0.3)]})
    slow = tops(scenario, t).elastic_tension - tops(only, t).elastic_tension
    assert abs(slow).max() < 0.006 * 17e3 * 2.0 * 0.03**2


def told(scenario: Scenario) -> str:
    return " ".join(map(str, admit(scenario)))


def test_how_far_both_ways_are_apart_is_told() -> None:
    words = told(work_class())
    assert "by the axial transfer" in words
    assert "10.2 s on 3000 m" in words
    assert "at the sheave 9164 N with stretch and 6342 N without" in words


TABLE = {"kind": "table", "times": [0.0, 1.0, 2.0, 3.0, 200.0], "values": [0.0, 0.1, 0.0, 0.1, 0.0],
         "interpolation": "smooth"}  # fmt: skip


@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        ({"cable.axial_stiffness": 2e5}, "cable.axial_stiffness", "ten times the static tension"),
        ({"cable.axial_stiffness": -1.0}, "cable.axial_stiffness", "elastic"),
        ({"environment.sea": None, "environment.vessel_heave": [TABLE]}, "cable.axial_stiffness", "a table has none"),
        ({"rope": {"axial_stiffness": 2.6e7}}, "rope.axial_stiffness", "it is cable.axial_stiffness"),
        ({"environment.sea.systems.1.significant_height": 9.0}, "environment.sea", 'model = "rope"'),
    ],
)
def test_it_is_refused(change: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        admit(work_class(**change))
    assert words in {problem.key: str(problem) for problem in caught.value.problems}[key]


def test_the_rope_takes_the_stiffness_of_the_cable() -> None:
    assert stiffness(work_class(model="rope")) == 2.6e7
