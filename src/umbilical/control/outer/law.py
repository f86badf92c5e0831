"""What every outer law is told of the ROV: what the controller believes, never the truth."""

from __future__ import annotations

from typing import NamedTuple

from umbilical.compile import kernel
from umbilical.control.contract import WinchReadings
from umbilical.relations.tension import Hanging, hanging, net_gravity, tension
from umbilical.relations.water import in_water
from umbilical.scenario.scenario import Scenario


class Believed(NamedTuple):
    """The ROV as the controller knows it: m + A_h, kg, linear (N s/m) and quadratic drag (N s2/m2), and its weight."""

    payload_mass: float
    payload_damping: float
    quadratic_drag: float
    gravity: float
    hanging: Hanging


def believe(scenario: Scenario, across: bool = False) -> Believed:
    """The nominal constants of a scenario; ``across``: those of the horizontal direction y of a rope."""
    nominal, payload, water = scenario.control.nominal, scenario.payload, in_water(None, scenario.payload, None)
    mass = _first(nominal.payload_mass, payload.mass)
    gravity = _first(nominal.gravity, scenario.environment.gravity)
    weight = nominal.payload_wet_weight or payload.wet_weight
    return Believed(
        mass + (water.body_across if across else water.body_added),
        _first(nominal.payload_damping, payload.damping) + water.body_linear,
        water.body_quadratic_across if across else water.body_quadratic,
        gravity,
        hanging(mass, 0.0, gravity, weight, added=water.body_vertical),
    )


def _first(nominal: float | None, truth: float) -> float:
    return truth if nominal is None else nominal


@kernel
def pull_of_the_cable(believed: Believed, winch: WinchReadings) -> float:
    """T at the ROV, N: of a load pin where there is one, else of the weight."""
    if winch.tip_tension != 0.0:
        return winch.tip_tension
    return tension(0.0, net_gravity(believed.gravity, winch.payout_acceleration), believed.hanging)
