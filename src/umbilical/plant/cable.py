"""The cable with the ROV at its end, on its moving domain: eqs. (6)-(8), discretised by Hamilton's principle.

On sigma = x/l(t) with the material velocity W = Dy/Dt as second unknown, and A = 1 - sigma::

    Y_t = W - (v A/l) Y_sigma
    W_t = -(v A/l) W_sigma + [ (T Y_sigma)_sigma / l^2 - c W + f ] / rho
    ROV (sigma = 1):     m W_t = -T Y_sigma/l - c_tip W + d + alpha
    vessel (sigma = 0):  Y = e,  W = e' + (v/l) Y_sigma

The Lagrangian of the cable is evaluated on the nodes of the elements (``elements.py``) with their own
quadrature, and its Euler-Lagrange equations are the scheme. Nothing is added to make it stable: transport
and its adjoint are exact transposes of each other, so in continuous time a fixed cable conserves its energy
and a moving one keeps the adiabatic balance, hauling in as well as paying out; the time step adds a bounded
ripple of second order.

Order: 4 in the element size for the velocity and 5 for the displacement, 2 in the time step (velocity
Verlet, one evaluation of the forces per step). All are measured in ``tests/convergence``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.plant.elements import DERIVATIVE, WEIGHTS
from umbilical.plant.layout import positions, to_field
from umbilical.relations.formulas import tension
from umbilical.scenario.scenario import Scenario

# Derivative on the reference element, and its adjoint under the quadrature, W^-1 D^T W, which summation by
# parts puts on the test function. Nodes lie symmetrically, so both turn even functions into odd ones and odd
# ones into even ones: kept as the two halves, they need half the multiplications. Constants, for the compiler.
_ADJOINT = DERIVATIVE.T * WEIGHTS[None, :] / WEIGHTS[:, None]
# Row j of the first half acts on ((f0 + f4)/2, (f1 + f3)/2, f2), of the second on ((f0 - f4)/2, (f1 - f3)/2).
D0_EVEN, D1_EVEN = ((float(r[0] + r[4]), float(r[1] + r[3]), float(r[2])) for r in DERIVATIVE[:2])
D0_ODD, D1_ODD, D2_ODD = ((float(r[0] - r[4]), float(r[1] - r[3])) for r in DERIVATIVE[:3])
G0_EVEN, G1_EVEN = ((float(r[0] + r[4]), float(r[1] + r[3]), float(r[2])) for r in _ADJOINT[:2])
G0_ODD, G1_ODD, G2_ODD = ((float(r[0] - r[4]), float(r[1] - r[3])) for r in _ADJOINT[:3])
TIP_ROW = tuple(float(d) for d in DERIVATIVE[4])

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
    f = field
    for e in range(f.shape[1] - 1):
        ends, inner, middle = 0.5 * (f[0, e] + f[0, e + 1]), 0.5 * (f[1, e] + f[3, e]), f[2, e]
        end_step, inner_step = 0.5 * (f[0, e] - f[0, e + 1]), 0.5 * (f[1, e] - f[3, e])
        odd0 = D0_EVEN[0] * ends + D0_EVEN[1] * inner + D0_EVEN[2] * middle
        odd1 = D1_EVEN[0] * ends + D1_EVEN[1] * inner + D1_EVEN[2] * middle
        even0 = D0_ODD[0] * end_step + D0_ODD[1] * inner_step
        even1 = D1_ODD[0] * end_step + D1_ODD[1] * inner_step
        out[0, e] = even0 + odd0
        out[1, e] = even1 + odd1
        out[2, e] = D2_ODD[0] * end_step + D2_ODD[1] * inner_step
        out[3, e] = even1 - odd1
        out[4, e] = even0 - odd0


@kernel
def apply_adjoint(f: np.ndarray) -> None:
    """The adjoint derivative of values at the five points of each element, in their place."""
    for e in range(f.shape[1] - 1):
        ends, inner, middle = 0.5 * (f[0, e] + f[4, e]), 0.5 * (f[1, e] + f[3, e]), f[2, e]
        end_step, inner_step = 0.5 * (f[0, e] - f[4, e]), 0.5 * (f[1, e] - f[3, e])
        odd0 = G0_EVEN[0] * ends + G0_EVEN[1] * inner + G0_EVEN[2] * middle
        odd1 = G1_EVEN[0] * ends + G1_EVEN[1] * inner + G1_EVEN[2] * middle
        even0 = G0_ODD[0] * end_step + G0_ODD[1] * inner_step
        even1 = G1_ODD[0] * end_step + G1_ODD[1] * inner_step
        f[0, e] = even0 + odd0
        f[1, e] = even1 + odd1
        f[2, e] = G2_ODD[0] * end_step + G2_ODD[1] * inner_step
        f[3, e] = even1 - odd1
        f[4, e] = even0 - odd0


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
def force_to_acceleration(cable: Cable, fields: np.ndarray, target: int, length: float, speed: float) -> None:
    """Force of every point (in the flux) over the mass of its node, less transport of mass and damping."""
    n = fields.shape[2] - 1
    w, force, out = fields[VELOCITY], fields[FLUX], fields[target]
    inside = 2.0 * n / (cable.line_density * length)
    loss = speed / length + cable.damping / cable.line_density
    for j in range(1, 4):
        for e in range(n):
            out[j, e] = inside * force[j, e] - loss * w[j, e]
    # Two elements meet at these nodes, each with half of the mass.
    for e in range(1, n):
        out[0, e] = 0.5 * inside * (force[0, e] + force[4, e - 1]) - loss * w[0, e]
    tip_share = END_WEIGHT / (2.0 * n) * cable.line_density * length
    push = END_WEIGHT * force[4, n - 1] - (tip_share * loss + cable.payload_damping) * w[0, n]
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
    apply_adjoint(fields[FLUX])
    force_to_acceleration(cable, fields, target, length, speed)
    if loads.size > 0:
        add_loads(cable, fields[target], length, loads)


@kernel
def kick_payload(cable: Cable, fields: np.ndarray, dt: float, length: float, force: float) -> None:
    """W += dt * force / mass at the node of the ROV, for the forces from outside the cable."""
    n = fields.shape[2] - 1
    tip_mass = END_WEIGHT / (2.0 * n) * cable.line_density * length + cable.payload_mass
    fields[VELOCITY, 0, n] += dt * force / tip_mass


@glue
def leap(cable: Cable, fields: np.ndarray, dt: float, length: float, speed: float) -> None:
    """Half a kick, the drift of a whole step, and half a kick more with the old acceleration.

    ``W += dt/2 W_t;  Y += dt (W - (v A/l) Y_sigma);  W += dt/2 W_t``. The last is a prediction, mended by
    :func:`correct`. The vessel's node is left to its boundary condition.
    """
    if speed == 0.0:
        leap_in_place(fields, dt)
    else:
        leap_with_transport(cable, fields, dt, dt * speed / length * 2.0 * (fields.shape[2] - 1))


@kernel
def leap_in_place(fields: np.ndarray, dt: float) -> None:
    """The winch stands still: no transport."""
    y, w, acceleration = fields[DISPLACEMENT], fields[VELOCITY], fields[ACCELERATION]
    half = 0.5 * dt
    for row in range(4):
        for e in range(y.shape[1]):
            kick = half * acceleration[row, e]
            middle = w[row, e] + kick
            y[row, e] += dt * middle
            w[row, e] = middle + kick


@kernel
def leap_with_transport(cable: Cable, fields: np.ndarray, dt: float, shift: float) -> None:
    """Transport by the slope in the middle of the step; a shared node takes the mean slope of its two sides."""
    n = fields.shape[2] - 1
    y, w, acceleration, above = fields[DISPLACEMENT], fields[VELOCITY], fields[ACCELERATION], cable.above
    g, middle, r = fields[SLOPE], fields[FLUX], fields[SCRATCH]
    half, half_shift = 0.5 * dt, 0.5 * shift
    for j in range(1, 4):
        for e in range(n):
            w[j, e] += half * acceleration[j, e]
            middle[j, e] = y[j, e] + half * w[j, e] - half_shift * above[j, e] * g[j, e]
    for e in range(1, n):
        w[0, e] += half * acceleration[0, e]
        middle[0, e] = y[0, e] + half * w[0, e] - half_shift * above[0, e] * 0.5 * (g[0, e] + g[4, e - 1])
    w[0, n] += half * acceleration[0, n]
    middle[0, 0] = y[0, 0] + half * w[0, 0] - half_shift * g[0, 0]
    middle[0, n] = y[0, n] + half * w[0, n]
    differentiate(middle, r)
    for j in range(1, 4):
        for e in range(n):
            y[j, e] += dt * w[j, e] - shift * above[j, e] * r[j, e]
            w[j, e] += half * acceleration[j, e]
    for e in range(1, n):
        y[0, e] += dt * w[0, e] - shift * above[0, e] * 0.5 * (r[0, e] + r[4, e - 1])
        w[0, e] += half * acceleration[0, e]
    y[0, n] += dt * w[0, n]
    w[0, n] += half * acceleration[0, n]


@kernel
def correct(fields: np.ndarray, dt: float) -> None:
    """Replace the predicted second half kick by the true one, and keep the fresh acceleration."""
    w, old, new = fields[VELOCITY], fields[ACCELERATION], fields[FRESH]
    for row in range(4):
        for e in range(w.shape[1]):
            w[row, e] += dt * (new[row, e] - old[row, e])
            old[row, e] = new[row, e]
