"""Random open loops, paying out and hauling in: linear, symmetric, and the same at any other time."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.random_scenarios import between, cables, few, inputs, steady, winches
from tests.support.scenarios import open_loop, run
from umbilical import Run

ROUND_OFF = 1e-9


def response(winch: dict[str, Any], cable: dict[str, Any], sideways: dict[str, Any]) -> Run:
    """Three seconds on eight elements."""
    scenario = open_loop(winch=winch, duration=3.0, grid__elements=8, output__interval=0.1)
    return run(scenario.replace(cable | sideways))


def scaled(sideways: dict[str, Any], factor: float) -> dict[str, Any]:
    """Everything that moves the cable, ``factor`` times as much."""

    def larger(terms: list[dict[str, Any]]) -> list[dict[str, Any]]:
        return [term | {"amplitude": factor * term["amplitude"]} for term in terms]

    load = sideways["environment.cable_load"][0]
    return sideways | {
        "environment.payload_force": larger(sideways["environment.payload_force"]),
        "environment.cable_load": [load | {"signal": larger(load["signal"])}],
        "environment.vessel_motion": larger(sideways["environment.vessel_motion"]),
        "initial": sideways["initial"] | {"amplitude": factor * sideways["initial"]["amplitude"]},
    }


def joined(one: dict[str, Any], other: dict[str, Any]) -> dict[str, Any]:
    """The sum of two sets of inputs."""
    lists = ("environment.payload_force", "environment.cable_load", "environment.vessel_motion")
    shape = one["initial"] | {"amplitude": one["initial"]["amplitude"] + other["initial"]["amplitude"]}
    return one | {name: [*one[name], *other[name]] for name in lists} | {"initial": shape}


def close(found: Run, wanted: np.ndarray, scale: float) -> bool:
    return bool(np.abs(found["displacement"].values - wanted).max() <= ROUND_OFF * max(scale, 1e-12))


@few
@given(winches, cables, inputs)
def test_the_mirror_image(winch: dict[str, Any], cable: dict[str, Any], sideways: dict[str, Any]) -> None:
    right, left = response(winch, cable, sideways), response(winch, cable, scaled(sideways, -1.0))
    np.testing.assert_array_equal(left["displacement"].values, -right["displacement"].values)
    np.testing.assert_array_equal(left["energy"].values, right["energy"].values)


@few
@given(winches, cables, inputs, inputs, between(-2.0, 2.0))
def test_linearity(
    winch: dict[str, Any], cable: dict[str, Any], one: dict[str, Any], other: dict[str, Any], factor: float
) -> None:
    parts = [response(winch, cable, part)["displacement"].values for part in (one, other)]
    whole = response(winch, cable, joined(one, scaled(other, factor)))
    size = max(float(np.abs(part).max()) for part in parts)
    assert close(whole, parts[0] + factor * parts[1], size)


@settings(few, max_examples=8)
@given(steady, cables, between(0.1, 1.5), st.integers(1, 1200))
def test_shift_in_time(winch: dict[str, Any], cable: dict[str, Any], width: float, later: int) -> None:
    """The winch starts where it will be, and everything else later: the same response."""
    shift = later * 1e-3

    def pushed(begin: float, length: float) -> Run:
        pulse = {"kind": "pulse", "value": 100.0, "start": begin, "end": begin + width}
        scenario = open_loop(
            winch=winch | {"start_length": length}, duration=3.0, grid__elements=8, output__interval=1e-3,
            environment__payload_force=[pulse],
        )  # fmt: skip
        return run(scenario.replace(cable))

    early = pushed(0.1, winch["start_length"] + winch["speed"] * shift)["tip_displacement"].values
    late = pushed(0.1 + shift, winch["start_length"])["tip_displacement"].values
    assert np.abs(late[later:] - early[: late.size - later]).max() <= ROUND_OFF * np.abs(early).max()
