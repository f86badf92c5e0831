"""A grid that is fine enough for a scenario, found by runs.

The peaks at the ROV and at the midpoint on a grid are compared with those on twice and on four times its elements, and
with those on half its step; the least grid whose differences stay within the tolerance is taken, or three quarters of
its elements where they do as well. Where a front runs through the cable (a load that jumps, a fault) peaks converge at
first order only, and no grid that is tried may do: the finest that was compared is taken then, with what its error is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from umbilical.errors import ScenarioError
from umbilical.plant.checks.steps import chosen_step
from umbilical.scenario.scenario import Scenario

GRIDS = (4, 8, 16, 32, 64, 128, 256, 512)
"""Elements that are tried, one after the other; the last two are only compared with."""
WATCHED = ("tip_peak", "mid_peak")
NOTHING = 1e-9
"""m: a peak below it is rest, and has no relative error."""

Peaks = Mapping[str, float]
Measure = Callable[[Scenario], Any]
"""What gives the ``status`` of a run and its ``metrics``."""


class ChosenGrid(NamedTuple):
    """A grid and what is known of it.

    Attributes:
        elements: along the cable.
        step: of the plant, s.
        finest: the most elements that were compared with, at least four times those chosen.
        estimate: largest relative difference of a peak from finer grids, of twice the elements and more.
        tolerance: what was asked.
    """

    elements: int
    step: float
    finest: int
    estimate: float
    tolerance: float

    @property
    def reached(self) -> bool:
        """Whether the tolerance is kept."""
        return self.estimate <= self.tolerance

    def __str__(self) -> str:
        kept = "" if self.reached else f", which misses the tolerance of {self.tolerance:g}"
        return (
            f"grid: {self.elements} elements and a step of {self.step:g} s were chosen; the peaks at ROV and midpoint "
            f"are within {self.estimate:.1e} of those on {self.finest} elements{kept}"
        )


def choose_grid(scenario: Scenario, measure: Measure, progress: Callable[[float], None] | None = None) -> ChosenGrid:
    """The least grid of :data:`GRIDS`, or three quarters of it, on which the peaks are right within ``grid.tolerance``.

    Args:
        scenario: one with a tolerance.
        measure: how a run on a fixed grid ends, and its metrics.
        progress: called with the share of the grids that were tried.

    Raises:
        ScenarioError: not even the coarsest three grids are admitted.
    """
    tolerance = scenario.grid.tolerance
    assert tolerance is not None
    step = _fine_step(scenario, measure, 0.25 * tolerance)
    found: dict[int, Peaks] = {}

    def judged(elements: int, finer: tuple[int, ...]) -> ChosenGrid:
        peaks = found[elements] if elements in found else _peaks(scenario, measure, elements, step)
        error = max(peak_error(peaks, found[more]) for more in finer)
        return ChosenGrid(elements, _taken(scenario, elements, step), finer[-1], error, tolerance)

    choice = None
    for count, elements in enumerate(GRIDS):
        try:
            found[elements] = _peaks(scenario, measure, elements, step)
        except ScenarioError:  # too large for the machine, or too short a step
            if choice is None:
                raise
            break
        if progress:
            progress((count + 1) / len(GRIDS))
        if count < 2:
            continue
        finer = GRIDS[count - 1 : count + 1]
        choice = judged(GRIDS[count - 2], finer)
        if choice.reached:
            fewer = judged(3 * choice.elements // 4, finer) if count > 2 else choice
            return fewer if fewer.reached else choice
    assert choice is not None
    return choice


def on_chosen_grid(
    scenario: Scenario, measure: Measure, progress: Callable[[float], None] | None = None
) -> tuple[Scenario, tuple[str, ...]]:
    """A scenario with the grid it asks for, and what is to be said of it; itself where it names its grid."""
    if scenario.grid.tolerance is None:
        return scenario, ()
    choice = choose_grid(scenario, measure, progress)
    return with_grid(scenario, choice.elements, choice.step), (str(choice),)


def with_grid(scenario: Scenario, elements: int, step: float) -> Scenario:
    """A scenario on a grid that is no longer chosen."""
    return scenario.replace({"grid.elements": elements, "grid.step": step, "grid.tolerance": None})


def peak_error(peaks: Peaks, finer: Peaks) -> float:
    """Largest relative difference of a peak; infinite where one run ended otherwise than the other.

    >>> peak_error({"tip_peak": 1.0, "mid_peak": 0.0}, {"tip_peak": 1.25, "mid_peak": 1e-12})
    0.2
    """
    if peaks.keys() != finer.keys():
        return float("inf")
    return max((abs(peaks[name] - size) / size for name, size in finer.items() if size > NOTHING), default=0.0)


def _peaks(scenario: Scenario, measure: Measure, elements: int, step: float) -> Peaks:
    """The peaks of one run, under names that say whether it came to its end."""
    found = measure(with_grid(scenario, elements, step))
    return {f"{found.status.name} {name}": found.metrics[name] for name in WATCHED if name in found.metrics}


def _fine_step(scenario: Scenario, measure: Measure, tolerance: float, elements: int = GRIDS[2]) -> float:
    """A step whose half moves the peaks by no more than the tolerance."""
    step = scenario.grid.step
    peaks = _peaks(scenario, measure, elements, step)
    for _ in range(4):
        step_taken = _taken(scenario, elements, step)
        halved = _peaks(scenario, measure, elements, step_taken / 2)
        if peak_error(peaks, halved) <= tolerance:
            return step
        step, peaks = step_taken / 2, halved
    return step


def _taken(scenario: Scenario, elements: int, step: float) -> float:
    return chosen_step(with_grid(scenario, elements, step))
