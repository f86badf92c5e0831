"""Does the power balance close? Energy from slopes and velocities by a quadrature the scheme does not use.

The scheme integrates with the Gauss-Lobatto rule of its own nodes; here the polynomials of each element are
integrated with Gauss-Legendre points, exact for the products that occur.
"""

from __future__ import annotations

import numpy as np

from umbilical.plant.elements import DEGREE, interpolation_row
from umbilical.relations.tension import across, axial_drag_of, hanging_of, sinking, stretched, tension
from umbilical.relations.water import in_water, payload_inertia
from umbilical.scenario.scenario import Scenario

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(DEGREE + 1)
_TO_POINTS = np.array([interpolation_row(p) for p in _POINTS])


def energy(
    scenario: Scenario,
    slopes: np.ndarray,
    velocities: np.ndarray,
    *,
    tip_velocity: np.ndarray,
    length: np.ndarray,
    net_gravity: np.ndarray,
    sink_speed: np.ndarray,
    elastic_tension: np.ndarray,
    elastic_gradient: np.ndarray,
) -> np.ndarray:
    """Energy of cable and ROV at every sample, J, shape (samples,).

    ``1/2 int(rho W^2 + T p^2) dx + 1/2 m W_l^2`` with p = y_x and W = Dy/Dt. In water W is y_t + vb y_x, rho and m hold
    what moves along across, and T is Tt: the physical energy less ``mu (v - zeta')^2 p^2`` (docs/theory.md).

    Args:
        scenario: gives density, masses and gravity.
        slopes: Y_sigma = l y_x at the nodes of each element, m, shape (samples, 5, n).
        velocities: W likewise, m/s.
        tip_velocity: of the ROV, m/s, shape (samples,), as are the others.
        length: cable paid out, m.
        net_gravity: g less the acceleration at which the cable sinks, m/s2.
        sink_speed: speed at which it does, m/s.
        elastic_tension, elastic_gradient: what stretch adds to the tension at the ROV, N, and per metre, N/m.
    """
    elements = slopes.shape[2]
    sections = scenario.cable, scenario.payload, scenario.environment
    net, sinks, water = net_gravity[:, None, None], sink_speed[:, None, None], in_water(*sections)
    inertia = scenario.cable.line_density + water.added
    coupling = scenario.cable.line_density * water.added / inertia
    carried = sinking(hanging_of(*sections), axial_drag_of(*sections), sinks)
    hung = stretched(carried, elastic_tension[:, None, None], elastic_gradient[:, None, None])
    hung = across(hung, coupling, sinks)
    over = length[:, None, None]
    sigma = (np.arange(elements) + (_POINTS[:, None] + 1.0) / 2.0) / elements
    pull = tension((1.0 - sigma) * over, net, hung)
    density = inertia * (_TO_POINTS @ velocities) ** 2
    density += pull * (_TO_POINTS @ slopes / over) ** 2
    along = np.einsum("spe,p->s", density, _WEIGHTS) * length / (2.0 * elements)
    return 0.5 * (along + payload_inertia(scenario.payload) * tip_velocity**2)


def tension_at_ends(
    scenario: Scenario,
    *,
    length: np.ndarray,
    net_gravity: np.ndarray,
    sink_speed: np.ndarray,
    elastic_tension: np.ndarray,
    elastic_gradient: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Tension at the sheave and at the ROV at every sample, N; arguments as in :func:`energy`."""
    sections = scenario.cable, scenario.payload, scenario.environment
    carried = sinking(hanging_of(*sections), axial_drag_of(*sections), sink_speed)
    hung = stretched(carried, elastic_tension, elastic_gradient)
    return tension(length, net_gravity, hung), tension(0.0 * length, net_gravity, hung)


def balance_residual(energies: np.ndarray, works: np.ndarray) -> np.ndarray:
    """Energy less its start and all work done on it since, J, shape (samples,).

    Args:
        energies: J, shape (samples,).
        works: time integral of each power since the start, J, shape (samples, terms).
    """
    return energies - energies[0] - (works - works[0]).sum(axis=1)


def scale_of(energies: np.ndarray, works: np.ndarray) -> float:
    """The larger of the largest energy and the gross work, the integral of |power|, J.

    The gross work is summed between samples, so it is if anything too small and what is measured by it too large.
    """
    return max(float(energies.max()), float(np.abs(np.diff(works.sum(axis=1))).sum()))


def relative_residual(energies: np.ndarray, works: np.ndarray) -> float:
    """Largest residual over :func:`scale_of`; 0 for a cable that never moves."""
    scale = scale_of(energies, works)
    return float(np.abs(balance_residual(energies, works)).max() / scale) if scale > 0.0 else 0.0
