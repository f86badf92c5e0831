"""Linear damping of the ROV, ``-c_tip Dy/Dt``, eq. (8)."""

from __future__ import annotations

import numpy as np

from umbilical.compile import glue
from umbilical.plant.forces.force import Decay, Force
from umbilical.relations.water import payload_inertia
from umbilical.scenario.hardware import Payload
from umbilical.scenario.scenario import Scenario


@glue
def force(coefficient: float, velocity: float) -> float:
    """Force on the ROV, N."""
    return -(coefficient * velocity)


@glue
def power(coefficient: float, velocity: float) -> float:
    """``-c_tip V^2``, W."""
    return -coefficient * velocity * velocity


def damping(scenario: Scenario, water: np.ndarray) -> float:
    """c_tip, N s/m, wherever it is."""
    return scenario.payload.damping


def decay(payload: Payload, **_: object) -> Decay:
    """c_tip over the mass that moves with the ROV."""
    return Decay("payload.damping", payload.damping, "N s/m", payload_inertia(payload))


FORCE = Force("work_payload_damping", "payload", damping, decay)
