"""The same margins with what the engine's own grids return, at several resolutions, and whether they are resolved.

The readings of the ROV on a grid, one sparse solve for each frequency, tell the echo that this grid returns.
It replaces the exact echo in Nyquist's count, which on a coarse grid is held against the eigenvalues of the closed
matrix (:mod:`umbilical.stability.matrix`). The grid is resolved where stability is the same and every margin is within
:data:`CLOSE` of the exact one (:data:`NEAR` on the next coarser grid), or of loops that are unstable both ways the
number of poles and the fastest growth; where it is not, the verdict is that nothing is resolved.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from umbilical.plant.multistep import courant_limit
from umbilical.scenario.scenario import Scenario
from umbilical.stability.impedance import hanging_cable, waves_at_rov
from umbilical.stability.judgement import Judgement
from umbilical.stability.limits import Margins, find_limits
from umbilical.stability.matrix import MOST_ELEMENTS, MatrixCheck, check_matrix
from umbilical.stability.nyquist import Stability, Sweep, stability
from umbilical.stability.period import LinearPeriod, linear_period
from umbilical.stability.sampled import alias_sum

CLOSE, NEAR = 0.02, 0.08
"""Largest relative difference of a margin on the finest grid and on the next coarser one. Elements twice as long make
an error of second order four times as large; those of the plant are of higher order."""
POINTS = 80
"""Frequencies at which a grid is asked first; between them its echo over the exact one is a spline,
whose ripple, a per mille of false reflection at the ROV, has the spacing of the modes."""
FORETOLD, FORETOLD_DAMPED = 3e-5, 1e-2
"""How well the spline foretells a grid's echo in the middle between two frequencies, where the exact echo is 1 and
where it is 0; more are asked where it does not. A cable without damping has modes that a few parts in a hundred
thousand make grow; a damped one has not."""
REFINEMENTS = 8
SILENT = 1e-3
"""Share of the exact echo below which a grid's says nothing any more."""
FAINT = 0.02
"""Size of the exact echo below which a grid is not asked: what it adds there of its own is a reflection at the ROV, of
some per cent, which is no echo and does not fade with the cable's damping."""
WAVE_ELEMENTS = 0.25
"""Elements in one wave at the highest frequency a grid is asked for: it carries none of those waves."""
SAMPLES = 12.0
"""Samples of the outer law in one turn of that frequency at least: above it the held thrust hides the grid."""


class GridDifference(NamedTuple):
    """What differs most between a grid and the exact cable: its name, the value of each, how much relatively."""

    name: str
    grid: float
    exact: float
    size: float


@dataclass(frozen=True)
class GridJudgement:
    """The loop on one grid.

    Attributes:
        elements: along the cable.
        stability, margins: as in :class:`~umbilical.stability.judgement.Judgement`.
        differs: what is furthest from the exact cable.
        heard: highest frequency at which the grid returns at least half of the exact echo, rad/s.
    """

    elements: int
    stability: Stability
    margins: Margins | None
    differs: GridDifference
    heard: float

    @property
    def difference(self) -> float:
        """Largest relative difference from the exact cable; infinite if one loop is stable and one is not."""
        return self.differs.size


def margins_on_grid(scenario: Scenario, exact: Judgement, elements: int) -> GridJudgement:
    """The loop of an exact judgement on a grid of so many elements."""
    return _judge_grid(on_grid(scenario, exact.length, elements), exact)


def check_count(scenario: Scenario, exact: Judgement, elements: Sequence[int]) -> MatrixCheck:
    """Nyquist's count on the coarsest of some grids, or a coarse one, against the eigenvalues of its matrix."""
    coarse = on_grid(scenario, exact.length, min(*elements, MOST_ELEMENTS))
    period = linear_period(coarse, exact.sweep.loop, exact.length)
    echoed, _ = with_grid_echo(exact.sweep, period, coarse.grid.elements)
    limits = find_limits(echoed) if stability(echoed).unstable == 0 else None
    return check_matrix(coarse.grid.elements, period, echoed, limits)


def on_grid(scenario: Scenario, length: float, elements: int) -> Scenario:
    """The scenario with so many elements, and a step that the cable of this length, m, allows on them."""
    cable, period = hanging_cable(scenario, length), scenario.control.period
    allowed = 0.8 * courant_limit() * length / elements / cable.top_wave_speed
    step = period / np.ceil(period / min(allowed, scenario.grid.step) - 1e-9)
    return scenario.replace({"grid.elements": elements, "grid.step": float(step)})


def resolved(grids: Sequence[GridJudgement]) -> bool:
    """Whether the two finest grids, or the only one, come to what the exact cable says."""
    return grids[-1].difference <= CLOSE and all(grid.difference <= NEAR for grid in grids[-2:])


def _judge_grid(scenario: Scenario, exact: Judgement) -> GridJudgement:
    swept = exact.sweep
    period = linear_period(scenario, swept.loop, exact.length)
    echoed, heard = with_grid_echo(swept, period, scenario.grid.elements)
    found = stability(echoed)
    limits = find_limits(echoed) if found.unstable == 0 else None
    return GridJudgement(scenario.grid.elements, found, limits, _differs(found, limits, exact), heard)


def _differs(found: Stability, limits: Margins | None, exact: Judgement) -> GridDifference:
    if (limits is None) != (exact.margins is None):
        return GridDifference("unstable poles", found.unstable, exact.stability.unstable, np.inf)
    one, other = (_numbers(*pair) for pair in ((found, limits), (exact.stability, exact.margins)))
    apart = (GridDifference(name, one.get(name, 0.0), x, _apart(one.get(name, 0.0), x)) for name, x in other.items())
    return max(apart, key=lambda difference: difference.size)


def _numbers(found: Stability, limits: Margins | None) -> dict[str, float]:
    """What is compared: margins, or of an unstable loop its poles and the growth that is fastest."""
    if limits:
        return {name: getattr(limits, name).size for name in ("gain_low", "gain_high", "phase", "delay")}
    numbers = {"unstable poles": float(found.unstable)}
    if found.worst:
        numbers |= {"frequency that grows": found.worst.frequency, "rate of growth": found.worst.rate}
    return numbers


def _apart(one: float, other: float) -> float:
    """Relative difference; 1 where one of them is no limit at all, 0 or infinite."""
    if one == other:
        return 0.0
    return abs(one - other) / abs(other) if other and np.isfinite([one, other]).all() else 1.0


def with_grid_echo(swept: Sweep, period: LinearPeriod, elements: int) -> tuple[Sweep, float]:
    """The sweep with the echo that a grid returns, and the highest frequency of which half comes back, rad/s.

    Above the last frequency that says something, the share of the exact echo stays as large as it is there.
    """
    from scipy.interpolate import CubicSpline

    w, ratio = _followed(swept, period, _ends(swept, elements))
    half = np.abs(ratio) < 0.5
    heard = float(w[np.argmax(half)]) if half.any() else float(w[-1])
    within = CubicSpline(np.log(w), ratio)(np.log(np.clip(swept.w, w[0], w[-1])))
    return replace(swept, echo=swept.echo * np.where(swept.w <= w[-1], within, np.abs(ratio[-1]))), heard


def _ends(swept: Sweep, elements: int) -> tuple[float, float]:
    """Lowest and highest frequency at which a grid is asked, rad/s."""
    cable = swept.cable
    shortest = WAVE_ELEMENTS * cable.length / elements
    highest = min(2.0 * np.pi * cable.tip_wave_speed / shortest, 2.0 * np.pi / (SAMPLES * swept.loop.outer_period))
    audible = swept.w[(np.abs(swept.echo) >= FAINT) & (swept.w <= highest)]
    return float(swept.w[0]), float(audible[-1] if audible.size else swept.w[1])


def _followed(swept: Sweep, period: LinearPeriod, ends: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """A grid's echo over the exact one at frequencies close enough for a spline, up to where it is silent."""
    from scipy.interpolate import CubicSpline

    def ask(w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        exact = waves_at_rov(swept.cable, 1j * w).echo
        return grid_echo(swept, period, w) / exact, np.abs(exact)

    w = np.geomspace(*ends, POINTS)
    values, _ = ask(w)
    last = 1 + int(np.argmax(np.abs(values) < SILENT)) if (np.abs(values) < SILENT).any() else POINTS
    w, values = w[:last], values[:last]
    unsure = np.ones(w.size - 1, dtype=bool)
    for _ in range(REFINEMENTS):
        middle = np.sqrt(w[:-1] * w[1:])[unsure]
        new, loud = ask(middle)
        allowed = FORETOLD + FORETOLD_DAMPED * (1.0 - np.minimum(loud, 1.0)) ** 2
        missed = loud * np.abs(CubicSpline(np.log(w), values)(np.log(middle)) - new) > allowed
        places = np.flatnonzero(unsure) + 1
        w, values = np.insert(w, places, middle), np.insert(values, places, new)
        unsure = np.isin(w[:-1], middle[missed]) | np.isin(w[1:], middle[missed])
        if not unsure.any():
            break
    return w, values


def grid_echo(swept: Sweep, period: LinearPeriod, w: np.ndarray) -> np.ndarray:
    """The echo at frequencies, rad/s, from the ratio of displacement and slope that the ROV reads."""
    cable, p = swept.cable, 1j * w
    met = waves_at_rov(cable, p)
    late = np.exp(-p[:, None] * np.array(swept.loop.ages[:2]))
    seen = (period.plant(w) - alias_sum(cable, swept.loop, p))[:, :2] / late
    pull = cable.tip_tension * seen[:, 1] / seen[:, 0]
    return -(met.up + pull) / (met.down + pull)
