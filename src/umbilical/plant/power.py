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

# Terms that act at the ends of the cable; then those along it, which are kept element by element.
THRUST, PAYLOAD_FORCE, PAYLOAD_DAMPING, VESSEL = range(4)  # the first two by mean_work
CABLE_DAMPING, CABLE_LOAD, TENSION = range(3)
END_TERMS, ALONG_TERMS = 4, 3


@kernel
def strain_of_elements(
    cable: Cable, fields: np.ndarray, out: np.ndarray, length: float, net_gravity: float, factor: float
) -> None:
    """``factor`` times int T p^2 dx of every element (twice its strain energy, J) into ``out``, shape (n + 1,)."""
    n = fields.shape[2] - 1
    g, dense, above = fields[SLOPE], fields[SCRATCH], cable.above
    foot = tension(0.0, net_gravity, cable.payload_mass, cable.hanging_density)
    rise = tension(length, net_gravity, cable.payload_mass, cable.hanging_density) - foot
    for j in range(5):
        for e in range(n):
            dense[j, e] = (foot + rise * above[j, e]) * g[j, e] * g[j, e]
    scale = factor * 2.0 * n / length
    for e in range(n):
        ends, inner = dense[0, e] + dense[4, e], dense[1, e] + dense[3, e]
        out[e] = scale * (W0 * ends + W1 * inner + W2 * dense[2, e])


@kernel
def squares_of_elements(fields: np.ndarray, out: np.ndarray, length: float, factor: float) -> None:
    """``factor`` times int W^2 dx of every element, m3/s2, into ``out``, shape (n + 1,)."""
    n = fields.shape[2] - 1
    w = fields[VELOCITY]
    scale = factor * length / (2.0 * n)
    for e in range(n):
        ends = w[0, e] * w[0, e] + w[0, e + 1] * w[0, e + 1]
        inner = w[1, e] * w[1, e] + w[3, e] * w[3, e]
        out[e] = scale * (W0 * ends + W1 * inner + W2 * (w[2, e] * w[2, e]))


@kernel
def load_on_elements(cable: Cable, fields: np.ndarray, out: np.ndarray, length: float, loads: np.ndarray) -> None:
    """int f W dx of every element, W, into ``out``, shape (n + 1,)."""
    n = fields.shape[2] - 1
    w = fields[VELOCITY]
    scale = length / (2.0 * n)
    for e in range(n):
        out[e] = 0.0
    for k in range(loads.size):
        p = cable.profiles[k]
        for e in range(n):
            ends = p[0, e] * w[0, e] + p[0, e + 1] * w[0, e + 1]
            inner = p[1, e] * w[1, e] + p[3, e] * w[3, e]
            out[e] += scale * loads[k] * (W0 * ends + W1 * inner + W2 * (p[2, e] * w[2, e]))


@kernel
def power_along(
    cable: Cable,
    fields: np.ndarray,
    out: np.ndarray,
    length: float,
    net_gravity: float,
    jerk_ratio: float,
    loads: np.ndarray,
) -> None:
    """Terms along the cable at the present state, element by element, into ``out``, shape (3, n + 1), W."""
    if cable.damping != 0.0:
        squares_of_elements(fields, out[CABLE_DAMPING], length, -cable.damping)
    if loads.size > 0:
        load_on_elements(cable, fields, out[CABLE_LOAD], length, loads)
    if jerk_ratio != 0.0:
        strain_of_elements(cable, fields, out[TENSION], length, net_gravity, -0.5 * jerk_ratio)
    else:
        out[TENSION] = 0.0


@kernel
def power_at_ends(
    cable: Cable, fields: np.ndarray, out: np.ndarray, length: float, speed: float, net_gravity: float, vessel: float
) -> None:
    """Damping of the ROV and the vessel's end at the present state into ``out``, shape (4,), W; ``vessel`` is e'."""
    n = fields.shape[2] - 1
    tip = fields[VELOCITY, 0, n]
    top_tension = tension(length, net_gravity, cable.payload_mass, cable.hanging_density)
    top_slope = 2.0 * n / length * fields[SLOPE, 0, 0]
    top_velocity = vessel + speed * top_slope
    out[PAYLOAD_DAMPING] = -cable.payload_damping * tip * tip
    pull = -top_tension * top_slope * (vessel + 0.5 * speed * top_slope)
    out[VESSEL] = pull + 0.5 * cable.line_density * speed * top_velocity * top_velocity


@kernel
def add_power(work: np.ndarray, power: np.ndarray, time: float) -> None:
    """work += power * time, along a row."""
    for k in range(work.size):
        work[k] += time * power[k]


@kernel
def mean_work(time: float, force: float, force_end: float, velocity: float, velocity_end: float) -> float:
    """Work of a force on the ROV over a step, J: mean force times mean velocity.

    It is what the kicks of the scheme do to the kinetic energy, so a force that changes within a few steps
    leaves no residual of the balance behind.
    """
    return 0.25 * time * (force + force_end) * (velocity + velocity_end)
