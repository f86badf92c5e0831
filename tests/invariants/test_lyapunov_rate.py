"""The exact rate of V1 + V2 and of V3, docs/certificates.md, holds along runs: every term of it is needed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

import umbilical
from tests.support.certificates import GAIN
from tests.support.scenarios import run, sine
from umbilical.certificate import Weights
from umbilical.certificate.lyapunov import (
    boundary_function,
    boundary_function_rates,
    cable_function,
    cable_function_rates,
)
from umbilical.studies.audit import _READ, ideal_loop

TOLERANCE = 2e-4
"""Distance over the largest V."""
NEEDED = 5.0
"""Without a term it is this many times as large, at least."""
WEIGHTS = Weights(cross=0.06, vessel=4.0, boundary=0.06)
WAYS = [(300.0, 390.0), (390.0, 300.0)]
MOVED: dict[str, Any] = {
    "duration": 30.0,
    "output.interval": 0.01,
    "cable.damping": 0.05,
    "environment.vessel_motion": [sine(0.5, 0.6)],
    "environment.vessel_ramp": 5.0,
    "environment.payload_force": [sine(50.0, 0.5)],
    "environment.cable_load": [{"profile": {"shape": "sine", "half_waves": 2}, "signal": [sine(0.5, 0.8)]}],
    "initial": {"shape": "gaussian", "amplitude": 1.0, "distance": 150.0, "width": 30.0},
}


def moved(way: tuple[float, float], **changes: Any) -> umbilical.Run:
    """No controller; loads, damping and a vessel that moves; the winch with jerk."""
    winch = {"law": "quintic", "start_length": way[0], "end_length": way[1], "duration": 30.0}
    return run(umbilical.load("crosscheck-none", MOVED | {"winch": winch} | changes))


def arrays(result: umbilical.Run) -> dict[str, np.ndarray]:
    return {name: result[name].values for name in _READ}


def distance(value: np.ndarray, rates: dict[str, np.ndarray], time: np.ndarray) -> float:
    """Largest |V - V(0) - integral of its rate| over the largest V."""
    gained = cumulative_simpson(np.sum(list(rates.values()), axis=0), x=time, initial=0.0)
    return float(np.abs(value - value[0] - gained).max() / np.abs(value).max())


@pytest.mark.parametrize("way", WAYS, ids=["paying out", "hauling in"])
def test_rate_of_the_cable(way: tuple[float, float]) -> None:
    result = moved(way)
    read = arrays(result)
    value, rates = cable_function(result.scenario, read, WEIGHTS), cable_function_rates(result.scenario, read, WEIGHTS)
    assert distance(value, rates, read["time"]) < TOLERANCE
    for name in rates:
        without = {other: term for other, term in rates.items() if other != name}
        assert distance(value, without, read["time"]) > NEEDED * TOLERANCE, name


def test_rate_with_a_cable_lighter_in_water() -> None:
    """The slope of the tension takes the wet density, and only it."""
    result = moved(WAYS[0], **{"cable.wet_line_density": 0.5})
    read = arrays(result)
    value, rates = cable_function(result.scenario, read, WEIGHTS), cable_function_rates(result.scenario, read, WEIGHTS)
    assert distance(value, rates, read["time"]) < TOLERANCE


@pytest.mark.parametrize("way", WAYS, ids=["paying out", "hauling in"])
def test_rate_of_the_law(way: tuple[float, float]) -> None:
    """V3 of the ideal loop; sampling at 0.1 ms leaves its first order."""
    winch = {"law": "quintic", "start_length": way[0], "end_length": way[1], "duration": 20.0}
    change = {
        GAIN: 5.0,
        "winch": winch,
        "duration": 3.0,
        "control.period": 1e-4,
        "grid.step": 1e-4,
        "grid.elements": 32,
    }
    scenario = ideal_loop(umbilical.load("paper", change)).replace({"output.interval": 1e-3})
    read = arrays(run(scenario))
    value, rates = boundary_function(scenario, read, WEIGHTS), boundary_function_rates(scenario, read, WEIGHTS)
    assert distance(value, rates, read["time"]) < 2e-3
    for name in ("disturbance estimate", "disturbance rate"):
        without = {other: term for other, term in rates.items() if other != name}
        assert distance(value, without, read["time"]) > 2e-2, name
