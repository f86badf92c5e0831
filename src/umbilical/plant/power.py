"""The power balance of the moving cable: what the energy of cable and ROV changes by, term by term.

With p = y_x, W = Dy/Dt and E = 1/2 int(rho W^2 + T p^2) dx + 1/2 m W_l^2::

    dE/dt = W_l alpha + W_l d - c_tip W_l^2 - c int W^2 + int f W
            - T_0 p_0 e' - (v/2) T_0 p_0^2 + (rho v/2) (e' + v p_0)^2
            - 1/2 (a'/(g - a)) int T p^2

A jump of the winch acceleration changes the tension and with it the energy at once.
"""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.cable import SCRATCH, SLOPE, VELOCITY, W0, W1, W2, Cable
from umbilical.relations.formulas import tension

THRUST, PAYLOAD_FORCE, PAYLOAD_DAMPING, CABLE_DAMPING, CABLE_LOAD, VESSEL, TENSION = range(7)
TERMS = 7


@kernel
def weighted_sum(rows: np.ndarray) -> float:
    """Quadrature of values at the five points of each element, over the reference elements."""
    n = rows.shape[1] - 1
    total = 0.0
    for e in range(n):
        total += W0 * (rows[0, e] + rows[4, e]) + W1 * (rows[1, e] + rows[3, e]) + W2 * rows[2, e]
    return total


@kernel
def strain_integral(cable: Cable, fields: np.ndarray, length: float, net_gravity: float) -> float:
    """int T p^2 dx, J (twice the strain energy)."""
    n = fields.shape[2] - 1
    g, out, above = fields[SLOPE], fields[SCRATCH], cable.above
    foot = tension(0.0, net_gravity, cable.payload_mass, cable.hanging_density)
    rise = tension(length, net_gravity, cable.payload_mass, cable.hanging_density) - foot
    for j in range(5):
        for e in range(n):
            out[j, e] = (foot + rise * above[j, e]) * g[j, e] * g[j, e]
    return weighted_sum(out) * 2.0 * n / length


@kernel
def square_integral(fields: np.ndarray, length: float) -> float:
    """int W^2 dx, m3/s2."""
    n = fields.shape[2] - 1
    w = fields[VELOCITY]
    total = 0.0
    for e in range(n):
        ends = w[0, e] * w[0, e] + w[0, e + 1] * w[0, e + 1]
        total += W0 * ends + W1 * (w[1, e] * w[1, e] + w[3, e] * w[3, e]) + W2 * (w[2, e] * w[2, e])
    return total * length / (2.0 * n)


@kernel
def load_power(cable: Cable, fields: np.ndarray, length: float, loads: np.ndarray) -> float:
    """int f W dx, W."""
    n = fields.shape[2] - 1
    w = fields[VELOCITY]
    total = 0.0
    for k in range(loads.size):
        p = cable.profiles[k]
        for e in range(n):
            ends = p[0, e] * w[0, e] + p[0, e + 1] * w[0, e + 1]
            inner = p[1, e] * w[1, e] + p[3, e] * w[3, e]
            total += loads[k] * (W0 * ends + W1 * inner + W2 * (p[2, e] * w[2, e]))
    return total * length / (2.0 * n)


@kernel
def powers(
    cable: Cable,
    fields: np.ndarray,
    out: np.ndarray,
    length: float,
    speed: float,
    net_gravity: float,
    jerk_ratio: float,
    vessel_velocity: float,
    thrust: float,
    payload_force: float,
    loads: np.ndarray,
) -> None:
    """Every term of the balance at the present state into ``out``, shape (7,), W."""
    n = fields.shape[2] - 1
    tip = fields[VELOCITY, 0, n]
    top_tension = tension(length, net_gravity, cable.payload_mass, cable.hanging_density)
    top_slope = 2.0 * n / length * fields[SLOPE, 0, 0]
    top_velocity = vessel_velocity + speed * top_slope
    out[THRUST] = tip * thrust
    out[PAYLOAD_FORCE] = tip * payload_force
    out[PAYLOAD_DAMPING] = -cable.payload_damping * tip * tip
    out[CABLE_DAMPING] = -cable.damping * square_integral(fields, length) if cable.damping != 0.0 else 0.0
    out[CABLE_LOAD] = load_power(cable, fields, length, loads) if loads.size > 0 else 0.0
    out[VESSEL] = (
        -top_tension * top_slope * (vessel_velocity + 0.5 * speed * top_slope)
        + 0.5 * cable.line_density * speed * top_velocity * top_velocity
    )
    out[TENSION] = (
        -0.5 * jerk_ratio * strain_integral(cable, fields, length, net_gravity) if jerk_ratio != 0.0 else 0.0
    )
