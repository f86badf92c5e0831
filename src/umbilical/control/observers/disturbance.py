"""Disturbance observer of the ROV, eq. (21).

::

    D^ = phi + k_s m x2^,   phi' = k_s (vs u_a + T z1 + c_tip x2^ - alpha_c - D^)

so that D^' = k_s (D - D^ + vs u_a) when x2^ is exact. It is driven by the commanded thrust: what the
motors fail to deliver is part of D.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import exp
from typing import NamedTuple

from umbilical.compile import kernel
from umbilical.control.rates import outer_period, within_a_period
from umbilical.frames import Frame, real
from umbilical.scenario.control import Control, DisturbanceObserver
from umbilical.scenario.findings import Finding


class DisturbanceMemory(Frame):
    """What the observer remembers."""

    disturbance_state = real()


class Disturbance(NamedTuple):
    """Gain k_s (1/s), coupling vs (kg/s), decay over one period; ``enabled`` 0 gives an estimate of 0."""

    enabled: bool
    gain: float
    coupling: float
    decay: float


def make_disturbance(record: DisturbanceObserver | None, period: float) -> Disturbance:
    """Discrete form for one period; an absent observer estimates nothing."""
    if record is None or not record.enabled:
        return Disturbance(False, 0.0, 0.0, 1.0)
    return Disturbance(True, record.gain, record.coupling, exp(-record.gain * period))


@kernel
def start_disturbance(observer: Disturbance, memory: DisturbanceMemory, mass: float, velocity: float) -> None:
    """phi such that the estimate starts at 0."""
    memory.disturbance_state = -observer.gain * mass * velocity


@kernel
def advance_disturbance(
    observer: Disturbance, memory: DisturbanceMemory, mass: float, velocity: float, error: float, known_force: float
) -> None:
    """One period. ``known_force`` is T z1 + c_tip x2^ - alpha_c, with the command that was held over it, N."""
    drive = observer.coupling * error + known_force - observer.gain * mass * velocity
    memory.disturbance_state = observer.decay * memory.disturbance_state + (1.0 - observer.decay) * drive


@kernel
def disturbance_estimate(observer: Disturbance, memory: DisturbanceMemory, mass: float, velocity: float) -> float:
    """D^, N."""
    return memory.disturbance_state + observer.gain * mass * velocity if observer.enabled else 0.0


def disturbance_observer(control: Control) -> Iterator[Finding]:
    """The estimate D^ moves towards D, not past it."""
    observer = control.disturbance_observer
    if control.law.meets_force and observer and observer.enabled:
        yield from within_a_period(
            "control.disturbance_observer.gain", observer.gain, "1/s", 1.0, outer_period(control)
        )
