"""Every family of bad input gets its refusal: the key, and a bound that says what is allowed."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from umbilical.errors import Problem, ScenarioError
from umbilical.library import load
from umbilical.scenario.document import look_up

Case = tuple[dict[str, Any], str, str]


def problems(overrides: dict[str, Any], preset: str = "paper") -> dict[str, list[Problem]]:
    """Problems by key of a preset with overrides; at least one, or the test fails."""
    with pytest.raises(ScenarioError) as caught:
        load(preset, overrides)
    found: dict[str, list[Problem]] = {}
    for problem in caught.value.problems:
        found.setdefault(problem.key, []).append(problem)
    return found


def expect(case: Case, preset: str = "paper") -> None:
    overrides, key, fragment = case
    found = problems(overrides, preset)
    assert key in found, f"{key} not among {sorted(found)}"
    assert any(fragment in problem.bound for problem in found[key]), found[key]
    for problem in found[key]:
        assert all((problem.value, problem.bound, problem.reason, problem.fix)), problem


def named(cases: list[Case]) -> Any:
    """One test per case, named by its key and value."""
    return pytest.mark.parametrize("case", cases, ids=[f"{key}-{str(over)[-40:]}" for over, key, _ in cases])


NUMBERS: list[Case] = [
    ({"cable.line_density": float("nan")}, "cable.line_density", "a finite number"),
    ({"cable.line_density": float("inf")}, "cable.line_density", "a finite number"),
    ({"cable.line_density": float("-inf")}, "cable.line_density", "a finite number"),
    ({"cable.line_density": -2.0}, "cable.line_density", "at least 1e-06"),
    ({"cable.line_density": 0.0}, "cable.line_density", "at least 1e-06 and at most 10000 kg/m"),
    ({"cable.line_density": 1e308}, "cable.line_density", "at most 10000 kg/m"),
    ({"payload.mass": 1e308}, "payload.mass", "at most 1e+09 kg"),
    ({"control.law.damping_gain": 1e308}, "control.law.damping_gain", "at most 1e+12 N s/m"),
    ({"payload.mass": "500"}, "payload.mass", "a number"),
    ({"payload.mass": True}, "payload.mass", "a number"),
    ({"payload.mass": [500.0]}, "payload.mass", "a number"),
    ({"payload.mass": {"kg": 500.0}}, "payload.mass", "a number"),
    ({"payload": 500.0}, "payload", "a table"),
    ({"motors": 2}, "motors", "a list"),
    ({"seed": 1.5}, "seed", "a whole number"),
    ({"seed": -1}, "seed", "at least 0"),
    ({"grid.elements": 3}, "grid.elements", "at least 4"),
    ({"grid.elements": 24.5}, "grid.elements", "a whole number"),
    ({"ideal_thruster": 1}, "ideal_thruster", "true or false"),
    ({"name": ""}, "name", "1 or more characters"),
    ({"environment.gravity": -9.81}, "environment.gravity", "above 0"),
    ({"duration": 0.0}, "duration", "above 0"),
    ({"duration": -50.0}, "duration", "above 0"),
    ({"winch.start_length": 0.5}, "winch.start_length", "at least 1 and at most 20000 m"),
    ({"winch.start_length": 4.5e5}, "winch.start_length", "at most 20000 m"),
    ({"cable.line_densty": 2.0}, "cable.line_densty", "line_density"),
    ({"cabel.line_density": 2.0}, "cabel", "cable"),
    ({"payload.mass": None}, "payload.mass", "above 0"),
    ({"payload": None}, "payload", "required"),
    ({"motors.3.inertia": 1.0}, "motors.3.inertia", "places 1 to 2 of motors"),
    ({"motors.0.inertia": 1.0}, "motors.0.inertia", "places 1 to 2 of motors"),
    ({"payload.mass.kg": 1.0}, "payload.mass.kg", "payload.mass is 500.0"),
    ({"assumed.cabel": "a slip"}, "assumed.cabel", "the key of a value"),
    ({"environment.payload_force.1.kind": "cosine"}, "environment.payload_force.1.kind", "one of constant, sine"),
    ({"control.law.kind": "pid"}, "control.law.kind", "one of none, pd, boundary"),
    ({"control.law.rates": "sensors"}, "control.law.rates", "one of sensor, observer"),
]

LENGTH_LAWS: list[Case] = [
    ({"winch": {"law": "speed", "start_length": 450.0, "speed": -9.0}}, "winch.speed", "from 1 m to 20000 m"),
    ({"winch": {"law": "speed", "start_length": 450.0, "speed": 51.0}}, "winch.speed", "slower than the waves, 50 m/s"),
    ({"winch": {"law": "speed", "start_length": 450.0, "speed": float("nan")}}, "winch.speed", "a finite number"),
    (
        {"winch": {"law": "cosine", "start_length": 450.0, "amplitude": -224.6, "frequency": 0.1}},
        "winch.amplitude",
        "from 1 m to 20000 m",
    ),
    (
        {"winch": {"law": "cosine", "start_length": 450.0, "amplitude": 10.0, "frequency": 1.01}},
        "winch.frequency",
        "below gravity, 10 m/s2",
    ),
    ({"winch.duration": 2.0, "winch.end_length": 530.0}, "winch.duration", "below gravity, 10 m/s2"),
    (
        {
            "winch": {
                "law": "trapezoid",
                "start_length": 450.0,
                "end_length": 500.0,
                "top_speed": 5.0,
                "acceleration": 10.0,
            }
        },
        "winch.acceleration",
        "below gravity",
    ),
    (
        {"winch": {"law": "table", "times": [0.0, 2.0, 1.0, 50.0], "lengths": [450.0] * 4}},
        "winch.times.3",
        "above the one before it, 2",
    ),
    (
        {"winch": {"law": "table", "times": [0.0, 2.0, 2.0, 50.0], "lengths": [450.0] * 4}},
        "winch.times.3",
        "above the one before it, 2",
    ),
    (
        {"winch": {"law": "table", "times": [0.0, 1.0, 2.0, 49.0], "lengths": [450.0] * 4}},
        "winch.times",
        "at least 0 to 50",
    ),
    (
        {"winch": {"law": "table", "times": [0.1, 1.0, 2.0, 50.0], "lengths": [450.0] * 4}},
        "winch.times",
        "at least 0 to 50",
    ),
    (
        {"winch": {"law": "table", "times": [0.0, 1.0, 50.0], "lengths": [450.0] * 3}},
        "winch.times",
        "4 or more entries",
    ),
    (
        {"winch": {"law": "table", "times": [0.0, 1.0, 2.0, 50.0], "lengths": [450.0] * 5}},
        "winch.lengths",
        "4 entries",
    ),
    (
        {"winch": {"law": "table", "times": [0.0, 1.0, 2.0, 50.0], "lengths": [450.0, 450.0, 470.0, 900.0]}},
        "winch.lengths",
        "below gravity",
    ),
    ({"winch": {"law": "quintic", "length": 500.0}}, "winch.length", "start_length, end_length"),
    ({"winch": {"length": 500.0}}, "winch.law", "required"),
    (
        {"environment.vessel_motion": [{"kind": "step", "value": 1.0, "time": 5.0}]},
        "environment.vessel_motion.1.kind",
        "constant, sine",
    ),
    (
        {"environment.vessel_motion": [{"kind": "sine", "amplitude": 1.0, "frequency": 0.5}]},
        "environment.vessel_motion",
        "0 m/s",
    ),
    (
        {"environment.vessel_motion": [{"kind": "constant", "value": 1.0}]},
        "environment.vessel_motion",
        "the initial shape at the vessel, 0 m",
    ),
    (
        {"initial": {"shape": "table", "positions": [0.0, 0.3, 0.6, 1.0], "displacements": [1.0, 1.0, 1.0, 1.0]}},
        "environment.vessel_motion",
        "the initial shape at the vessel, 1 m",
    ),
    (
        {"initial": {"shape": "table", "positions": [0.0, 0.3, 0.6, 0.9], "displacements": [0.0, 1.0, 1.0, 1.0]}},
        "initial.positions",
        "exactly 0 to 1",
    ),
    (
        {"environment.payload_force": [{"kind": "pulse", "value": 1.0, "start": 5.0, "end": 5.0}]},
        "environment.payload_force.1.end",
        "above start = 5 s",
    ),
    (
        {"environment.payload_force": [{"kind": "table", "times": [0.0, 10.0], "values": [1.0, 2.0]}]},
        "environment.payload_force.1.times",
        "at least 0 to 50",
    ),
    ({"control.period": 3e-3}, "duration", "a multiple of control.period = 0.003 s"),
    ({"duration": 50.0005}, "duration", "a multiple of control.period"),
    ({"control.outer_period": 1.5e-3}, "control.outer_period", "a multiple of control.period"),
    ({"output.interval": 5e-4}, "output.interval", "a multiple of control.period"),
    ({"duration": 1e6, "output.interval": 1e6}, "duration", "1e+08 steps"),
    ({"output.interval": 1e-3, "grid.elements": 1000}, "output.interval", "1e+08 stored values"),
    ({"control.period": 1e-320}, "duration", "1e+08 steps"),
    ({"grid.step": 1e-320}, "duration", "1e+08 steps"),
    (
        {"payload.mass": 1e9, "grid.elements": 4096},
        "grid.elements",
        "1e+08 steps",
    ),
    ({"cable.damping": 3000.0}, "cable.damping", "below 981.818 N s/m2"),
    ({"payload.damping": 6e5}, "payload.damping", "below 245455 N s/m"),
    ({"payload.mass": 5e-5}, "payload.mass", "at least 6.47876e-05 kg at a step of 0.001 s"),
]

GAINS: list[Case] = [
    ({"control.law.damping_gain": -1e4}, "control.law.damping_gain", "above 0"),
    ({"control.law.slope_gain": -0.01}, "control.law.slope_gain", "at least 0"),
    ({"control.law.damping_gain": 5e5}, "control.law.damping_gain", "below 500000 N s/m at a period of 0.001 s"),
    (
        {"control.law.damping_gain": 2e5},
        "control.velocity_observer.time_constant",
        "below damping * mass / damping_gain = 0.005 s",
    ),
    ({"control.disturbance_observer.gain": 1e6}, "control.disturbance_observer.gain", "below 1000 1/s"),
    ({"control.disturbance_observer.gain": -5.0}, "control.disturbance_observer.gain", "above 0"),
    ({"control.velocity_observer.time_constant": 1e-6}, "control.velocity_observer.time_constant", "at least 0.002 s"),
    ({"control.slope_observer.time_constant": 1e-6}, "control.slope_observer.time_constant", "at least 0.002 s"),
    ({"control.outer_period": 5e-3}, "control.slope_observer.time_constant", "at least 0.01 s"),
    ({"control.velocity_observer": None}, "control.velocity_observer", "required"),
    ({"control.slope_observer": None}, "control.slope_observer", "required"),
    ({"control.law.rates": "sensor"}, "control.law.rates", "sensors.ideal_velocity = true"),
    ({"control.motor_loop.current_gain": 2000.0}, "control.motor_loop.current_gain", "below 1000 1/s"),
    (
        {"control.motor_loop.current_width": 0.1},
        "control.motor_loop.current_gain",
        "500 + 1800 = 2300 1/s",
    ),
    ({"control.motor_loop.speed_width": 6e-3}, "control.motor_loop.speed_gain", "50 + 1000 = 1050 1/s"),
    ({"control.motor_loop.speed_gain": -50.0}, "control.motor_loop.speed_gain", "above 0"),
    ({"control.motor_loop.observer_gain": 1e6}, "control.motor_loop.observer_gain", "below 1000 1/s"),
    ({"control.motor_loop.filter_frequency": 1e3}, "control.motor_loop.filter_frequency", "below 1000 rad/s"),
    ({"control.motor_loop.robust_factor": 0.5}, "control.motor_loop.robust_factor", "at least 1"),
    ({"control.period": 1e-2}, "control.velocity_observer.time_constant", "at least 0.02 s"),
    ({"control.nominal.thrust_coefficients": [1.2]}, "control.nominal.thrust_coefficients", "2 entries"),
    ({"control.nominal.thrust_coefficients": [1.2, 0.0]}, "control.nominal.thrust_coefficients.2", "above or below 0"),
]

PD_GAINS: list[Case] = [
    ({"control.law.velocity_gain": -10.0}, "control.law.velocity_gain", "at least 0"),
    ({"control.law.velocity_gain": 5e5}, "control.law.velocity_gain", "below 500000 N s/m"),
    ({"control.law.position_gain": 5e8}, "control.law.position_gain", "below 5e+08 N/m"),
    ({"sensors.ideal_velocity": False}, "control.law.velocity", '"observer"'),
    ({"control.law.velocity": "observer", "control.velocity_observer": None}, "control.velocity_observer", "required"),
]

ADAPTIVE_GAINS: list[Case] = [
    ({"control.allocation.rates": [0.1, 100.0]}, "control.allocation.rates", "3 entries"),
    ({"control.allocation.rates.2": -100.0}, "control.allocation.rates.2", "above 0"),
    ({"control.allocation.rates.2": 0.0}, "control.allocation.rates.2", "above 0"),
    ({"control.allocation.initial": [0.25] * 4}, "control.allocation.initial", "3 entries"),
    ({"control.allocation.leak": -1e-3}, "control.allocation.leak", "at least 0"),
    ({"control.allocation.leak": 10.0}, "control.allocation.leak", "below 10"),
    ({"control.allocation.lower": [0.3, -1.0, -1.0]}, "control.allocation.initial.1", "from 0.3 to 0.25"),
    ({"control.allocation.upper": [0.2, 1.0, 1.0]}, "control.allocation.initial.1", "from 0.25 to 0.2"),
    ({"control.allocation.rates.1": 1e308}, "control.allocation.rates.1", "at most 1e+12"),
    ({"control.allocation.initial.3": float("nan")}, "control.allocation.initial.3", "a finite number"),
    ({"control.allocation.upper": [1.0, 1.0]}, "control.allocation.upper", "3 entries"),
    ({"ideal_thruster": True}, "control.allocation.method", "with ideal_thruster"),
]

MOTOR: list[Case] = [
    ({"motors.1.inductance": 0.0}, "motors.1.inductance", "above 0"),
    ({"motors.1.inductance": 1e-6}, "grid.step", "at most"),
    ({"motors.2.inductance": 1e-320}, "grid.step", "at most"),
    ({"motors.1.resistance": 0.0}, "motors.1.resistance", "above 0"),
    ({"motors.1.inertia": 0.0}, "motors.1.inertia", "above 0"),
    ({"motors.1.inertia": 1e-3}, "grid.step", "at most"),
    ({"motors.1.thrust_coefficient": 0.0}, "motors.1.thrust_coefficient", "above or below 0"),
    ({"motors.2.voltage_limit": 0.0}, "motors.2.voltage_limit", "above 0"),
    ({"motors": []}, "motors", "at least one"),
    ({"control.motor_loop": None}, "control.motor_loop", "required"),
    ({"faults": [{"kind": "dead", "motor": 3, "start": 10.0}]}, "faults.1.motor", "from 1 to 2"),
    ({"faults": [{"kind": "dead", "motor": 0, "start": 10.0}]}, "faults.1.motor", "at least 1"),
    ({"faults": [{"kind": "dead", "motor": 1, "start": -1.0}]}, "faults.1.start", "at least 0"),
    ({"faults": [{"kind": "dead", "motor": 1, "start": 10.0, "end": 9.0}]}, "faults.1.end", "above start = 10 s"),
    ({"faults": [{"kind": "dead", "motor": 1, "start": 10.0, "end": 10.0}]}, "faults.1.end", "above start = 10 s"),
    (
        {"faults": [{"kind": "partial", "motor": 1, "start": 1.0, "effectiveness": 1.5}]},
        "faults.1.effectiveness",
        "at least 0 and at most 1",
    ),
    (
        {"faults": [{"kind": "partial", "motor": 1, "start": 1.0, "effectiveness": -0.1}]},
        "faults.1.effectiveness",
        "at least 0 and at most 1",
    ),
    (
        {
            "faults": [
                {"kind": "dead", "motor": 1, "start": 1.0, "end": 5.0},
                {"kind": "stuck", "motor": 1, "start": 4.999, "value": 3.0},
            ]
        },
        "faults.2",
        "not while faults.1",
    ),
    (
        {"faults": [{"kind": "intermittent", "motor": 1, "start": 0.0, "cycle": 1e-9, "duty": 0.5}]},
        "faults.1.cycle",
        "at least 0.001 s, for 100000 switches",
    ),
    ({"ideal_thruster": True, "faults": [{"kind": "dead", "motor": 1, "start": 1.0}]}, "faults.1", "none with ideal"),
    ({"sensors.tip_slope.latency": 1.5e-3}, "sensors.tip_slope.latency", "a multiple of control.period"),
    ({"sensors.tip_slope.dropout": 1.0}, "sensors.tip_slope.dropout", "below 1"),
    ({"sensors.tip_slope.noise": -1.0}, "sensors.tip_slope.noise", "at least 0"),
]

NEIGHBOURS: list[tuple[str, dict[str, Any]]] = [
    ("paper", {"winch": {"law": "speed", "start_length": 450.0, "speed": -8.5}, "grid.elements": 24}),
    ("paper", {"winch": {"law": "cosine", "start_length": 450.0, "amplitude": 10.0, "frequency": 0.99}}),
    (
        "paper",
        {
            "faults": [
                {"kind": "dead", "motor": 1, "start": 1.0, "end": 5.0},
                {"kind": "stuck", "motor": 1, "start": 5.0, "value": 3.0},
                {"kind": "stuck", "motor": 2, "start": 1.0, "value": 3.0},
                {"kind": "dead", "motor": 2, "start": 1.0, "target": "voltage"},
            ]
        },
    ),
    ("paper", {"control.law.damping_gain": 1.9e5}),
    ("paper", {"control.velocity_observer.time_constant": 0.002, "control.slope_observer.time_constant": 0.002}),
    ("paper", {"control.outer_period": 2e-3}),
    ("paper", {"control.period": 2.5e-4}),
    ("paper", {"control.motor_loop.current_gain": 900.0}),
    ("paper", {"sensors.tip_slope.latency": 3e-3}),
    ("paper", {"environment.vessel_motion": [{"kind": "sine", "amplitude": 1.0, "frequency": 0.5}],
               "environment.vessel_ramp": 4.0}),
    ("paper-adaptive", {"control.allocation.lower": [0.1, -9.0, -9.0], "control.allocation.upper": [0.9, 9.0, 9.0]}),
    ("paper", {"grid.elements": 96}),
    ("paper", {"motors.1.voltage_limit": 48.0, "motors.1.thrust_coefficient": -1.2}),
    *(("ringdown", {"control.law.slope_gain": beta}) for beta in (0.0, 0.01, 1.0, 5.0, 10.0, 20.0, 50.0)),
]  # fmt: skip


@named(NUMBERS)
def test_numbers(case: Case) -> None:
    expect(case)


@named(LENGTH_LAWS)
def test_length_laws_and_times(case: Case) -> None:
    expect(case)


@named(GAINS)
def test_gains(case: Case) -> None:
    expect(case)


@named(PD_GAINS)
def test_gains_of_the_pd_baseline(case: Case) -> None:
    expect(case, "paper-pd")


@named(ADAPTIVE_GAINS)
def test_gains_of_the_adaptive_law(case: Case) -> None:
    expect(case, "paper-adaptive")


@named(MOTOR)
def test_motors_faults_and_sensors(case: Case) -> None:
    expect(case)


@pytest.mark.parametrize(("preset", "overrides"), NEIGHBOURS)
def test_what_lies_just_inside_the_bounds_is_admitted(preset: str, overrides: dict[str, Any]) -> None:
    load(preset, overrides)


def test_all_problems_at_once_across_broken_sections() -> None:
    found = problems(
        {
            "cable.line_densty": 3.0,
            "payload.mass": "heavy",
            "winch": {"law": "speed", "start_length": 450.0, "speed": -9.0},
            "motors.7.inertia": 1.0,
            "faults": [{"kind": "dead", "motor": 3, "start": 1.0}],
            "control.motor_loop": None,
        }
    )
    assert set(found) == {
        "cable.line_densty",
        "payload.mass",
        "winch.speed",
        "motors.7.inertia",
        "faults.1.motor",
        "control.motor_loop",
    }


def test_a_bad_entry_does_not_make_its_list_too_short() -> None:
    assert set(problems({"control.allocation.rates.1": "x"}, "paper-adaptive")) == {"control.allocation.rates.1"}


def test_a_misspelt_key_is_met_with_the_nearest_name() -> None:
    assert (
        problems({"control.law.damping_gian": 1.0})["control.law.damping_gian"][0].fix == "did you mean 'damping_gain'?"
    )
    assert problems({"winch.law": "quintc"})["winch.law"][0].fix == "did you mean 'quintic'?"


def test_the_message_shows_value_and_unit() -> None:
    problem = problems({"motors.2.resistance": -0.08})["motors.2.resistance"][0]
    assert str(problem).splitlines() == [
        "motors.2.resistance = -0.08 ohm",
        "    allowed: above 0 and at most 1e+12 ohm",
        "    because: it limits the current of a stalled motor",
        "    fix:     give above 0 and at most 1e+12 ohm",
    ]


def _number_keys() -> list[str]:
    def leaves(data: Any, path: str) -> list[str]:
        if isinstance(data, dict):
            return [key for name, part in data.items() for key in leaves(part, f"{path}.{name}" if path else name)]
        if isinstance(data, list):
            return [key for number, part in enumerate(data, 1) for key in leaves(part, f"{path}.{number}")]
        return [path] if isinstance(data, float) else []

    return leaves(load("paper-stuck-adaptive").to_dict(), "")


BAD = st.sampled_from([float("nan"), float("inf"), float("-inf"), 1e308, -1e308, "1.0", True, [1.0], {}, {"a": 1}])


@settings(max_examples=60, deadline=None)
@given(st.dictionaries(st.sampled_from(_number_keys()), BAD, min_size=1, max_size=4))
def test_every_bad_number_is_named(overrides: dict[str, Any]) -> None:
    found = problems(overrides, "paper-stuck-adaptive")
    assert set(overrides) <= set(found)


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(_number_keys()), st.floats(width=64), st.floats(0.0, 1.0))
def test_any_number_is_admitted_or_refused_but_never_crashes(key: str, value: float, blend: float) -> None:
    """Values of any size in any place: the checks themselves must survive them."""
    here = look_up(load("paper-stuck-adaptive").to_dict(), key)
    for tried in (value, here * blend):
        with suppress(ScenarioError):
            load("paper-stuck-adaptive", {key: tried})


def test_a_table_that_was_expected_is_named_with_its_keys():
    found = problems({"payload": 500.0, "environment.water": {"current": [[0.0, 0.7]]}}, "paper")
    assert [problem.fix for problem in found["payload"]] == ["give a table with mass, damping"]
    assert [problem.fix for problem in found["environment.water.current"]] == ["give a table with depths, speeds"]
