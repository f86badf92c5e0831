"""Test vectors: samples of the sensors, and what the built-in controller decides on them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from umbilical.control.cascade import Cascade
from umbilical.control.contract import Measurement
from umbilical.frames import Frame
from umbilical.scenario.scenario import Scenario

UPDATES = 200
_SPANS = {
    "tip_displacement": 0.5, "tip_slope": 0.02, "tip_velocity": 0.3, "tip_slope_rate": 0.02,
    "payout_acceleration": 0.1, "motor_speed": 30.0, "motor_current": 40.0,
}  # fmt: skip
"""Largest size of each reading: what a run of the presets reaches, so that limits and both signs are met."""


class Vector(NamedTuple):
    """One update: what was read, and decision and kappa after it; records as in :mod:`umbilical.control.contract`."""

    measurement: Measurement
    outer: Frame
    motors: Frame
    kappa: np.ndarray


def vectors(scenario: Scenario) -> Iterator[Vector]:
    """The first updates of the built-in controller on made-up readings, the same on every machine."""
    controller, state = Cascade(scenario), None
    for k in range(UPDATES):
        measurement = _measurement(scenario, k)
        if state is None:
            state = controller.start(measurement)
        _, state = controller.update(k * controller.period, measurement, state)
        memory, decision, _ = state
        yield Vector(measurement, decision.outer.copy(), decision.motors.copy(), memory.kappa.copy())  # pyright: ignore[reportAttributeAccessIssue]


def _measurement(scenario: Scenario, k: int) -> Measurement:
    motors, ideal = len(scenario.motors), scenario.sensors.ideal_velocity
    size = {name: span * _triangle(k, 31 + 7 * i) for i, (name, span) in enumerate(_SPANS.items())}
    speeds = [_SPANS["motor_speed"] * _triangle(k, 23 + 4 * j) for j in range(motors)]
    currents = [_SPANS["motor_current"] * _triangle(k, 29 + 6 * j) for j in range(motors)]
    tip, rates = (size["tip_displacement"], size["tip_slope"]), (size["tip_velocity"], size["tip_slope_rate"])
    winch = (100.0, 0.0, size["payout_acceleration"])
    return Measurement(*tip, np.array(speeds), np.array(currents), *winch, *(rates if ideal else (None, None)))


def _triangle(k: int, period: int) -> float:
    """From 1/period up to 1, down to -1 and back, in whole numbers up to the last division."""
    phase = (4 * k + 1) % (4 * period)
    return (2 * period - abs(phase - 2 * period) - period) / period
