"""The tension that pulls the cable straight, ``(T y_x)_x`` of eq. (6).

The flux of the cable (``plant/cable.py``) is its rate. It conserves energy while a particle's tension stays the same;
``1/2 int DT/Dt p^2`` is what a change adds, p = y_x. A jump of the winch's acceleration adds at once.
"""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.elements import W0, W1, W2
from umbilical.plant.forces.force import Force
from umbilical.relations.tension import Hanging, inertial_tension


@kernel
def book(
    hung: Hanging, above: np.ndarray, x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float,
    net_gravity: float, factor: float,
) -> None:  # fmt: skip
    """``factor`` times int (m + rho (l - x)) (g - a) p^2 dx of every element, J, as its power.

    That is the part of T p^2 which follows the winch's acceleration; what the water carries does not.
    The power at the end of a step, with that at its start, works for ``half`` the step; then it is the present one.
    After a jump ``half`` is 0: the new power takes the place of the old. ``above`` is 1 - sigma, shape (5, n).
    """
    n = power.size
    foot = inertial_tension(0.0, net_gravity, hung)
    rise = inertial_tension(length, net_gravity, hung) - foot
    scale = factor / (2.0 * n * length)
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    a0, a1, a2, a3, a4 = above[0], above[1], above[2], above[3], above[4]
    for e in range(n):
        ends = (foot + rise * a0[e]) * x0[e] * x0[e] + (foot + rise * a4[e]) * x4[e] * x4[e]
        inner = (foot + rise * a1[e]) * x1[e] * x1[e] + (foot + rise * a3[e]) * x3[e] * x3[e]
        new = scale * (W0 * ends + W1 * inner + W2 * ((foot + rise * a2[e]) * x2[e] * x2[e]))
        work[e] += half * (power[e] + new)
        power[e] = new


FORCE = Force("work_tension")
