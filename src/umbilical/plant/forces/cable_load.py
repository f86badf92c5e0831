"""Loads along the cable that the scenario gives: ``f(x, t)``, profiles over sigma times signals, N/m, eq. (6)."""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.elements import W0, W1, W2
from umbilical.plant.forces.force import Force, begin_work


@kernel
def add(profiles: np.ndarray, line_density: float, rate: np.ndarray, loads: np.ndarray) -> None:
    """Add the loads, N/m per profile, shape (loads, 5, n), to the rates of a block."""
    n = rate.shape[1] // 2
    for k in range(loads.size):
        amount = loads[k] / line_density
        for j in range(5):
            for e in range(n):
                rate[j, n + e] += amount * profiles[k, j, e]


@kernel
def book(
    profiles: np.ndarray, x: np.ndarray, power: np.ndarray, work: np.ndarray, half: float, length: float,
    loads: np.ndarray,
) -> None:  # fmt: skip
    """``int f W`` of every element, W, as its new power; its work, J, for ``half`` the step with the old one."""
    n = power.size
    scale = length / (2.0 * n)
    begin_work(power, work, half)
    for k in range(loads.size):
        p = profiles[k]
        for e in range(n):
            ends = p[0, e] * x[0, n + e] + p[4, e] * x[4, n + e]
            inner = p[1, e] * x[1, n + e] + p[3, e] * x[3, n + e]
            new = scale * loads[k] * (W0 * ends + W1 * inner + W2 * (p[2, e] * x[2, n + e]))
            work[e] += half * new
            power[e] += new


FORCE = Force("work_cable_load")
