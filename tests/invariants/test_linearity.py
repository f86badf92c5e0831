"""The open loop is linear: the response to a sum is the sum of the responses, paying out and hauling in."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.scenarios import constant, open_loop, run, sine
from umbilical import Run

INPUTS: list[dict[str, Any]] = [
    {"payload_force": [constant(100.0)]},
    {"cable_load": [{"profile": {"shape": "gaussian", "center": 0.3, "width": 0.2}, "signal": [sine(3.0, 2.0)]}]},
    {"vessel_motion": [sine(0.5, 1.3)]},
]
FIELDS = ("displacement", "velocity", "tip_slope", "vessel_slope")


def response(lengths: tuple[float, float], start: float, inputs: list[dict[str, Any]]) -> Run:
    environment = {f"environment.{name}": value for part in inputs for name, value in part.items()}
    scenario = open_loop(
        winch={"law": "quintic", "start_length": lengths[0], "end_length": lengths[1], "duration": 5.0},
        initial={"shape": "sine", "amplitude": start, "half_waves": 1.5},
        duration=5.0,
        grid__elements=8,
        cable__damping=0.05,
        payload__damping=5.0,
        environment__vessel_ramp=2.0,  # in every part: forces are evaluated anew where it ends
    )
    return run(scenario.replace(environment))


@pytest.mark.parametrize("lengths", [(100.0, 110.0), (110.0, 100.0)], ids=["paying out", "hauling in"])
def test_superposition(lengths: tuple[float, float]) -> None:
    parts = [response(lengths, 0.7, []), *(response(lengths, 0.0, [part]) for part in INPUTS)]
    whole = response(lengths, 0.7, INPUTS)
    for name in FIELDS:
        total = np.sum([part[name].values for part in parts], axis=0)
        scale = np.abs(whole[name].values).max()
        assert np.abs(whole[name].values - total).max() < 1e-12 * scale, name


@pytest.mark.parametrize("factor", [-1.0, 2.0**20, 2.0**-30])
def test_scaling_by_a_power_of_two_is_exact(factor: float) -> None:
    """2^20 would be steeper than the model allows, so the larger of the two starts small."""
    start = 1e-3 * min(1.0, 1.0 / abs(factor))
    one, scaled = response((110.0, 100.0), start, []), response((110.0, 100.0), factor * start, [])
    for name in FIELDS:
        np.testing.assert_array_equal(scaled[name].values, factor * one[name].values)
