"""Drag of the ROV, ``D_l (u - V) + D_q |u - V| (u - V)``, V = Dy/Dt(l): it moves with the material, not the water."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import glue
from umbilical.plant.forces.force import Decay, Force, fastest_current
from umbilical.relations.water import in_water, payload_inertia
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.scenario import Scenario


class BodyDrag(NamedTuple):
    """D_l, N s/m, and D_q, N s2/m2."""

    linear: float
    quadratic: float


def make(scenario: Scenario) -> BodyDrag:
    """Coefficients of a scenario's ROV."""
    found = in_water(scenario.cable, scenario.payload, scenario.environment)
    return BodyDrag(found.body_linear, found.body_quadratic)


@glue
def force(drag: BodyDrag, relative: float) -> float:
    """Force, N, of water that passes at ``relative = u - V``, m/s."""
    return (drag.linear + drag.quadratic * abs(relative)) * relative


def damping(scenario: Scenario, water: np.ndarray) -> float:
    """``D_l + 2 D_q |u|``, N s/m."""
    drag = make(scenario)
    return drag.linear + 2.0 * drag.quadratic * abs(float(water[-1]))


def decay(cable: Cable, payload: Payload, environment: Environment) -> Decay:
    """At the fastest current, and a metre per second of the ROV besides."""
    found = in_water(cable, payload, environment)
    most = found.body_linear + 2.0 * found.body_quadratic * (fastest_current(environment) + 1.0)
    return Decay("payload.water", most, "N s/m", payload_inertia(payload))


FORCE = Force("work_body_drag", "payload", damping, decay)
