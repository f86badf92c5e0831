"""The power balance of the moving cable: what the energy of cable and ROV changes by, term by term.

With p = y_x, W = Dy/Dt and E = 1/2 int(rho W^2 + T p^2) dx + 1/2 m W_l^2::

    dE/dt = W_l alpha + W_l d - c_tip W_l^2 - c int W^2 + int f W
            - T_0 p_0 e' - (v/2) T_0 p_0^2 + (rho v/2) (e' + v p_0)^2
            - 1/2 (a'/(g - a)) int (m + rho (l - x)) (g - a) p^2

A jump of the winch acceleration changes the tension and with it the energy at once. What the upwind flux takes
from waves too short for the grid is in no term: it stays as the residual of the balance.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import kernel
from umbilical.frames import Frame, real
from umbilical.plant.cable import W0, W1, W2, Cable, Ends
from umbilical.relations.tension import inertial_tension, tension


class EndWorks(Frame):
    """Work done at the ends of the cable since the start, and the present power of what has one.

    Thrust and force on the ROV work by their impulse.
    """

    work_thrust = real()
    work_payload_force = real()
    work_payload_damping = real()
    work_vessel = real()
    power_payload_damping = real()
    power_vessel = real()


class Along(NamedTuple):
    """A power, W, or its work, J, in each element of the cable, shape (n,) each."""

    cable_damping: np.ndarray
    cable_load: np.ndarray
    tension: np.ndarray


def make_along(elements: int) -> Along:
    """Nothing yet."""
    return Along(*np.zeros((len(Along._fields), elements)))


@kernel
def strain_of_elements(
    cable: Cable, x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float, net_gravity: float,
    factor: float,
) -> None:  # fmt: skip
    """``factor`` times int (m + rho (l - x)) (g - a) p^2 dx of every element, J, as its power.

    That is the part of T p^2 which follows the winch's acceleration; what the water carries does not.
    The power at the end of a step, with that at its start, works for ``half`` the step; then it is the present one.
    After a jump ``half`` is 0: the new power takes the place of the old.
    """
    n = power.size
    foot = inertial_tension(0.0, net_gravity, cable.hanging)
    rise = inertial_tension(length, net_gravity, cable.hanging) - foot
    scale = factor / (2.0 * n * length)
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    a0, a1, a2, a3, a4 = cable.above[0], cable.above[1], cable.above[2], cable.above[3], cable.above[4]
    for e in range(n):
        ends = (foot + rise * a0[e]) * x0[e] * x0[e] + (foot + rise * a4[e]) * x4[e] * x4[e]
        inner = (foot + rise * a1[e]) * x1[e] * x1[e] + (foot + rise * a3[e]) * x3[e] * x3[e]
        new = scale * (W0 * ends + W1 * inner + W2 * ((foot + rise * a2[e]) * x2[e] * x2[e]))
        work[e] += half * (power[e] + new)
        power[e] = new


@kernel
def squares_of_elements(
    x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float, factor: float
) -> None:
    """``factor`` times int W^2 dx of every element, m3/s2, as its new power."""
    n = power.size
    scale = factor * length / (2.0 * n)
    w0, w1, w2, w3, w4 = x[0, n:], x[1, n:], x[2, n:], x[3, n:], x[4, n:]
    for e in range(n):
        ends, inner = w0[e] * w0[e] + w4[e] * w4[e], w1[e] * w1[e] + w3[e] * w3[e]
        new = scale * (W0 * ends + W1 * inner + W2 * (w2[e] * w2[e]))
        work[e] += half * (power[e] + new)
        power[e] = new


@kernel
def load_on_elements(
    cable: Cable, x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float, loads: np.ndarray
) -> None:
    """int f W dx of every element, W, as its new power."""
    n = power.size
    scale = length / (2.0 * n)
    for e in range(n):
        work[e] += half * power[e]
        power[e] = 0.0
    for k in range(loads.size):
        p = cable.profiles[k]
        for e in range(n):
            ends = p[0, e] * x[0, n + e] + p[4, e] * x[4, n + e]
            inner = p[1, e] * x[1, n + e] + p[3, e] * x[3, n + e]
            new = scale * loads[k] * (W0 * ends + W1 * inner + W2 * (p[2, e] * x[2, n + e]))
            work[e] += half * new
            power[e] += new


@kernel
def book_along(
    cable: Cable,
    x: np.ndarray,
    power: Along,
    work: Along,
    half: float,
    length: float,
    net_gravity: float,
    relative_jerk: float,
    last_relative_jerk: float,
    loads: np.ndarray,
) -> None:
    """Terms along the cable, element by element.

    The tension works only while the winch acceleration changes, or did at the start of the step.
    """
    if cable.damping != 0.0:
        squares_of_elements(x, power.cable_damping, work.cable_damping, half, length, -cable.damping)
    if loads.size > 0:
        load_on_elements(cable, x, power.cable_load, work.cable_load, half, length, loads)
    if relative_jerk != 0.0 or last_relative_jerk != 0.0:
        strain_of_elements(cable, x, power.tension, work.tension, half, length, net_gravity, -0.5 * relative_jerk)


@kernel
def book_at_ends(
    cable: Cable, ends: Ends, works: EndWorks, half: float, length: float, speed: float, net_gravity: float,
    vessel: float,
) -> None:  # fmt: skip
    """Damping of the ROV and the vessel's end, ``half`` as in :func:`strain_of_elements`; ``vessel`` is e', m/s."""
    top_tension = tension(length, net_gravity, cable.hanging)
    top_slope = ends.vessel_slope
    top_velocity = vessel + speed * top_slope
    damping = -cable.payload_damping * ends.tip_velocity * ends.tip_velocity
    works.work_payload_damping += half * (works.power_payload_damping + damping)
    works.power_payload_damping = damping
    pull = -top_tension * top_slope * (vessel + 0.5 * speed * top_slope)
    top = pull + 0.5 * cable.line_density * speed * top_velocity * top_velocity
    works.work_vessel += half * (works.power_vessel + top)
    works.power_vessel = top


@kernel
def add_power(work: np.ndarray, power: np.ndarray, time: float) -> None:
    """work += power * time, along a row."""
    for k in range(work.size):
        work[k] += time * power[k]
