"""High-gain observer, eqs. (17), (19): the derivative of a measured signal.

::

    eps pi1' = pi2,   eps pi2' = -lam pi2 - pi1 + x,   estimate of x' = pi2/eps

From x to the estimate it is ``s / (eps^2 s^2 + lam eps s + 1)``. Linear, so it advances exactly for an
input held since the last sample. It starts at rest on the first sample: pi1 = x, pi2 = 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from umbilical.compile import kernel
from umbilical.control.linear import held_input_form
from umbilical.control.rates import outer_period
from umbilical.errors import Problem
from umbilical.frames import Frame, real
from umbilical.scenario.control import Control, HighGainObserver
from umbilical.scenario.findings import Finding, amount


class HighGainMemory(Frame):
    """What the observer remembers."""

    filtered_signal = real()
    filtered_rate = real()


class HighGain(NamedTuple):
    """Exact step ``pi <- form [pi, x]``, shape (2, 3); the estimate is pi2 / time_constant."""

    form: np.ndarray
    time_constant: float


def make_high_gain(record: HighGainObserver | None, period: float) -> HighGain:
    """Discrete form for one period; an absent observer gets an idle one."""
    eps = record.time_constant if record else 1.0
    damping = record.damping if record else 2.0
    a, b = np.array([[0.0, 1.0 / eps], [-1.0 / eps, -damping / eps]]), np.array([0.0, 1.0 / eps])
    return HighGain(held_input_form(a, b, period), eps)


@kernel
def start_high_gain(memory: HighGainMemory, signal: float) -> None:
    """Rest on the first sample."""
    memory.filtered_signal = signal
    memory.filtered_rate = 0.0


@kernel
def advance_high_gain(observer: HighGain, memory: HighGainMemory, signal: float) -> None:
    """One period with the sample held over it."""
    f, pi1, pi2 = observer.form, memory.filtered_signal, memory.filtered_rate
    memory.filtered_signal = f[0, 0] * pi1 + f[0, 1] * pi2 + f[0, 2] * signal
    memory.filtered_rate = f[1, 0] * pi1 + f[1, 1] * pi2 + f[1, 2] * signal


@kernel
def derivative_estimate(observer: HighGain, memory: HighGainMemory) -> float:
    """pi2/eps."""
    return memory.filtered_rate / observer.time_constant


def high_gain_observers(control: Control) -> Iterator[Finding]:
    """An observer that is sampled more rarely than it acts returns an estimate of the past."""
    period = outer_period(control)
    for name in control.law.observers:
        observer = getattr(control, name)
        if observer and observer.time_constant < 2.0 * period * (1.0 - 1e-9):
            yield Problem(
                f"control.{name}.time_constant",
                amount(observer.time_constant, "s"),
                f"at least {2.0 * period:g} s, two periods of the outer loop",
                "a sample older than half the observer's time makes its estimate lag more than it filters",
                "a larger time_constant, or a shorter control period",
            )
