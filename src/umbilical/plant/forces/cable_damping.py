"""Linear damping of the cable, ``-c Dy/Dt`` on a metre, eq. (6)."""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.elements import W0, W1, W2
from umbilical.plant.forces.force import Decay, Force, OperatingPoint
from umbilical.scenario.hardware import Cable
from umbilical.scenario.scenario import Scenario


def rate(scenario: Scenario) -> float:
    """What it takes of a velocity, 1/s: the step takes it off all nodes at once."""
    return scenario.cable.damping / scenario.cable.line_density


@kernel
def book(damping: float, x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float) -> None:
    """``-c int W^2`` of every element, W, as its new power; its work, J, for ``half`` the step with the old one."""
    n = power.size
    scale = -damping * length / (2.0 * n)
    w0, w1, w2, w3, w4 = x[0, n:], x[1, n:], x[2, n:], x[3, n:], x[4, n:]
    for e in range(n):
        ends, inner = w0[e] * w0[e] + w4[e] * w4[e], w1[e] * w1[e] + w3[e] * w3[e]
        new = scale * (W0 * ends + W1 * inner + W2 * (w2[e] * w2[e]))
        work[e] += half * (power[e] + new)
        power[e] = new


def damping(scenario: Scenario, at: OperatingPoint) -> float:
    """c, N s/m2, wherever it is."""
    return scenario.cable.damping


def decay(cable: Cable, **_: object) -> Decay:
    """c over the mass of a metre."""
    return Decay("cable.damping", cable.damping, "N s/m2", cable.line_density)


FORCE = Force("work_cable_damping", "cable", damping, decay)
