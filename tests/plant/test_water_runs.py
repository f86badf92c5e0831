"""Runs in water: the balance closes with every term at work, no water is no change, and a law holds its station."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from tests.plant.test_water import SEA
from umbilical.verify.ours import open_loop, sine

MOVED: dict[str, Any] = {
    **SEA,
    "environment.water.current.variation": [sine(0.2, 0.7)],
    "environment.vessel_heave": [sine(0.5, 0.8)], "environment.vessel_motion": [sine(0.5, 0.6)],
    "environment.vessel_ramp": 3.0, "cable.damping": 0.05, "payload.damping": 10.0,
    "winch": {"law": "quintic", "start_length": 100.0, "end_length": 108.0, "duration": 10.0},
    "initial": {"shape": "equilibrium"},
}  # fmt: skip


def test_the_balance_closes_and_every_term_is_needed() -> None:
    run = umbilical.simulate(open_loop(duration=10.0, grid__elements=8, output__interval=0.01).replace(MOVED))
    closed = run.metrics["energy_balance_residual"]
    assert closed < 1e-6
    energy = run["energy"].values
    works = {str(name): run[str(name)].values for name in run.data if str(name).startswith("work_")}
    total = np.sum(list(works.values()), axis=0)
    scale = max(energy.max(), np.abs(np.diff(total)).sum())
    for name in ("work_drag", "work_body_drag", "work_current", "work_added_mass", "work_tension", "work_vessel"):
        opened = np.abs(energy - energy[0] - (total - works[name] + works[name][0])).max() / scale
        assert opened > 100.0 * closed, name


def test_water_that_does_nothing_changes_no_bit() -> None:
    dry = open_loop(duration=2.0, grid__elements=8, output__interval=0.01)
    nothing = {"diameter": 0.001, "normal_drag": 0.0, "tangential_drag": 0.0, "added_mass": 0.0}
    wet = dry.replace({
        "environment.water": {}, "cable.water": nothing, "payload.water": {},
        "cable.wet_line_density": dry.cable.line_density,
        "payload.wet_weight": dry.payload.mass * dry.environment.gravity,
    })  # fmt: skip
    before, after = umbilical.simulate(dry), umbilical.simulate(wet)
    for name in before.data.data_vars:
        if not str(name).startswith("metric_"):
            assert np.array_equal(before[str(name)].values, after[str(name)].values), name


@pytest.mark.slow
@pytest.mark.parametrize(
    ("station", "place", "thrust"), [({}, 50.986, 0.0), ({"station_gain": 0.1, "washout_time": 120.0}, 0.0, -2685.0)]
)
def test_where_the_law_rests_in_a_current(station: dict[str, float], place: float, thrust: float) -> None:
    """q l/w - (q W/w^2) ln(1 + w l/W) off station with the paper's law; on it with a station."""
    law = {"kind": "boundary", "damping_gain": 1e4, "slope_gain": 5.0, "rates": "sensor", **station}
    uniform = {"current": {"depths": [0.0, 1000.0], "speeds": [0.5, 0.5]}}
    scenario = umbilical.load("paper", {
        **SEA, "environment.water": uniform, "payload.water": {}, "environment.payload_force": [], "control.law": law,
        "winch": {"law": "constant", "length": 1000.0}, "motors": [], "ideal_thruster": True,
        "sensors.ideal_velocity": True,
        "control.velocity_observer": None, "control.slope_observer": None, "control.motor_loop": None,
        "control.disturbance_observer.gain": 1.0, "control.period": 5e-3, "grid.step": 5e-3, "grid.elements": 16,
        "duration": 1500.0, "output.interval": 1.0,
    })  # fmt: skip
    run = umbilical.simulate(scenario)
    assert run["tip_displacement"].values[-1] == pytest.approx(place, rel=0.01, abs=1e-3)
    assert run["thrust"].values[-1] == pytest.approx(thrust, rel=0.01, abs=10.0)
