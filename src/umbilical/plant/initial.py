"""The shape of the cable at the start."""

from __future__ import annotations

from functools import cache

import numpy as np

from umbilical.plant.elements import DEGREE, interpolation_row
from umbilical.plant.equilibrium import equilibrium
from umbilical.plant.signals import spline
from umbilical.plant.top import top_at
from umbilical.relations.tension import hanging_of, tension
from umbilical.scenario.environment import EquilibriumShape, GaussianShape, SineShape, StaticShape, TableShape
from umbilical.scenario.scenario import Scenario

_POINTS, _POINT_WEIGHTS = np.polynomial.legendre.leggauss(12)


def initial_slopes(scenario: Scenario) -> np.ndarray:
    """Slopes Y_sigma of the shape at t = 0 at the nodes, m, shape (5, n).

    In each element the polynomial nearest to the shape's slope in the mean square, so that the displacement
    at the interfaces is exact.
    """
    elements = scenario.grid.elements
    sigma = (np.arange(elements) + (_POINTS[:, None] + 1.0) / 2.0) / elements
    return _projection() @ slope_of_shape(scenario, sigma)


@cache
def _projection() -> np.ndarray:
    """From a function at the points of a fine quadrature to its projection on the element's nodes, shape (5, 12)."""
    at_points = np.array([interpolation_row(p) for p in _POINTS])
    exact_points, exact_weights = np.polynomial.legendre.leggauss(DEGREE + 1)
    basis = np.array([interpolation_row(p) for p in exact_points])
    mass = basis.T @ (exact_weights[:, None] * basis)
    return np.linalg.solve(mass, at_points.T * _POINT_WEIGHTS)


def slope_of_shape(scenario: Scenario, sigma: np.ndarray) -> np.ndarray:
    """d/dsigma of the initial shape at any positions x/l, m, same shape as ``sigma``."""
    motion = top_at(scenario.winch, 0.0, environment=scenario.environment)
    length = float(motion.length)
    above = length * (1.0 - sigma)
    shape = scenario.initial
    match shape:
        case SineShape():
            return shape.amplitude * shape.half_waves * np.pi * np.cos(shape.half_waves * np.pi * sigma)
        case GaussianShape():
            off = (above - shape.distance) / shape.width
            return 2.0 * length / shape.width * off * shape.amplitude * np.exp(-(off**2))
        case StaticShape():
            # Under a steady force P on the ROV, y_x = P/T everywhere.
            net = float(motion.net_gravity(scenario.environment.gravity))
            hung = hanging_of(scenario.cable, scenario.payload, scenario.environment)
            return length * shape.force / tension(above, net, hung)
        case EquilibriumShape(tip=tip):
            return length * equilibrium(scenario, 0.0, tip).slope_at(sigma)
        case TableShape():
            return np.asarray(spline(shape.positions, shape.displacements).derivative()(sigma))
        case _:
            return np.zeros_like(sigma)
