"""Faults over arrays of time, eq. (16): ``delivered = effectiveness * wanted + stuck``."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from umbilical.plant.signals import Array, Side, passed, reached
from umbilical.scenario.faults import Dead, Fault, Intermittent, Partial, Ramp, Stuck

Target = Literal["thrust", "voltage"]


def effect(
    faults: Iterable[Fault], motor: int, target: Target, t: ArrayLike, side: Side = "right"
) -> tuple[Array, Array]:
    """What the faults leave of one motor's thrust (or drive voltage), eq. (16).

    Args:
        faults: timeline of the scenario.
        motor: number of the motor, from 1.
        target: "thrust" for the signed square of the speed, "voltage" for the drive.
        t: instants, s, any shape.
        side: the limit to take exactly where a fault starts or ends.

    Returns:
        Effectiveness (1: healthy; faults that overlap multiply) and the value a stuck motor delivers
        (rad2/s2 or V; 0 while it is not stuck), each of the shape of ``t``.

    >>> from umbilical.scenario.faults import Stuck
    >>> fault = Stuck(kind="stuck", motor=2, start=10.0, value=100.0)
    >>> [part.tolist() for part in effect([fault], 2, "thrust", [9.0, 10.0])]
    [[1.0, 0.0], [0.0, 100.0]]
    """
    instants = np.asarray(t, dtype=np.float64)
    effectiveness, stuck = np.ones(instants.shape), np.zeros(instants.shape)
    for fault in faults:
        if fault.motor == motor and fault.target == target:
            present = _present(fault, instants, side)
            effectiveness *= np.where(present, _share(fault, instants), 1.0)
            if isinstance(fault, Stuck):
                stuck += fault.value * present
    return effectiveness, stuck


def jumps(faults: Iterable[Fault], duration: float) -> tuple[float, ...]:
    """Published instants of the faults, increasing: where one starts, ends, or a ramp reaches its value.

    Args:
        faults: timeline of the scenario.
        duration: end of the run, s; later instants are left out.

    >>> from umbilical.scenario.faults import Intermittent
    >>> jumps([Intermittent(kind="intermittent", motor=1, start=1.0, cycle=2.0, duty=0.25)], 4.0)
    (1.0, 1.5, 3.0, 3.5)
    """
    instants = {float(instant) for fault in faults for instant in _instants(fault, duration)}
    return tuple(sorted(instant for instant in instants if instant <= duration))


def first_fault(faults: Iterable[Fault]) -> float | None:
    """Start of the earliest fault, s; None without faults.

    >>> first_fault([]) is None
    True
    """
    return min((fault.start for fault in faults), default=None)


def _present(fault: Fault, t: Array, side: Side) -> NDArray[np.bool_]:
    present = reached(t, fault.start, side)
    if fault.end is not None:
        present &= ~reached(t, fault.end, side)
    if isinstance(fault, Intermittent):
        present &= passed(_switches(fault, float(np.max(t, initial=0.0))), t, side) % 2 == 1
    return present


def _switches(fault: Intermittent, until: float) -> Array:
    """Instants at which an intermittent fault comes (even places) and goes (odd places), at least up to ``until``."""
    cycles = np.arange(max(np.ceil((until - fault.start) / fault.cycle), 0.0) + 1.0)
    come = fault.start + fault.cycle * cycles
    return np.stack([come, come + fault.duty * fault.cycle], axis=-1).ravel()


def _share(fault: Fault, t: Array) -> Array | float:
    match fault:
        case Partial() | Intermittent():
            return fault.effectiveness
        case Dead() | Stuck():
            return 0.0
        case Ramp():
            return 1.0 + (fault.effectiveness - 1.0) * np.clip((t - fault.start) / fault.over, 0.0, 1.0)


def _instants(fault: Fault, duration: float) -> Iterable[float]:
    ends = [fault.start] if fault.end is None else [fault.start, fault.end]
    until = duration if fault.end is None else min(duration, fault.end)
    match fault:
        case Ramp() if fault.end is None or fault.start + fault.over < fault.end:
            return [*ends, fault.start + fault.over]
        case Intermittent():
            return [*ends, *(switch for switch in _switches(fault, until) if switch <= until)]
        case _:
            return ends
