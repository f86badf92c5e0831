"""What water that moves ever faster does beside its drag: ``(rho_w A_c + rho_a) u_t`` on a metre of cable and
``(A_h + W_FK) u_t`` on the ROV, Froude-Krylov force and added mass. Its work holds what drag gets from the current too.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.elements import W0, W1, W2
from umbilical.plant.forces.force import Force
from umbilical.relations.water import in_water
from umbilical.scenario.scenario import Scenario


class Moved(NamedTuple):
    """Water that a change of the current pulls along: of a metre of cable, kg/m, and of the ROV, kg."""

    line: float
    body: float


def make(scenario: Scenario) -> Moved:
    """Displaced and added masses."""
    found = in_water(scenario.cable, scenario.payload, scenario.environment)
    return Moved(found.displaced + found.added, found.body_displaced + found.body_added)


@kernel
def add(moved: Moved, inertia: float, rate: np.ndarray, change: np.ndarray) -> None:
    """Add the acceleration to the rates of a block; ``change``, shape (5, n), is u_t, m/s2."""
    n, factor = rate.shape[1] // 2, moved.line / inertia
    for j in range(5):
        for e in range(n):
            rate[j, n + e] += factor * change[j, e]


@kernel
def give(moved: Moved, x: np.ndarray, power: np.ndarray, change: np.ndarray, length: float) -> None:
    """``int (rho_w A_c + rho_a) u_t Wb`` of every element, W, on top of its new power."""
    n = power.size
    scale = moved.line * length / (2.0 * n)
    for j in range(5):
        weight = scale * (W0 if j == 0 or j == 4 else W1 if j == 1 or j == 3 else W2)
        for e in range(n):
            power[e] += weight * change[j, e] * x[j, n + e]


FORCE = Force("work_current")
