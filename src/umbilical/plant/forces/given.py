"""Thrust and external force on the ROV, ``alpha + d`` of eq. (8): they push over a step, and work by their impulse."""

from __future__ import annotations

import numpy as np

from umbilical.compile import glue
from umbilical.plant.forces.force import Force


@glue
def mean(weights: np.ndarray, end: float, start: float, before: float) -> float:
    """Mean force over a step, N, from its values at the end, at the start and one step before."""
    return weights[0] * end + weights[1] * start + weights[2] * before


THRUST = Force("work_thrust", "payload")
PAYLOAD_FORCE = Force("work_payload_force", "payload")
