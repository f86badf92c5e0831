"""Morison drag of the cable, on a metre (``relations/water.py`` has the coefficients)::

    f_n = 1/2 rho_w C_dn d |u_r| u_r - 1/2 rho_w pi d C_dt |v_z| v_z y_x,    u_r = u - (y_t + zeta' y_x)

Normal drag sees y_t and not Dy/Dt: a cable that slides along itself through still water has no velocity across.
With Wb = y_t + vb y_x and k = v_z - slip the relative velocity is ``u - Wb + k y_x``. The second term is the lateral
part of the drag along the cable. It cancels against that drag's share of T_x y_x and damps nothing; the net effect is
a lower tension, so neither may be left out.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.elements import W0, W1, W2
from umbilical.plant.forces.force import Decay, Force, add_power, begin_work, fastest_current
from umbilical.relations.water import in_water, line_inertia
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.scenario import Scenario


class Drag(NamedTuple):
    """Coefficients over the square of the speed, N s2/m3, and whether there is any."""

    normal: float
    tangential: float
    acts: bool


def make(scenario: Scenario) -> Drag:
    """Coefficients of a scenario's cable."""
    found = in_water(scenario.cable, scenario.payload, scenario.environment)
    return Drag(found.normal, found.tangential, found.normal > 0.0 or found.tangential > 0.0)


@kernel
def add(
    drag: Drag, inertia: float, x: np.ndarray, rate: np.ndarray, water: np.ndarray, length: float, sinks: float,
    slip: float,
) -> None:  # fmt: skip
    """Add f_n/M to the rates of a block; ``water``, shape (5, n), is the speed of the water, m/s."""
    n = rate.shape[1] // 2
    normal, along = drag.normal / inertia, drag.tangential * abs(sinks) * sinks / (inertia * length)
    slides = (sinks - slip) / length
    for j in range(5):
        slope, velocity, flow, out = x[j, :n], x[j, n:], water[j], rate[j, n:]
        for e in range(n):
            relative = flow[e] - velocity[e] + slides * slope[e]
            out[e] += normal * abs(relative) * relative - along * slope[e]


@kernel
def book(
    drag: Drag, x: np.ndarray, power: np.ndarray, work: np.ndarray, given: np.ndarray, water: np.ndarray,
    half: float, length: float, sinks: float, slip: float,
) -> None:  # fmt: skip
    """``int f_n (Wb - u)`` of every element, W, as its new power, its work over ``half`` the step; ``given``: f_n u."""
    n = power.size
    scale, slides = length / (2.0 * n), (sinks - slip) / length
    along = drag.tangential * abs(sinks) * sinks / length
    begin_work(power, work, half)
    for j in range(5):
        weight = scale * (W0 if j == 0 or j == 4 else W1 if j == 1 or j == 3 else W2)
        slope, velocity, flow = x[j, :n], x[j, n:], water[j]
        for e in range(n):
            current = flow[e]
            relative = current - velocity[e] + slides * slope[e]
            force = weight * (drag.normal * abs(relative) * relative - along * slope[e])
            power[e] += force * (velocity[e] - current)
            given[e] += force * current
    add_power(work, power, half)


def damping(scenario: Scenario, water: np.ndarray) -> np.ndarray:
    """``rho_w C_dn d |u_r|``, N s/m2, at the water's speed past the cable at rest; zero in still water."""
    return 2.0 * make(scenario).normal * np.abs(water)


def decay(cable: Cable, payload: Payload, environment: Environment) -> Decay:
    """At the fastest current, and a metre per second of the cable besides."""
    found = 2.0 * in_water(cable, payload, environment).normal * (fastest_current(environment) + 1.0)
    return Decay("cable.water.normal_drag", found, "N s/m2", line_inertia(cable, payload, environment))


FORCE = Force("work_drag", "cable", damping, decay)
