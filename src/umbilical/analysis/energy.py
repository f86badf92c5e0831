"""Does the power balance close? Energy from the stored fields by a quadrature the scheme does not use.

The scheme integrates with the Gauss-Lobatto rule of its own nodes; here the element's polynomials are
integrated with Gauss-Legendre points, exact for the products that occur.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from umbilical.plant.elements import DEGREE, DERIVATIVE, interpolation_row
from umbilical.relations.formulas import tension
from umbilical.scenario.scenario import Scenario

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(DEGREE + 2)
_TO_POINTS = np.array([interpolation_row(p) for p in _POINTS])


def _at_points(nodal: np.ndarray) -> np.ndarray:
    """Values of nodal fields (samples, 4 n + 1) at the quadrature points, (samples, n, points)."""
    elements = (nodal.shape[1] - 1) // DEGREE
    index = DEGREE * np.arange(elements)[:, None] + np.arange(DEGREE + 1)
    return nodal[:, index] @ _TO_POINTS.T


def _slopes_at_points(nodal: np.ndarray, length: np.ndarray) -> np.ndarray:
    """y_x of nodal fields at the quadrature points, (samples, n, points)."""
    elements = (nodal.shape[1] - 1) // DEGREE
    index = DEGREE * np.arange(elements)[:, None] + np.arange(DEGREE + 1)
    return nodal[:, index] @ (_TO_POINTS @ DERIVATIVE).T * (2.0 * elements / length)[:, None, None]


def energy(scenario: Scenario, channels: Mapping[str, np.ndarray]) -> np.ndarray:
    """Energy of cable and ROV at every stored sample, J, shape (samples,).

    ``1/2 int(rho W^2 + T p^2) dx + 1/2 m W_l^2`` with p = y_x and W = Dy/Dt.

    Args:
        scenario: gives density, masses and gravity.
        channels: ``displacement`` and ``velocity`` (samples, nodes), ``length`` and
            ``payout_acceleration`` (samples,).
    """
    length = np.asarray(channels["length"])
    velocity = np.asarray(channels["velocity"])
    elements = (velocity.shape[1] - 1) // DEGREE
    net = scenario.environment.gravity - np.asarray(channels["payout_acceleration"])
    sigma = (np.arange(elements)[:, None] + (_POINTS + 1.0) / 2.0) / elements
    pull = tension(
        (1.0 - sigma) * length[:, None, None], net[:, None, None], scenario.payload.mass, scenario.cable.hanging_density
    )
    density = scenario.cable.line_density * _at_points(velocity) ** 2
    density += pull * _slopes_at_points(np.asarray(channels["displacement"]), length) ** 2
    along = np.einsum("sep,p->s", density, _WEIGHTS) * length / (2.0 * elements)
    return 0.5 * (along + scenario.payload.mass * velocity[:, -1] ** 2)


def residual(energies: np.ndarray, works: np.ndarray) -> np.ndarray:
    """Energy less its start and all work done on it since, J, shape (samples,).

    Args:
        energies: J, shape (samples,).
        works: time integral of each power since the start, J, shape (samples, terms).
    """
    return energies - energies[0] - (works - works[0]).sum(axis=1)


def relative_residual(energies: np.ndarray, works: np.ndarray) -> float:
    """Largest residual over the larger of the largest energy and the gross work, the integral of |power|.

    The gross work is summed between samples, so it is if anything too small and the result too large.
    0 for a cable that never moves.
    """
    gross = np.abs(np.diff(works.sum(axis=1))).sum()
    scale = max(float(energies.max()), float(gross))
    return float(np.abs(residual(energies, works)).max() / scale) if scale > 0.0 else 0.0
