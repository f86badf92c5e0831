"""Tables: round-off is no gap, a gap is shown and mended as printed, and a smooth curve stays near its data."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import umbilical
from umbilical.errors import Problem, ScenarioError
from umbilical.library import admit
from umbilical.plant.checks.tables import MOST_OVERSHOOT, overshoot
from umbilical.plant.signals import spline

PLACES = [
    "environment.payload_force", "environment.vessel_motion", "motors.1.torque_disturbance",
    "motors.2.voltage_disturbance",
]  # fmt: skip


def signal(times: Any, values: Any, **more: Any) -> list[dict[str, Any]]:
    return [{"kind": "table", "times": [float(t) for t in times], "values": [float(v) for v in values]} | more]


def length(times: Any, lengths: Any) -> dict[str, Any]:
    return {"law": "table", "times": [float(t) for t in times], "lengths": [float(v) for v in lengths]}


def shape(positions: Any, displacements: Any) -> dict[str, Any]:
    return {
        "shape": "table",
        "positions": [float(p) for p in positions],
        "displacements": [float(d) for d in displacements],
    }


def refused(overrides: dict[str, Any]) -> Problem:
    with pytest.raises(ScenarioError) as caught:
        umbilical.load("paper", overrides)
    return caught.value.problems[0]


SUMMED = np.cumsum(np.full(200, 0.1)) - 0.1  # the last is off by 3e-15 times 20, like what numpy.arange makes


@pytest.mark.parametrize("times", [[0.0, 12.0, 19.999999999999972], [1e-15, 12.0, 20.0], [*SUMMED, 20.000000000000018]])
def test_a_table_that_round_off_left_short_covers_the_run(times: list[float]) -> None:
    for interpolation in ("smooth", "linear"):
        force = signal(times, [50.0] * len(times), interpolation=interpolation)
        scenario = umbilical.load("ringdown", {"duration": 20.0, "environment.payload_force": force})
        assert admit(scenario) == ()
    run = umbilical.simulate(scenario.replace({"grid.elements": 4, "output.interval": 1.0}))
    np.testing.assert_array_equal(run["payload_force"], 50.0)


def test_the_other_tables_too() -> None:
    short = np.append(np.linspace(0.0, 0.9, 10), 0.9999999999999999)
    profile = {"shape": "table", "positions": short.tolist(), "values": [1.0] * 11}
    load = [{"profile": profile, "signal": [{"kind": "constant", "value": 0.1}]}]
    changes = {
        "winch": length([0.0, 10.0, 20.0, 49.99999999999998], [450.0] * 4),
        "initial": shape(short, 0.1 * short),
        "environment.cable_load": load,
    }
    assert umbilical.load("paper", changes)


def test_a_real_gap_is_shown_with_digits_that_differ() -> None:
    problem = refused({"environment.payload_force": signal([0.0, 49.99999], [1.0, 2.0])})
    assert problem.value == "0 to 49.99999"
    assert problem.bound == "at least 0 to 50"


def test_periods_and_instants_too() -> None:
    assert refused({"duration": 50.0000004}).value == "50.0000004 s"
    fault = {"kind": "partial", "motor": 1, "effectiveness": 0.5, "start": 1.0, "end": 0.99999999}
    found = refused({"faults": [fault]})
    assert (found.value, found.bound) == ("0.99999999 s", "above start = 1 s")
    late = umbilical.load("paper", {"faults": [fault | {"start": 50.00000001, "end": 60.0}]})
    assert "at 50.00000001 s, after the end of the run at 50 s" in str(admit(late)[0])
    assert admit(umbilical.load("paper", {"duration": 0.3, "faults": [fault | {"start": 0.1 + 0.2, "end": 9.0}]})) == ()


@pytest.mark.parametrize("reach", [60.0, 30.0])
def test_the_fix_of_epoch_times_holds(reach: float) -> None:
    epoch = 1.7e9 + np.linspace(0.0, reach, 7)
    problem = refused({"environment.payload_force": signal(epoch, np.arange(7))})
    first = re.search(r"subtract the first time, (\S+) s", problem.fix)
    assert first, problem.fix
    assert problem.value.split()[0] != problem.value.split()[-1]
    changes: dict[str, Any] = {"environment.payload_force": signal(epoch - float(first[1]), np.arange(7))}
    if shorter := re.search(r"duration to (\S+) s", problem.fix):
        changes["duration"] = float(shorter[1])
    assert (shorter is not None) == (reach < 50.0)
    assert umbilical.load("paper", changes)


def test_the_overshoot_is_that_of_a_fine_look() -> None:
    rng = np.random.default_rng(5)
    for _ in range(20):
        points = np.sort(rng.uniform(0.0, 10.0, 9))
        values = rng.uniform(-1.0, 1.0, 9)
        fine = spline(tuple(points), tuple(values))(np.linspace(points[0], points[-1], 200_001))
        share = max(fine.max() - values.max(), values.min() - fine.min(), 0.0) / np.ptp(values)
        assert overshoot(points.tolist(), values.tolist(), (0.0, 10.0)).share == pytest.approx(
            share, rel=1e-6, abs=1e-12
        )


def test_only_the_run_counts() -> None:
    points, values = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.01], [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.4]
    assert overshoot(points, values, (0.0, 1.0)).share < 0.2 * overshoot(points, values, (0.0, 5.0)).share


RECORD = np.arange(0.0, 51.0)
SWELL = 0.5 * np.sin(0.6 * RECORD)
LATE = np.insert(RECORD, 11, 10.001), np.insert(SWELL, 11, SWELL[10] + 0.02)  # one sample 1 ms late and 2 cm off
CALM = {"environment.vessel_ramp": 3.0}


@pytest.mark.parametrize("place", PLACES)
def test_a_record_with_jitter_is_refused_and_its_fixes_hold(place: str) -> None:
    assert umbilical.load("paper", CALM | {place: signal(RECORD, SWELL)})
    problem = refused(CALM | {place: signal(*LATE)})
    assert problem.key == f"{place}.1.values"
    without = int(re.search(r"look at point (\d+)", problem.fix)[1]) - 1  # type: ignore[index]
    left = [np.delete(column, without) for column in LATE]
    assert umbilical.load("paper", CALM | {place: signal(*left)})
    assert 'interpolation = "linear"' in problem.fix
    assert umbilical.load("paper", CALM | {place: signal(*LATE, interpolation="linear")})


def test_loads_winch_and_shape_with_jitter_are_refused() -> None:
    load = [{"profile": {"shape": "uniform"}, "signal": signal(*LATE)}]
    assert refused({"environment.cable_load": load}).key == "environment.cable_load.1.signal.1.values"
    assert refused({"winch": length(LATE[0], 450.0 + LATE[1])}).key == "winch.lengths"
    found = refused({"initial": shape(LATE[0] / 50.0, LATE[1])})
    assert found.key == "initial.displacements"
    assert "x/l = " in found.value


def test_a_small_overshoot_is_told_and_a_smaller_one_is_not() -> None:
    """A sine of n samples a period that misses its peaks leaves them by (1 - cos(pi/n))/(2 cos(pi/n)) of the range."""
    for samples, told in ((8, True), (16, False)):
        times = np.arange(0.0, 51.0)
        values = np.sin(2.0 * np.pi * (times + 0.5) / samples)
        found = overshoot(times.tolist(), values.tolist(), (0.0, 50.0)).share
        expected = (1.0 - np.cos(np.pi / samples)) / (2.0 * np.cos(np.pi / samples))
        assert found == pytest.approx(expected, rel=0.2)
        assert found < MOST_OVERSHOOT
        notices = admit(umbilical.load("paper", {"environment.payload_force": signal(times, values)}))
        assert bool(notices) is told, samples
