"""Where the cable comes to rest under what acts at an instant, with the winch stopped: quadratures over its length.

    T y_x = F + integral of f from x to l,    F on the ROV: its drag, the force on it, and what thrusters hold

The drag is that of the current past a cable at rest; small angles, as everywhere.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.plant.current import speeds_at
from umbilical.plant.exogenous import current_at, profile
from umbilical.plant.forces.body_drag import force as body_force
from umbilical.plant.forces.body_drag import make as make_body_drag
from umbilical.plant.forces.drag import make as make_drag
from umbilical.plant.signals import evaluate
from umbilical.plant.top import top_at, vessel_at
from umbilical.relations.tension import hanging_of, net_gravity, tension
from umbilical.scenario.scenario import Scenario

_PIECES = 4000


class Equilibrium(NamedTuple):
    """A cable at rest.

    Attributes:
        sigma: x/l, shape (points,).
        slope: y_x there.
        displacement: y there, m.
        water: speed of the water there, m/s.
        thrust: force on the ROV that holds it, N; 0 where it is free.
        length: of the cable, m.
    """

    sigma: np.ndarray
    slope: np.ndarray
    displacement: np.ndarray
    water: np.ndarray
    thrust: float
    length: float

    def slope_at(self, sigma: np.ndarray) -> np.ndarray:
        """y_x at any positions, same shape."""
        return np.interp(sigma, self.sigma, self.slope)


def equilibrium(scenario: Scenario, time: float = 0.0, tip: float | None = None) -> Equilibrium:
    """The cable at rest under the loads and the current of an instant, s, at the length it has then.

    Args:
        scenario: what is simulated; motors and controller are left out.
        time: s.
        tip: displacement at which something holds the ROV, m; None where it is free.
    """
    environment, winch = scenario.environment, top_at(scenario.winch, time)
    length, sigma = float(winch.length), np.linspace(0.0, 1.0, _PIECES + 1)
    hung = hanging_of(scenario.cable, scenario.payload, environment)
    pull = tension(length * (1.0 - sigma), net_gravity(environment.gravity), hung)
    water = speeds_at(environment, length * sigma) * current_at(environment, np.array(time))[0]
    below = length * from_below(load_at_rest(scenario, time, sigma, water), sigma)
    force = float(evaluate(environment.payload_force, time)) + body_force(make_body_drag(scenario), float(water[-1]))
    vessel = float(vessel_at(environment, time)[0])
    reached = vessel + length * float(np.trapezoid((force + below) / pull, sigma))
    thrust = 0.0 if tip is None else (tip - reached) / (length * float(np.trapezoid(1.0 / pull, sigma)))
    slope = (force + thrust + below) / pull
    displacement = vessel + length * (from_below(slope, sigma)[0] - from_below(slope, sigma))
    return Equilibrium(sigma, slope, displacement, water, thrust, length)


def load_at_rest(scenario: Scenario, time: float, sigma: np.ndarray, water: np.ndarray) -> np.ndarray:
    """Load on a metre of cable at rest, N/m, shape of ``sigma``: drag of the ``water`` that passes, and given loads."""
    found = make_drag(scenario).normal * np.abs(water) * water
    for load in scenario.environment.cable_load:
        found = found + float(evaluate(load.signal, time)) * profile(load.profile, sigma)
    return found


def from_below(values: np.ndarray, sigma: np.ndarray) -> np.ndarray:
    """Integral over sigma, the last axis, from each position to 1, by trapezoids, same shape."""
    pieces = 0.5 * (values[..., 1:] + values[..., :-1]) * np.diff(sigma)
    sums = np.cumsum(pieces[..., ::-1], axis=-1)[..., ::-1]
    return np.concatenate([sums, np.zeros((*values.shape[:-1], 1))], axis=-1)
