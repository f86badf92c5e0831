"""The power balance of the moving cable: what the energy of cable and ROV changes by, term by term.

With p = y_x, W = Dy/Dt and E = 1/2 int(rho W^2 + T p^2) dx + 1/2 m W_l^2::

    dE/dt = W_l alpha + W_l d - c_tip W_l^2 - c int W^2 + int f W
            - T_0 p_0 e' - (v/2) T_0 p_0^2 + (rho v/2) (e' + v p_0)^2
            - 1/2 (a'/(g - a)) int T p^2

A jump of the winch acceleration changes the tension and with it the energy at once. What the upwind flux takes
from waves too short for the grid is in no term: it stays as the residual of the balance.
"""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.cable import TIP_VELOCITY, VESSEL_SLOPE, W0, W1, W2, Cable
from umbilical.relations.formulas import tension

# Terms that act at the ends of the cable; then those along it, which are kept element by element.
THRUST, PAYLOAD_FORCE, PAYLOAD_DAMPING, VESSEL = range(4)  # the first two by their impulse
CABLE_DAMPING, CABLE_LOAD, TENSION = range(3)
END_TERMS, ALONG_TERMS = 4, 3


@kernel
def strain_of_elements(
    cable: Cable, x: np.ndarray, out: np.ndarray, length: float, net_gravity: float, factor: float
) -> None:
    """``factor`` times int T p^2 dx of every element (twice its strain energy, J) into ``out``, shape (n,)."""
    n = out.size
    foot = tension(0.0, net_gravity, cable.payload_mass, cable.hanging_density)
    rise = tension(length, net_gravity, cable.payload_mass, cable.hanging_density) - foot
    scale = factor / (2.0 * n * length)
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    a0, a1, a2, a3, a4 = cable.above[0], cable.above[1], cable.above[2], cable.above[3], cable.above[4]
    for e in range(n):
        ends = (foot + rise * a0[e]) * x0[e] * x0[e] + (foot + rise * a4[e]) * x4[e] * x4[e]
        inner = (foot + rise * a1[e]) * x1[e] * x1[e] + (foot + rise * a3[e]) * x3[e] * x3[e]
        out[e] = scale * (W0 * ends + W1 * inner + W2 * ((foot + rise * a2[e]) * x2[e] * x2[e]))


@kernel
def squares_of_elements(x: np.ndarray, out: np.ndarray, length: float, factor: float) -> None:
    """``factor`` times int W^2 dx of every element, m3/s2, into ``out``, shape (n,)."""
    n = out.size
    scale = factor * length / (2.0 * n)
    w0, w1, w2, w3, w4 = x[0, n:], x[1, n:], x[2, n:], x[3, n:], x[4, n:]
    for e in range(n):
        ends, inner = w0[e] * w0[e] + w4[e] * w4[e], w1[e] * w1[e] + w3[e] * w3[e]
        out[e] = scale * (W0 * ends + W1 * inner + W2 * (w2[e] * w2[e]))


@kernel
def load_on_elements(cable: Cable, x: np.ndarray, out: np.ndarray, length: float, loads: np.ndarray) -> None:
    """int f W dx of every element, W, into ``out``, shape (n,)."""
    n = out.size
    scale = length / (2.0 * n)
    for e in range(n):
        out[e] = 0.0
    for k in range(loads.size):
        p = cable.profiles[k]
        for e in range(n):
            ends = p[0, e] * x[0, n + e] + p[4, e] * x[4, n + e]
            inner = p[1, e] * x[1, n + e] + p[3, e] * x[3, n + e]
            out[e] += scale * loads[k] * (W0 * ends + W1 * inner + W2 * (p[2, e] * x[2, n + e]))


@kernel
def power_along(
    cable: Cable,
    x: np.ndarray,
    out: np.ndarray,
    length: float,
    net_gravity: float,
    jerk_ratio: float,
    loads: np.ndarray,
) -> None:
    """Terms along the cable at the present state, element by element, into ``out``, shape (3, n), W."""
    if cable.damping != 0.0:
        squares_of_elements(x, out[CABLE_DAMPING], length, -cable.damping)
    if loads.size > 0:
        load_on_elements(cable, x, out[CABLE_LOAD], length, loads)
    if jerk_ratio != 0.0:
        strain_of_elements(cable, x, out[TENSION], length, net_gravity, -0.5 * jerk_ratio)
    else:
        out[TENSION] = 0.0


@kernel
def power_at_ends(
    cable: Cable, ends: np.ndarray, out: np.ndarray, length: float, speed: float, net_gravity: float, vessel: float
) -> None:
    """Damping of the ROV and the vessel's end at the present state into ``out``, shape (4,), W; ``vessel`` is e'."""
    top_tension = tension(length, net_gravity, cable.payload_mass, cable.hanging_density)
    top_slope = ends[VESSEL_SLOPE]
    top_velocity = vessel + speed * top_slope
    out[PAYLOAD_DAMPING] = -cable.payload_damping * ends[TIP_VELOCITY] * ends[TIP_VELOCITY]
    pull = -top_tension * top_slope * (vessel + 0.5 * speed * top_slope)
    out[VESSEL] = pull + 0.5 * cable.line_density * speed * top_velocity * top_velocity


@kernel
def add_power(work: np.ndarray, power: np.ndarray, time: float) -> None:
    """work += power * time, along a row."""
    for k in range(work.size):
        work[k] += time * power[k]
