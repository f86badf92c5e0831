"""Nyquist's count on a grid held against the eigenvalues of that grid's closed matrix, which knows no echo.

The matrix is real, so that gain and whole periods of delay can be put into it, a phase cannot.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from umbilical.stability.limits import Margins, delay_factor, gain_factor
from umbilical.stability.nyquist import Factor, Sweep, stability, unchanged
from umbilical.stability.period import LinearPeriod
from umbilical.stability.sampled import ON_THE_CIRCLE

BESIDE = 0.01
"""How far inside and outside of a limit of gain or delay both are asked, relative to it."""
INTEGRATOR = 1e-6
"""Eigenvalues as close to 1 are integrators."""
MOST_ELEMENTS = 32
"""Finest grid of which all eigenvalues are computed: some thousand, in half a second."""


class Counted(NamedTuple):
    """Unstable poles under one change of the loop: by Nyquist's count, by eigenvalues.

    Eigenvalues as close to the unit circle as :data:`ON_THE_CIRCLE` are ``undecided``: rounding moves them.
    """

    change: str
    nyquist: int
    eigenvalues: int
    undecided: int

    @property
    def agrees(self) -> bool:
        """Whether both count the same, undecided ones either way."""
        return self.eigenvalues <= self.nyquist <= self.eigenvalues + self.undecided


@dataclass(frozen=True)
class MatrixCheck:
    """Both counts of one grid, as it is and on either side of its limits.

    Attributes:
        elements: of the grid.
        states: of the closed matrix.
        counts: one for each change.
    """

    elements: int
    states: int
    counts: tuple[Counted, ...]

    @property
    def agrees(self) -> bool:
        """Whether both count the same under every change."""
        return all(count.agrees for count in self.counts)


def check_matrix(elements: int, period: LinearPeriod, echoed: Sweep, limits: Margins | None) -> MatrixCheck:
    """Ask both ways about one grid.

    Args:
        elements: of the grid.
        period: its matrices.
        echoed: the sweep with its echo.
        limits: its margins; None where it is unstable.
    """
    counts = [
        Counted(name, stability(echoed, factor).unstable, *unstable_eigenvalues(matrix))
        for name, factor, matrix in _changes(period, limits)
    ]
    return MatrixCheck(elements, period.a.shape[0] + period.law.a.shape[0], tuple(counts))


def _changes(period: LinearPeriod, limits: Margins | None) -> Iterator[tuple[str, Factor, LinearPeriod]]:
    yield "as it is", unchanged, period
    if limits is None:
        return
    for limit in (limits.gain_low.size, limits.gain_high.size):
        for gain in (limit * (1.0 - BESIDE), limit * (1.0 + BESIDE)):
            if 0.0 < limit < np.inf:
                yield f"{gain:.3g} times the thrust", gain_factor(gain), period.scaled(gain)
    if np.isfinite(limits.delay.size):
        limit = limits.delay.size / period.period
        for periods in (math.floor(limit * (1.0 - BESIDE)), math.ceil(limit * (1.0 + BESIDE))):
            delay = periods * period.period
            yield f"{1e3 * delay:.3g} ms later", delay_factor(delay), period.later(periods)


def unstable_eigenvalues(period: LinearPeriod) -> tuple[int, int]:
    """Eigenvalues of the closed loop outside the unit circle, and on it; that of D^ at 1 is known to be there."""
    poles = np.linalg.eigvals(period.closed)
    off = np.abs(poles) - 1.0
    undecided = (np.abs(off) <= ON_THE_CIRCLE) & (np.abs(poles - 1.0) > INTEGRATOR)
    return int((off > ON_THE_CIRCLE).sum()), int(undecided.sum())
