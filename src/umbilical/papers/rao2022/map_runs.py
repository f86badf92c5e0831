"""Single runs of a map: only the peak is kept, and each distinct one is made once.

Thousands of runs, so on a coarser grid than the figures: :data:`GRID`. With the paper's ``beta`` the ROV hardly
feels the grid; tests/papers compare coarse peaks with those of the default grid.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from umbilical import Status, load
from umbilical.engine.simulate import measure
from umbilical.papers.rao2022.experiments import BELIEVED, OBSERVER, START, preset
from umbilical.papers.rao2022.progress import Progress
from umbilical.studies.engines import in_order

GRID: dict[str, Any] = {"grid.elements": 8}
EARLY = {"faults.1.start": 0.1}
"""A fault so early that it comes before a loop runs away, in scans of the gain."""
FACTORS = (1.2, 0.8)
"""True thrust factors of the presets, N s2/rad2."""
EXACT = 1.0 / sum(FACTORS)
"""kappa_0 that delivers what is commanded, rad2/(N s2)."""
Changes = Mapping[str, Any]


class Point(NamedTuple):
    """One run of a map, so written that equal runs are equal."""

    preset: str
    changes: tuple[tuple[str, Any], ...]


class Outcome(NamedTuple):
    """What is kept of it: the peak (m; not a number where the run diverged), and when it ended (s)."""

    peak: float
    end: float


def make_point(name: str, observer: str, changes: Changes) -> Point:
    """A run of a preset with the disturbance observer ``on`` or ``off`` and some changes."""
    return Point(name, tuple(sorted({OBSERVER: observer == "on", **changes}.items())))


def gain_point(observer: str, case: str, arm: str, gain: float) -> Point:
    """The allocation at ``gain`` times its exact gain: by the believed factors, or the start of the adaptation."""
    changes = {} if case == "none" else dict(EARLY)
    if arm == "with":
        return make_point(preset(case, arm), observer, {START: (gain / sum(FACTORS), 0.0, 0.0), **changes})
    return make_point(preset(case, arm), observer, {BELIEVED: tuple(k / gain for k in FACTORS), **changes})


def run_points(points: Iterable[Point], progress: Progress | None = None, grid: Changes = GRID) -> dict[Point, Outcome]:
    """Outcome of every distinct point, on all cores.

    Args:
        points: what to run.
        progress: called with the share done, 0 to 1.
        grid: the discretisation, by dotted key.
    """
    distinct = list(dict.fromkeys(points))
    bases = {name: load(name, grid) for name in sorted({point.preset for point in distinct})}

    def outcome(point: Point) -> Outcome:
        found = measure(bases[point.preset].replace(dict(point.changes)))
        peak = found.metrics.get("tip_peak_after_fault", found.metrics["tip_peak"])
        return Outcome(peak if found.status is Status.COMPLETED else float("nan"), found.end_time)

    return dict(zip(distinct, in_order(outcome, distinct, progress), strict=True))
