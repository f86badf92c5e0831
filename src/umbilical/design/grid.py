"""The same margins from the engine's own matrices, at several resolutions, and whether they are resolved.

The readings of the ROV on a grid, one sparse solve for each frequency, tell the echo that this grid returns.
It replaces the exact echo in Nyquist's count. The grid is resolved where stability is the same and every margin
is within :data:`CLOSE` of the exact one; where it is not, the exact impedance decides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from umbilical.analysis.impedance import waves
from umbilical.analysis.limits import Margins, margins
from umbilical.analysis.margins import Judgement
from umbilical.analysis.nyquist import Stability, Sweep, stability
from umbilical.analysis.sampled import alias_sum
from umbilical.design.period import LinearPeriod, linear_period
from umbilical.plant.multistep import courant_limit
from umbilical.scenario.scenario import Scenario

CLOSE = 0.02
"""Largest relative difference of a margin that counts as agreement."""
POINTS = 160
"""Frequencies at which the grid is asked; between them its echo over the exact one is smooth."""
SILENT = 1e-3
"""Size below which an echo says nothing any more."""


@dataclass(frozen=True)
class GridJudgement:
    """The loop on one grid.

    Attributes:
        elements: along the cable.
        stability, margins: as in :class:`~umbilical.analysis.margins.Judgement`.
        difference: largest relative difference of a margin from the exact one; infinite if stability differs.
        heard: highest frequency at which the grid returns at least half of the exact echo, rad/s.
    """

    elements: int
    stability: Stability
    margins: Margins | None
    difference: float
    heard: float


def judge_grids(scenario: Scenario, exact: Judgement, elements: Sequence[int]) -> tuple[GridJudgement, ...]:
    """The loop of an exact judgement on grids of so many elements."""
    return tuple(_judge_grid(on_grid(scenario, exact.length, number), exact) for number in elements)


def on_grid(scenario: Scenario, length: float, elements: int) -> Scenario:
    """The scenario with so many elements, and a step that the cable of this length, m, allows on them."""
    cable, payload, period = scenario.cable, scenario.payload, scenario.control.period
    top = (payload.mass + cable.hanging_density * length) * scenario.environment.gravity
    allowed = 0.8 * courant_limit() * length / elements / np.sqrt(top / cable.line_density)
    step = period / np.ceil(period / min(allowed, scenario.grid.step) - 1e-9)
    return scenario.replace({"grid.elements": elements, "grid.step": float(step)})


def resolved(grids: Sequence[GridJudgement]) -> bool:
    """Whether the two finest grids say what the exact cable says."""
    return len(grids) >= 3 and all(grid.difference <= CLOSE for grid in grids[-2:])


def _judge_grid(scenario: Scenario, exact: Judgement) -> GridJudgement:
    swept = exact.sweep
    echoed, heard = with_grid_echo(swept, linear_period(scenario, swept.loop, exact.length))
    found = stability(echoed)
    limits = margins(echoed) if found.unstable == 0 else None
    return GridJudgement(scenario.grid.elements, found, limits, difference(limits, exact.margins), heard)


def difference(one: Margins | None, other: Margins | None) -> float:
    """Largest relative difference of two sets of margins; infinite where one loop is stable and one is not."""
    if one is None and other is None:
        return 0.0
    if one is None or other is None:
        return np.inf
    names = ("gain_low", "gain_high", "phase", "delay")
    return max(_apart(getattr(one, name).size, getattr(other, name).size) for name in names)


def _apart(one: float, other: float) -> float:
    return 0.0 if one == other else abs(one - other) / max(abs(other), 1e-12)


def with_grid_echo(swept: Sweep, period: LinearPeriod) -> tuple[Sweep, float]:
    """The sweep with the echo that a grid returns, and the highest frequency of which half comes back, rad/s."""
    w = np.geomspace(swept.w[0], swept.w[-1], POINTS)
    ratio = grid_echo(swept, period, w) / waves(swept.cable, 1j * w).echo
    quiet = np.abs(ratio) < SILENT
    last = int(np.argmax(quiet)) if quiet.any() else POINTS
    angle = np.unwrap(np.angle(ratio[:last]))
    size = np.interp(np.log(swept.w), np.log(w[:last]), np.log(np.abs(ratio[:last])), right=-np.inf)
    turn = np.interp(np.log(swept.w), np.log(w[:last]), angle)
    half = np.abs(ratio) < 0.5
    heard = float(w[np.argmax(half)]) if half.any() else float(w[-1])
    return replace(swept, echo=swept.echo * np.exp(size + 1j * turn)), heard


def grid_echo(swept: Sweep, period: LinearPeriod, w: np.ndarray) -> np.ndarray:
    """The echo at frequencies, rad/s, from the ratio of displacement and slope that the ROV reads."""
    cable, p = swept.cable, 1j * w
    met = waves(cable, p)
    late = np.exp(-p[:, None] * np.array(swept.loop.ages[:2]))
    seen = (period.plant(w) - alias_sum(cable, swept.loop, p))[:, :2] / late
    pull = cable.tip_tension * seen[:, 1] / seen[:, 0]
    return -(met.up + pull) / (met.down + pull)
