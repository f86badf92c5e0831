"""What the table knows of a force, and what all forces along the cable share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import kernel, row_kernel
from umbilical.plant import orbital
from umbilical.scenario.environment import Environment
from umbilical.scenario.scenario import Scenario


class Decay(NamedTuple):
    """How fast a force takes velocity at most, for the step limit.

    Attributes:
        key: of the scenario, that a user turns.
        coefficient: N s/m2 per metre of cable, or N s/m on the ROV.
        unit: of the coefficient.
        inertia: what it slows, kg/m or kg.
    """

    key: str
    coefficient: float
    unit: str
    inertia: float


def no_decay(**_: Any) -> None:
    """A force that takes no velocity."""
    return


def no_change(scenario: Scenario, water: np.ndarray) -> float:
    """A force that does not change with the velocity, or not with the displacement."""
    return 0.0


class Force(NamedTuple):
    """What the table knows of a force beside its kernels.

    Attributes:
        work: channel of its work.
        on: "cable" or "payload".
        damping: minus its derivative by the velocity of a cable at rest, the winch stopped: N s/m2 at places along the
            cable, or a number; N s/m on the ROV. ``water`` passes at these places, m/s, last at the ROV.
        decay: the most it takes, from sections of a scenario by name; None where it takes nothing.
        stiffness: minus its derivative by the displacement of the ROV there, N/m; of a force on the ROV.
    """

    work: str
    on: str = "cable"
    damping: Callable[[Scenario, np.ndarray], Any] = no_change
    decay: Callable[..., Decay | None] = no_decay
    stiffness: Callable[[Scenario, np.ndarray], float] = no_change


@kernel
def begin_work(power: np.ndarray, work: np.ndarray, half: float) -> None:
    """First half of the work of every element; its new power starts from nothing."""
    for e in range(power.size):
        work[e] += half * power[e]
        power[e] = 0.0


@row_kernel
def add_power(work: np.ndarray, power: np.ndarray, time: float) -> None:
    """work += power * time, along a row."""
    for k in range(work.size):
        work[k] += time * power[k]


def fastest_current(environment: Environment) -> float:
    """Largest speed of the current's profile and of the waves' motion, m/s; how the former varies is not in it."""
    current = environment.water.current if environment.water else None
    return (max(map(abs, current.speeds)) if current else 0.0) + orbital.fastest(environment)
