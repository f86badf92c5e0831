"""The tension that pulls the cable straight, ``(T y_x)_x`` of eq. (6).

The flux of the cable (``plant/cable.py``) is its rate. It conserves energy while a particle's tension stays the same;
``1/2 int DT/Dt p^2`` is what a change adds, p = y_x. A jump of the winch's acceleration adds at once.
"""

from __future__ import annotations

import numpy as np

from umbilical.compile import fma, glue, row_kernel
from umbilical.plant.cable import CableConstants, Moment
from umbilical.plant.elements import W0, W1, W2
from umbilical.plant.exogenous import Exogenous
from umbilical.plant.forces.force import Force
from umbilical.relations.tension import inertial_tension, sliding_rates


@row_kernel
def book(
    above: np.ndarray, x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float, factor: float,
    foot: float, rise: float,
) -> None:  # fmt: skip
    """``factor`` times int (foot + rise (1 - sigma)) p^2 dx of every element, J, as its power.

    The power at the end of a step, with that at its start, works for ``half`` the step; then it is the present one.
    After a jump ``half`` is 0: the new power takes the place of the old. ``above`` is 1 - sigma, shape (5, n).
    """
    n = power.size
    scale = factor / (2.0 * n * length)
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    a0, a1, a2, a3, a4 = above[0], above[1], above[2], above[3], above[4]
    for e in range(n):
        ends = fma(fma(rise, a0[e], foot) * x0[e], x0[e], fma(rise, a4[e], foot) * x4[e] * x4[e])
        inner = fma(fma(rise, a1[e], foot) * x1[e], x1[e], fma(rise, a3[e], foot) * x3[e] * x3[e])
        new = scale * fma(W0, ends, fma(W1, inner, W2 * (fma(rise, a2[e], foot) * x2[e] * x2[e])))
        work[e] = fma(half, power[e] + new, work[e])
        power[e] = new


@glue
def book_jerk(
    cable: CableConstants, x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float, net: float,
    factor: float,
) -> None:  # fmt: skip
    """``factor`` times int (m + rho (l - x)) (g - a) p^2 dx: the part of T p^2 that follows the winch's acceleration.

    What the water carries does not.
    """
    foot = inertial_tension(0.0, net, cable.hanging)
    rise = inertial_tension(length, net, cable.hanging) - foot
    book(cable.above, x, power, work, half, length, factor, foot, rise)


@glue
def sliding(cable: CableConstants, moment: Moment, outside: Exogenous) -> tuple[float, float]:
    """``Tt_t + vb T_x`` beside the jerk's part, at the ROV and above it, N/s: drag along, added mass, stretch."""
    foot, slope = sliding_rates(
        moment.hung, cable.axial_drag, cable.coupling, moment.slip, moment.net, outside.sink_speed,
        outside.sink_acceleration,
    )  # fmt: skip
    return foot + outside.elastic_tension_rate, (slope + outside.elastic_gradient_rate) * moment.length


FORCE = Force("work_tension")
