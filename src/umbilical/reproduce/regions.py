"""Where something holds: counts of diverged runs, edges of stability, and where one arm overtakes the other."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from umbilical.reproduce.experiments import ARMS, OBSERVERS
from umbilical.reproduce.ledger import Kind, Number, percent, short
from umbilical.reproduce.points import GRID, Changes, gain_point, run_points
from umbilical.reproduce.work import Progress

if TYPE_CHECKING:
    import xarray

HALVINGS = 5
"""Of a step between two gains of the scan, a factor of 1.19: the edge is then known to half a per cent."""
GRIDS = (8, 16, 64)
"""Numbers of elements on which an edge must be the same."""
NEAR = 1.03
"""Factor below and above an edge at which the grids are asked."""


class Region(NamedTuple):
    """Numbers, what they say, and what completes "only when" where they bound the claim."""

    numbers: tuple[Number, ...]
    words: str
    when: str = ""


def diverged(data: xarray.Dataset, arm: str) -> tuple[int, int]:
    """How many cells of a map diverged in an arm, and how many there are."""
    lost = np.isnan(data["peak"].sel(arm=arm).values)
    return int(lost.sum()), lost.size


def edges(gain: xarray.Dataset, progress: Progress | None = None) -> dict[str, float]:
    """Least gain of the allocation at which the loop runs away, no fault, by ``arm, observer``.

    Bisection between the last gain of the scan that stays and the first that does not; nan where all stay.
    """
    places = {(arm, observer): _bracket(gain.sel(arm=arm, observer=observer)) for arm in ARMS for observer in OBSERVERS}
    for step in range(HALVINGS):
        middles = {place: float(np.sqrt(low * high)) for place, (low, high) in places.items() if np.isfinite(high)}
        points = {place: gain_point(place[1], "none", place[0], middle) for place, middle in middles.items()}
        found = run_points(points.values())
        for place, middle in middles.items():
            low, high = places[place]
            places[place] = (low, middle) if np.isnan(found[points[place]].peak) else (middle, high)
        if progress:
            progress((step + 1) / HALVINGS)
    return {
        f"{arm}, {observer}": high if np.isfinite(high) else float("nan")
        for (arm, observer), (_, high) in places.items()
    }


def _bracket(gain: xarray.Dataset) -> tuple[float, float]:
    """The last gain that stays before the first that runs away, and that one."""
    peaks, gains = gain["peak"].sel(case="none").values, gain["gain"].values
    lost = np.flatnonzero(np.isnan(peaks))
    if not lost.size:
        return float(gains[-1]), float("inf")
    return float(gains[max(lost[0] - 1, 0)]), float(gains[lost[0]])


def same_on_grids(edge: float, arm: str, observer: str) -> bool:
    """Whether the loop stays just below an edge and runs away just above it on every grid."""
    points = [gain_point(observer, "none", arm, edge * factor) for factor in (1.0 / NEAR, NEAR)]
    grids: list[Changes] = [{**GRID, "grid.elements": elements} for elements in GRIDS]
    found = [[np.isnan(outcome.peak) for outcome in run_points(points, grid=grid).values()] for grid in grids]
    return all(lost == [False, True] for lost in found)


def runaways(found: Mapping[str, float], arm: str) -> Region:
    """The gains from which on the loop of an arm runs away, with and without the disturbance observer."""
    names = {f"edge_{observer}": found[f"{arm}, {observer}"] for observer in OBSERVERS}
    meaning = "gain from which on it runs away, no fault, observer {}"
    numbers = tuple(
        Number(name, value, "1", meaning.format(name.removeprefix("edge_")), Kind.EDGE) for name, value in names.items()
    )
    on, off = (names[f"edge_{observer}"] for observer in OBSERVERS)
    same = bool(found.get("same on grids", False))
    words = (
        f"What does drive it apart is a gain that is too large, before any fault: factors believed {short(on)} times "
        "too "
        f"small, {short(off)} times without the observer "
        f"({'the same' if same else 'NOT the same'} on {', '.join(map(str, GRIDS))} elements)."
    )
    return Region(numbers, words)


def reversal(gain: xarray.Dataset) -> Region:
    """Where, without a fault and with the observer, the adaptive arm is the better one: by gain at the start."""
    peaks = gain["peak"].sel(case="none", observer="on")
    gains = gain["gain"].values
    exact = float(np.interp(0.0, np.log(gains), peaks.sel(arm="without").values))
    preset = float(np.interp(np.log(0.5), np.log(gains), peaks.sel(arm="with").values))
    start = _crossing(gains, peaks.sel(arm="with").values, exact)
    belief = 1.0 / _crossing(gains, peaks.sel(arm="without").values, preset)
    same = float(np.interp(0.0, np.log(gains), peaks.sel(arm="with").values)) / exact
    numbers = (
        Number("start_gain", start, "1", "gain at the start from which on fault control is better", Kind.EDGE),
        Number("belief_ratio", belief, "1", "believed over true factors from which on it is better", Kind.EDGE),
        Number("same_start", same, "1", "peak with over without fault control, both starting at the exact gain"),
    )
    bounds = [
        *([f"the adaptation starts below {short(start)} of the exact gain"] if np.isfinite(start) else []),
        *([f"the factors are believed less than {short(belief)} times too large"] if np.isfinite(belief) else []),
    ]
    words = (
        f"It holds while {' and '.join(bounds) or 'the gain is one of the scan'}. Started at the exact gain, fault "
        "control "
        f"leaves {percent(same)} of the peak that known factors leave: what is compared is less two laws than two "
        "gains, "
        "and a larger gain leaves a smaller peak until the loop runs away."
    )
    return Region(numbers, words, " and ".join(bounds))


def _crossing(gains: np.ndarray, peaks: np.ndarray, level: float) -> float:
    """The gain at which falling peaks cross a level, along straight lines of logarithms; nan if they do not."""
    good = np.isfinite(peaks)
    x, y = np.log(gains[good]), np.log(peaks[good])
    below = np.flatnonzero(y < np.log(level))
    if not below.size or below[0] == 0:
        return float("nan")
    k = below[0]
    return float(np.exp(x[k - 1] + (np.log(level) - y[k - 1]) / (y[k] - y[k - 1]) * (x[k] - x[k - 1])))
