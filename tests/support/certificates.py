"""Scenarios whose certificates are known, and matrices of the proof written a second time."""

from __future__ import annotations

from typing import Any

import numpy as np

import umbilical
from umbilical import Scenario
from umbilical.certificate.setting import Loop

GAIN = "control.law.slope_gain"
FREE: dict[str, Any] = {"environment.payload_force": []}
HALF_SINE: dict[str, Any] = {"initial": {"shape": "sine", "amplitude": 1.0}}


def fixed(slope_gain: float, length: float = 500.0, **overrides: Any) -> Scenario:
    """The paper's cable at a fixed length, without loads."""
    return umbilical.load(
        "paper", FREE | {GAIN: slope_gain, "winch": {"law": "constant", "length": length}} | overrides
    )


def hauled_in(slope_gain: float, speed: float = 1.0, duration: float = 150.0, **overrides: Any) -> Scenario:
    """The paper's cable hauled in from 500 m at one speed, without loads."""
    winch = {"law": "speed", "start_length": 500.0, "speed": -speed}
    return umbilical.load("paper", FREE | {GAIN: slope_gain, "winch": winch, "duration": duration} | overrides)


def matrices(
    loop: Loop, cross: float, vessel: float, x: float, motion: tuple[float, float, float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """N and M of docs/certificates.md at one point, gam = 1; ``motion``: l, v, a, a'/(g - a)."""
    length, speed, acceleration, jerk = motion
    rho, c, below = loop.rho, loop.c, length - x
    weight = loop.m * loop.g if loop.weight is None else loop.weight
    line_weight = (rho if loop.wet is None else loop.wet) * loop.g
    pull = weight + line_weight * below - (loop.m + rho * below) * acceleration
    changing = (loop.m + rho * below) * (loop.g - acceleration)
    q = cross * x + vessel
    n = np.array([[rho, rho * q], [rho * q, pull]])
    side = 0.5 * (c * q - cross * rho * speed)
    far = 0.5 * cross * pull + 0.5 * q * (line_weight - rho * acceleration) + 0.5 * changing * jerk
    return n, np.array([[c + 0.5 * cross * rho, side], [side, far]])
