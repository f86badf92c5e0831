"""The allocations: what a scenario's ``control.allocation.method`` stands for.

A kernel cannot walk over a table: the kernels here name every method once, for thrust along x and in both directions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.control.allocation.adaptive import (
    KappaStep,
    adapt,
    adaptation,
    adaptation_has_its_error,
    adaptive_demand,
    common_demand,
    leak,
    make_adaptation,
)
from umbilical.control.allocation.known import known_demand
from umbilical.control.contract import MotorDecision, OuterDecision
from umbilical.control.nominal import NominalMotor
from umbilical.scenario import control as records
from umbilical.scenario.findings import Finding

METHODS: dict[str, tuple[Callable[..., Iterator[Finding]], ...]] = {
    "known": (),
    "adaptive": (adaptation, adaptation_has_its_error, leak),
}
"""Every method with its checks."""
KNOWN, ADAPTIVE = range(len(METHODS))
"""What the kernels switch on: the place of a method in :data:`METHODS`."""


class Allocation(NamedTuple):
    """Which method, and the constants of each, idle where it is not the scenario's."""

    method: int
    adaptation: KappaStep


class Directions(NamedTuple):
    """Where motors push, for thrust in two directions.

    Attributes:
        shares: demand of each motor, before its sign, per newton of thrust in x and y, shape (motors, 2).
        towards: unit vectors of the motors' thrusts, shape (motors, 2).
    """

    shares: np.ndarray
    towards: np.ndarray


def make_allocation(record: records.Allocation, motors: int, period: float) -> Allocation:
    """Constants of a scenario's method for one period of the outer loop."""
    return Allocation(list(METHODS).index(record.method), make_adaptation(record, motors, period))


@glue
def allocate(
    s: Allocation, nominal: NominalMotor, kappa: np.ndarray, outer: OuterDecision, out: MotorDecision, advance: bool
) -> None:
    """Demands on the motors from the thrust; ``advance`` is False at the first update."""
    if s.method == ADAPTIVE:
        if advance:
            adapt(s.adaptation, kappa, outer.thrust_command, outer.boundary_error)
        adaptive_demand(nominal, kappa, outer.thrust_command, out)
    else:
        known_demand(nominal, outer.thrust_command, out)


@kernel
def allocate_both(
    s: Allocation,
    nominal: NominalMotor,
    directions: Directions,
    kappas: tuple[np.ndarray, np.ndarray],
    x: OuterDecision,
    y: OuterDecision,
    out: MotorDecision,
    advance: bool,
) -> None:
    """Demands on the motors from the thrusts in both directions; the adaptive law per direction."""
    along, across, factors = x.thrust_command, y.thrust_command, directions.shares
    if s.method == ADAPTIVE:
        if advance:
            adapt(s.adaptation, kappas[0], along, x.boundary_error)
            adapt(s.adaptation, kappas[1], across, y.boundary_error)
        along, across, factors = common_demand(kappas[0], along), common_demand(kappas[1], across), directions.towards
    for i in range(out.size):
        sign = np.sign(nominal[i].thrust_coefficient)
        out[i].demand = sign * (factors[i, 0] * along + factors[i, 1] * across)
