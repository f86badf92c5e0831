"""Linear damping of the cable, ``-c Dy/Dt`` on a metre, eq. (6); Dy/Dt = Wb + slip y_x where water moves along."""

from __future__ import annotations

import numpy as np

from umbilical.compile import fma, kernel, row_kernel
from umbilical.plant.elements import W0, W1, W2
from umbilical.plant.forces.force import Decay, Force
from umbilical.relations.water import line_inertia
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.scenario import Scenario


def rate(scenario: Scenario) -> float:
    """What it takes of a velocity, 1/s: the step takes it off all nodes at once."""
    return scenario.cable.damping / line_inertia(scenario.cable, scenario.payload, scenario.environment)


@kernel
def add_sliding(x: np.ndarray, rate: np.ndarray, factor: float) -> None:
    """Add ``factor`` times Y_sigma to the rates of the velocities: what sliding adds to Dy/Dt."""
    n = rate.shape[1] // 2
    for j in range(5):
        for e in range(n):
            rate[j, n + e] += factor * x[j, e]


@row_kernel
def book(
    damping: float, x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float, slip: float
) -> None:
    """``-c int Wb (Wb + slip p)`` of every element, W, as its new power; its work, J, over ``half`` the step."""
    n = power.size
    scale, sliding = -damping * length / (2.0 * n), slip / length
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    w0, w1, w2, w3, w4 = x[0, n:], x[1, n:], x[2, n:], x[3, n:], x[4, n:]
    for e in range(n):
        ends = fma(w0[e], fma(sliding, x0[e], w0[e]), w4[e] * fma(sliding, x4[e], w4[e]))
        inner = fma(w1[e], fma(sliding, x1[e], w1[e]), w3[e] * fma(sliding, x3[e], w3[e]))
        new = scale * fma(W0, ends, fma(W1, inner, W2 * (w2[e] * fma(sliding, x2[e], w2[e]))))
        work[e] = fma(half, power[e] + new, work[e])
        power[e] = new


def damping(scenario: Scenario, water: np.ndarray) -> float:
    """c, N s/m2, wherever it is."""
    return scenario.cable.damping


def decay(cable: Cable, payload: Payload, environment: Environment) -> Decay:
    """c over the mass that moves with a metre."""
    return Decay("cable.damping", cable.damping, "N s/m2", line_inertia(cable, payload, environment))


FORCE = Force("work_cable_damping", "cable", damping, decay)
