"""The shape of the cable at the start."""

from __future__ import annotations

import numpy as np

from umbilical.plant import winch
from umbilical.plant.layout import positions
from umbilical.plant.signals import spline, vessel
from umbilical.scenario.environment import GaussianShape, SineShape, StaticShape, TableShape
from umbilical.scenario.scenario import Scenario


def initial_displacement(scenario: Scenario) -> np.ndarray:
    """Displacement of every node at t = 0, m, shape (4 n + 1,); the vessel end takes e(0)."""
    sigma = positions(scenario.grid.elements)
    motion = winch.evaluate(scenario.winch, 0.0)
    length = float(motion.length)
    above = length * (1.0 - sigma)
    shape = scenario.initial
    match shape:
        case SineShape():
            nodes = shape.amplitude * np.sin(shape.half_waves * np.pi * sigma)
        case GaussianShape():
            nodes = shape.amplitude * np.exp(-(((above - shape.distance) / shape.width) ** 2))
        case StaticShape():
            net_gravity = scenario.environment.gravity - float(motion.acceleration)
            nodes = static_deflection(scenario, shape.force, above, length, net_gravity)
        case TableShape():
            nodes = np.asarray(spline(shape.positions, shape.displacements)(sigma))
        case _:
            nodes = np.zeros_like(sigma)
    nodes[0] = float(vessel(scenario.environment, 0.0)[0])
    return nodes


def static_deflection(
    scenario: Scenario, force: float, above: np.ndarray, length: float, net_gravity: float
) -> np.ndarray:
    """Deflection under a steady force P on the ROV: ``P/(rho g) ln((m + rho l)/(m + rho (l - x)))``, m.

    ``above`` is the distance from the ROV, m. With constant tension it is ``P x / T``.
    """
    mass, hanging = scenario.payload.mass, scenario.cable.hanging_density
    if hanging == 0.0:
        return force * (length - above) / (mass * net_gravity)
    # log1p keeps its digits when the cable is light against the ROV.
    return force / (hanging * net_gravity) * np.log1p(hanging * (length - above) / (mass + hanging * above))
