"""The cable with the ROV at its end, on its moving domain: eqs. (6)-(8), discretised by Hamilton's principle.

On sigma = x/l(t) with the material velocity W = Dy/Dt as second unknown, and A = 1 - sigma::

    Y_t = W - (v A/l) Y_sigma
    W_t = -(v A/l) W_sigma + [ (T Y_sigma)_sigma / l^2 - c W + f ] / rho
    ROV (sigma = 1):     m W_t = -T Y_sigma/l - c_tip W + d + alpha
    vessel (sigma = 0):  Y = e,  W = e' + (v/l) Y_sigma

The Lagrangian of the cable is evaluated on the nodes of the elements (``elements.py``) with their own
quadrature, and its Euler-Lagrange equations are the scheme. Nothing is added to make it stable: transport
and its adjoint are exact transposes of each other, so a fixed cable conserves its energy to round-off and a
moving one keeps the adiabatic balance, hauling in as well as paying out.

Order: 4 in the element size for the moving cable (higher for a fixed one), 2 in the time step
(velocity Verlet, one evaluation of the forces per step). Both are measured in ``tests/convergence``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.plant.elements import DERIVATIVE, WEIGHTS
from umbilical.plant.layout import positions, to_field
from umbilical.relations.formulas import tension
from umbilical.scenario.scenario import Scenario

# Derivative on the reference element, entry by entry: constants that the compiler can fold.
D00, D01, D02, D03, D04 = (float(d) for d in DERIVATIVE[0])
D10, D11, D12, D13, D14 = (float(d) for d in DERIVATIVE[1])
D20, D21, D22, D23, D24 = (float(d) for d in DERIVATIVE[2])
D30, D31, D32, D33, D34 = (float(d) for d in DERIVATIVE[3])
D40, D41, D42, D43, D44 = (float(d) for d in DERIVATIVE[4])

# Its adjoint under the quadrature, G = W^-1 D^T W: what summation by parts puts on the test function.
_ADJOINT = DERIVATIVE.T * WEIGHTS[None, :] / WEIGHTS[:, None]
G00, G01, G02, G03, G04 = (float(d) for d in _ADJOINT[0])
G10, G11, G12, G13, G14 = (float(d) for d in _ADJOINT[1])
G20, G21, G22, G23, G24 = (float(d) for d in _ADJOINT[2])
G30, G31, G32, G33, G34 = (float(d) for d in _ADJOINT[3])
G40, G41, G42, G43, G44 = (float(d) for d in _ADJOINT[4])

END_WEIGHT = float(WEIGHTS[0])
W0, W1, W2 = (float(w) for w in WEIGHTS[:3])


# Places of the fields in the one array, shape (7, 5, n + 1), that is the state of the cable.
# The nodal ones (layout.py) leave the fifth row unused; slope, flux and scratch have five points per element.
DISPLACEMENT, VELOCITY, ACCELERATION, FRESH, SLOPE, FLUX, SCRATCH = range(7)
FIELDS = 7


class Cable(NamedTuple):
    """Constants of cable and ROV, SI units."""

    line_density: float
    hanging_density: float
    damping: float
    payload_mass: float
    payload_damping: float
    above: np.ndarray
    """A = 1 - sigma at the five points of each element, shape (5, n + 1): distance from the ROV over l."""
    profiles: np.ndarray
    """Profiles of the loads along the cable, shape (loads, 4, n + 1)."""


def make_cable(scenario: Scenario, profiles: np.ndarray) -> Cable:
    """Constants of a scenario's cable; ``profiles`` is (loads, 4 n + 1), ordered from vessel to ROV."""
    field = to_field(1.0 - positions(scenario.grid.elements))
    return Cable(
        line_density=scenario.cable.line_density,
        hanging_density=scenario.cable.hanging_density,
        damping=scenario.cable.damping,
        payload_mass=scenario.payload.mass,
        payload_damping=scenario.payload.damping,
        above=np.vstack([field, np.append(field[0, 1:], 0.0)]),
        profiles=to_field(profiles),
    )


def make_fields(displacement: np.ndarray) -> np.ndarray:
    """The cable at rest (Dy/Dt = 0) in a shape given at its nodes, shape (4 n + 1,), as a state (7, 5, n + 1)."""
    nodal = to_field(displacement)
    fields = np.zeros((FIELDS, 5, nodal.shape[1]))
    fields[DISPLACEMENT, :4] = nodal
    return fields


@kernel
def differentiate(field: np.ndarray, out: np.ndarray) -> None:
    """out[j, e]: derivative of ``field`` on the reference element at point j of element e."""
    n = field.shape[1] - 1
    f = field
    # One loop per point: the compiler vectorises each of them, and none when they are one.
    for e in range(n):
        out[0, e] = D00 * f[0, e] + D01 * f[1, e] + D02 * f[2, e] + D03 * f[3, e] + D04 * f[0, e + 1]
    for e in range(n):
        out[1, e] = D10 * f[0, e] + D11 * f[1, e] + D12 * f[2, e] + D13 * f[3, e] + D14 * f[0, e + 1]
    for e in range(n):
        out[2, e] = D20 * f[0, e] + D21 * f[1, e] + D22 * f[2, e] + D23 * f[3, e] + D24 * f[0, e + 1]
    for e in range(n):
        out[3, e] = D30 * f[0, e] + D31 * f[1, e] + D32 * f[2, e] + D33 * f[3, e] + D34 * f[0, e + 1]
    for e in range(n):
        out[4, e] = D40 * f[0, e] + D41 * f[1, e] + D42 * f[2, e] + D43 * f[3, e] + D44 * f[0, e + 1]


@kernel
def momentum_flux(cable: Cable, fields: np.ndarray, length: float, speed: float, net_gravity: float) -> None:
    """flux = rho v A W - T Y_sigma / l at every point: what moves momentum along sigma."""
    n = fields.shape[2] - 1
    w, g, flux, above = fields[VELOCITY], fields[SLOPE], fields[FLUX], cable.above
    transport = cable.line_density * speed
    strain = 2.0 * n / length
    foot = tension(0.0, net_gravity, cable.payload_mass, cable.hanging_density) * strain
    rise = tension(length, net_gravity, cable.payload_mass, cable.hanging_density) * strain - foot
    for j in range(4):
        for e in range(n):
            flux[j, e] = transport * above[j, e] * w[j, e] - (foot + rise * above[j, e]) * g[j, e]
    for e in range(n):
        flux[4, e] = transport * above[4, e] * w[0, e + 1] - (foot + rise * above[4, e]) * g[4, e]


@kernel
def flux_to_acceleration(cable: Cable, fields: np.ndarray, target: int, length: float, speed: float) -> None:
    """Adjoint derivative of the flux over the mass of each node, less transport of mass and damping."""
    n = fields.shape[2] - 1
    w, f, edge, out = fields[VELOCITY], fields[FLUX], fields[SCRATCH], fields[target]
    inside = 2.0 * n / (cable.line_density * length)
    loss = speed / length + cable.damping / cable.line_density
    for e in range(n):
        s = G10 * f[0, e] + G11 * f[1, e] + G12 * f[2, e] + G13 * f[3, e] + G14 * f[4, e]
        out[1, e] = inside * s - loss * w[1, e]
    for e in range(n):
        s = G20 * f[0, e] + G21 * f[1, e] + G22 * f[2, e] + G23 * f[3, e] + G24 * f[4, e]
        out[2, e] = inside * s - loss * w[2, e]
    for e in range(n):
        s = G30 * f[0, e] + G31 * f[1, e] + G32 * f[2, e] + G33 * f[3, e] + G34 * f[4, e]
        out[3, e] = inside * s - loss * w[3, e]
    for e in range(n):
        edge[0, e] = G00 * f[0, e] + G01 * f[1, e] + G02 * f[2, e] + G03 * f[3, e] + G04 * f[4, e]
    for e in range(n):
        edge[1, e] = G40 * f[0, e] + G41 * f[1, e] + G42 * f[2, e] + G43 * f[3, e] + G44 * f[4, e]
    # Two elements meet at these nodes, each with half of the mass.
    for e in range(1, n):
        out[0, e] = 0.5 * inside * (edge[0, e] + edge[1, e - 1]) - loss * w[0, e]
    tip_share = END_WEIGHT / (2.0 * n) * cable.line_density * length
    push = END_WEIGHT * edge[1, n - 1] - (tip_share * loss + cable.payload_damping) * w[0, n]
    out[0, n] = push / (tip_share + cable.payload_mass)
    out[0, 0] = 0.0


@kernel
def add_loads(cable: Cable, out: np.ndarray, length: float, loads: np.ndarray) -> None:
    """Add the loads along the cable, N/m per profile, to an acceleration, shape (5, n + 1)."""
    n = out.shape[1] - 1
    tip_share = END_WEIGHT / (2.0 * n) * cable.line_density * length
    for k in range(loads.size):
        amount = loads[k] / cable.line_density
        for row in range(4):
            for e in range(n):
                out[row, e] += amount * cable.profiles[k, row, e]
        out[0, n] += amount * cable.profiles[k, 0, n] * tip_share / (tip_share + cable.payload_mass)
    out[0, 0] = 0.0


@glue
def evaluate(
    cable: Cable,
    fields: np.ndarray,
    target: int,
    length: float,
    speed: float,
    net_gravity: float,
    vessel_velocity: float,
    loads: np.ndarray,
) -> None:
    """Slope, vessel-end velocity and acceleration (field ``target``) at the present displacement and velocity.

    The acceleration is W_t from everything but the thrust and the force on the ROV.
    """
    n = fields.shape[2] - 1
    differentiate(fields[DISPLACEMENT], fields[SLOPE])
    fields[VELOCITY, 0, 0] = vessel_velocity + speed / length * (2.0 * n * fields[SLOPE, 0, 0])
    momentum_flux(cable, fields, length, speed, net_gravity)
    flux_to_acceleration(cable, fields, target, length, speed)
    if loads.size > 0:
        add_loads(cable, fields[target], length, loads)


@kernel
def kick(cable: Cable, fields: np.ndarray, dt: float, length: float, tip_force: float) -> None:
    """W += dt * acceleration, with the force on the ROV's node."""
    n = fields.shape[2] - 1
    w, acceleration = fields[VELOCITY], fields[ACCELERATION]
    for row in range(4):
        for e in range(n + 1):
            w[row, e] += dt * acceleration[row, e]
    tip_mass = END_WEIGHT / (2.0 * n) * cable.line_density * length + cable.payload_mass
    w[0, n] += dt * tip_force / tip_mass


@glue
def drift(cable: Cable, fields: np.ndarray, dt: float, length: float, speed: float) -> None:
    """Y += dt (W - (v A/l) Y_sigma); the vessel's node is left to its boundary condition."""
    if speed == 0.0:
        drift_only(fields, dt)
    else:
        drift_and_transport(cable, fields, dt, dt * speed / length * 2.0 * (fields.shape[2] - 1))


@kernel
def drift_only(fields: np.ndarray, dt: float) -> None:
    """Y += dt W: the winch stands still."""
    y, w = fields[DISPLACEMENT], fields[VELOCITY]
    for row in range(4):
        for e in range(y.shape[1]):
            y[row, e] += dt * w[row, e]


@kernel
def drift_and_transport(cable: Cable, fields: np.ndarray, dt: float, shift: float) -> None:
    """Y += dt W - shift A (slope at the middle of the step), the slope of a shared node being that of both sides."""
    n = fields.shape[2] - 1
    y, w, above = fields[DISPLACEMENT], fields[VELOCITY], cable.above
    g, r = fields[SLOPE], fields[SCRATCH]
    differentiate(w, r)
    half = 0.5 * dt
    for j in range(1, 4):
        for e in range(n):
            y[j, e] += dt * w[j, e] - shift * above[j, e] * (g[j, e] + half * r[j, e])
    for e in range(1, n):
        both = g[0, e] + half * r[0, e] + g[4, e - 1] + half * r[4, e - 1]
        y[0, e] += dt * w[0, e] - shift * above[0, e] * 0.5 * both
    y[0, n] += dt * w[0, n]


@kernel
def correct(fields: np.ndarray, dt: float) -> None:
    """Replace the predicted second half kick by the true one, and keep the fresh acceleration."""
    w, old, new = fields[VELOCITY], fields[ACCELERATION], fields[FRESH]
    for row in range(4):
        for e in range(w.shape[1]):
            w[row, e] += dt * (new[row, e] - old[row, e])
            old[row, e] = new[row, e]
