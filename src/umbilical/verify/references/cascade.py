"""The paper's whole closed loop in continuous time, in one integration by scipy: no sampling, no holding.

The cable is one piece: polynomials in sigma = x/l up to a degree, from Hamilton's principle on the moving domain. With
``y = sum_j q_j phi_j`` and ``phi_j`` the integral of a Legendre polynomial, only q_0 moves the ROV and the slope there
is the sum of all q over l. For smooth loads the error in space falls faster than any power of the degree. Controller
and motors are those of :mod:`umbilical.verify.references.paper`, which uses nothing of the engine either.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre

from umbilical.verify.references import integrated, paper

Array = np.ndarray


class Matrices(NamedTuple):
    """Integrals over sigma, with ``A = 1 - sigma``: of phi phi, phi A phi', A^2 phi' phi', phi' phi', A phi' phi'."""

    mass: Array
    transport: Array
    convection: Array
    stiffness: Array
    hanging: Array


class Histories(NamedTuple):
    """y(l,t), m, and speeds, rad/s, and voltages, V, of the motors, shape (2, t)."""

    tip: Array
    speeds: Array
    voltages: Array


def matrices(degree: int) -> Matrices:
    """All integrals for ``degree`` polynomials, exact by Gauss's rule."""
    points, weights = legendre.leggauss(degree + 4)
    slopes = legendre.legvander(points, degree - 1)
    # The integral of P_j from -1 is (P_(j+1) - P_(j-1))/(2 j + 1), in sigma half of it.
    integrals = [legendre.legint(row, lbnd=-1.0) for row in np.eye(degree)]
    shapes = np.array([0.5 * legendre.legval(points, row) for row in integrals]).T
    above = 0.5 * (1.0 - points)

    def product(left: Array, weight: Array, right: Array) -> Array:
        return left.T @ (0.5 * (weights * weight)[:, None] * right)

    stretched = (product(slopes, weight, slopes) for weight in (above**2, np.ones_like(points), above))
    return Matrices(product(shapes, np.ones_like(points), shapes), product(shapes, above, slopes), *stretched)


def _cable_rates(m: Matrices, t: float, q: Array, momentum: Array, force: float) -> tuple[Array, Array]:
    """q' and the rate of the momentum ``dL/dq' = (rho l M + m) q' + rho v B q``; ``force`` acts on the ROV, N."""
    length, v, a = paper.winch(t)
    inertia = paper.RHO * length * m.mass
    inertia[0, 0] += paper.MASS
    moved = m.transport @ q
    rate = np.linalg.solve(inertia, momentum - paper.RHO * v * moved)
    pull = (paper.GRAVITY - a) * ((paper.MASS / length) * (m.stiffness @ q) + paper.RHO * (m.hanging @ q))
    change = paper.RHO * v * (m.transport.T @ rate + v / length * (m.convection @ q)) - pull
    change -= paper.DAMPING * (length * (m.mass @ rate) + v * moved)
    change[0] += force - paper.TIP_DAMPING * rate[0]
    return rate, change


def solve(force: Callable[[float], float], times: Array, degree: int = 40) -> Histories:
    """From a straight cable at rest, under ``force`` on the ROV, N; both motors have the slow disturbance of motor 2.

    The fast one of motor 1 would send waves of 16 m along the cable, too short for one polynomial.

    Args:
        force: of time, smooth, 0 at the start.
        times: increasing instants from 0, s.
        degree: polynomials along the cable.

    Raises:
        CaseError: scipy gave up, or the state is not finite.
    """
    m = matrices(degree)

    def controlled(t: float, state: Array) -> tuple[Array, list[Array]]:
        q, (length, _, a) = state[:degree], paper.winch(t)
        return paper.controlled(q[0], q.sum() / length, paper.MASS * (paper.GRAVITY - a), state[2 * degree :])

    def rates(t: float, state: Array) -> Array:
        q, momentum, speed, current = np.split(state, [degree, 2 * degree, 2 * degree + 2, 2 * degree + 4])[:4]
        voltage, control_rates = controlled(t, state)
        bell = paper.motor_disturbances(t)[0][1] * np.ones(2)
        motors = paper.rates_of_motors(speed, current, voltage, (bell, 0.2 * bell))
        delivered = float(paper.THRUST @ (abs(speed) * speed))
        cable = _cable_rates(m, t, q, momentum, force(t) + delivered)
        return np.concatenate([*cable, *motors, *control_rates])

    found = integrated(rates, np.zeros(2 * degree + 17), times, method="DOP853", rtol=1e-8, atol=1e-11)
    voltages = np.array([controlled(t, state)[0] for t, state in zip(times, found.T, strict=True)]).T
    return Histories(found[0], found[2 * degree : 2 * degree + 2], voltages)
