"""Random admissible runs: the power balance closes, and nothing that is not a number passes for a result."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import umbilical
from tests.support.random_scenarios import between, failing, few, moving_winches, waves, winches
from tests.support.scenarios import open_loop, run
from umbilical import Status
from umbilical.errors import ScenarioError


@few
@given(
    winch=winches,
    force=waves,
    load=waves,
    vessel=waves,
    damping=between(0.0, 0.2),
    mass=between(50.0, 1000.0),
)
def test_power_balance_closes(
    winch: dict[str, Any],
    force: dict[str, Any],
    load: dict[str, Any],
    vessel: dict[str, Any],
    damping: float,
    mass: float,
) -> None:
    result = run(
        open_loop(
            winch=winch,
            duration=5.0,
            grid__elements=16,
            payload__mass=mass,
            cable__damping=damping,
            environment__payload_force=[force | {"amplitude": 100.0 * force["amplitude"]}],
            environment__cable_load=[{"profile": {"shape": "sine", "half_waves": 2}, "signal": [load]}],
            environment__vessel_motion=[vessel | {"amplitude": 0.3 * vessel["amplitude"]}],
            environment__vessel_ramp=2.0,
        )
    )
    assert result.metrics["energy_balance_residual"] < 1e-4


@few
@given(
    preset=st.sampled_from(["paper", "paper-adaptive", "crosscheck-pd"]),
    winch=moving_winches,
    faults=failing,
    force=waves,
    vessel=waves,
)
def test_power_balance_closes_in_the_loop(
    preset: str, winch: dict[str, Any], faults: list[dict[str, Any]], force: dict[str, Any], vessel: dict[str, Any]
) -> None:
    """Motors at work, some failing, the winch starting and stopping: the thrust does what is booked for it."""
    motors = {} if preset == "crosscheck-pd" else {"faults": faults}
    changes = {
        "winch": winch,
        "duration": 5.0,
        "grid.elements": 32,
        "environment.payload_force": [force | {"amplitude": 100.0 * force["amplitude"]}],
        "environment.vessel_motion": [vessel | {"amplitude": 0.3 * vessel["amplitude"]}],
        "environment.vessel_ramp": 2.0,
    }
    result = run(umbilical.load(preset, changes | motors))
    assert result.metrics["energy_balance_residual"] < 1e-4


@few
@given(
    preset=st.sampled_from(["paper", "paper-adaptive", "paper-stuck-adaptive", "haul-in", "crosscheck-pd"]),
    slope_gain=between(0.0, 80.0),
    damping_gain=between(1e2, 9e4),
    force=between(-1e5, 1e5),
    noise=between(0.0, 1e-2),
    dropout=between(0.0, 0.9),
)
def test_completed_means_finite(
    preset: str, slope_gain: float, damping_gain: float, force: float, noise: float, dropout: float
) -> None:
    law = (
        {}
        if preset == "crosscheck-pd"
        else {"control.law.slope_gain": slope_gain, "control.law.damping_gain": damping_gain}
    )
    sensor = {"sensors.tip_slope.noise": noise, "sensors.tip_displacement.dropout": dropout}
    changes = {"grid.elements": 8, "duration": 2.0, "environment.payload_force": [{"kind": "constant", "value": force}]}
    try:
        scenario = umbilical.load(preset, law | sensor | changes)
    except ScenarioError:
        return  # refused before the first step: nothing passes for a result
    result = umbilical.simulate(scenario)
    assert result.status in (Status.COMPLETED, Status.DIVERGED)
    finite = all(np.isfinite(result[str(name)].values).all() for name in result.data.data_vars)
    assert finite or result.status is Status.DIVERGED
    if result.status is Status.COMPLETED:
        assert result.metrics["slope_peak"] <= 1.0
    else:
        assert result.reason
        assert result["time"].values[-1] <= result.end_time < 2.0 + 1e-9
