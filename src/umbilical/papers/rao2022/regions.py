"""Where something holds: counts of diverged runs, edges of stability, and where one arm overtakes the other."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical import Status, load, simulate
from umbilical.papers.rao2022.experiments import ARMS, GRIDS, OBSERVER, OBSERVERS, preset
from umbilical.papers.rao2022.ledger import WORDS, Edge, say, short
from umbilical.papers.rao2022.maps import GAIN_CASES, GAINS, gain_setting
from umbilical.papers.rao2022.progress import Progress
from umbilical.papers.rao2022.proofs import edge_between

if TYPE_CHECKING:
    import xarray

Place = tuple[str, str, str]
"""Case, arm and observer."""
HALVINGS = 5
"""Of a step between two gains of the scan, a factor of 1.26: the edge is then known to 0.8 per cent."""
NEAR = 1.03
"""Factor below and above an edge at which the grids are asked."""


def diverged(data: xarray.Dataset, arm: str) -> tuple[int, int]:
    """How many cells of a map diverged in an arm, and how many there are."""
    lost = np.isnan(data["peak"].sel(arm=arm).values)
    return int(lost.sum()), lost.size


def without_repeats(data: xarray.Dataset) -> xarray.Dataset:
    """A map with each run of fault control once: what the factors are believed to be means nothing to it."""
    return data.isel(believed_ratio=[0]) if "believed_ratio" in data.dims else data


def better(data: xarray.Dataset, arm: str, observer: str) -> np.ndarray:
    """In which cells of a map an arm has the lower peak than known factors."""
    peaks = data["peak"].sel(observer=observer)
    return (peaks.sel(arm=arm) < peaks.sel(arm="without")).values


def preset_row(data: xarray.Dataset, along: str) -> xarray.Dataset:
    """The cells of a map along one of its axes, the other number being that of the presets."""
    across, at = ("y", "paper_y") if data.attrs["x"] == along else ("x", "paper_x")
    return data.sel({data.attrs[across]: data.attrs[at]}, method="nearest")


def edges(gain: xarray.Dataset, progress: Progress | None = None) -> dict[Place, Edge]:
    """Least gain of the allocation at which the loop runs away, by case, arm and observer.

    Bisection between the last gain of the scan that stays and the first that does not; nan where all stay.
    """
    places: list[Place] = [*product(GAIN_CASES, ARMS, OBSERVERS)]
    found = {}
    with ThreadPoolExecutor() as pool:
        for place, one in zip(places, pool.map(partial(_edge, gain), places), strict=True):
            found[place] = one
            if progress:
                progress(len(found) / len(places))
    return found


def _edge(gain: xarray.Dataset, place: Place) -> Edge:
    peaks = gain["peak"].sel(dict(zip(("case", "arm", "observer"), place, strict=True))).values
    first = int(np.flatnonzero(np.isnan(peaks)).min(initial=len(GAINS) - 1))
    found = edge_between(lambda tried: not runs_away(place, tried), GAINS[max(first - 1, 0)], GAINS[first], HALVINGS)
    return Edge(found, bool(np.isfinite(found)) and same_on_grids(found, place))


def runs_away(place: Place, gain: float, elements: int = GRIDS[0]) -> bool:
    """Whether the loop runs away at a gain."""
    case, arm, observer = place
    grid = {"grid.elements": elements, OBSERVER: observer == "on"}
    scenario = load(preset(case, arm), {**grid, **gain_setting(case, arm, gain)})
    return simulate(scenario).status is not Status.COMPLETED


def same_on_grids(edge: float, place: Place) -> bool:
    """Whether the loop stays just below an edge and runs away just above it on every grid."""
    around = [(elements, gain) for elements in GRIDS for gain in (edge / NEAR, edge * NEAR)]
    return [runs_away(place, gain, elements) for elements, gain in around] == [False, True] * len(GRIDS)


def runaways(found: Mapping[Place, Edge], arm: str) -> dict[str, Any]:
    """The gains from which on the loop of an arm runs away, healthy and with a dead motor, and that in words."""
    prefixes = {"none": "edge", "dead": "edge_dead"}
    edges = {f"{prefixes[case]}_{obs}": found[case, arm, obs] for case, obs in product(GAIN_CASES, OBSERVERS)}
    values = {
        **{name: edge.gain for name, edge in edges.items()},
        "same": "the same" if all(edge.same for edge in edges.values()) else "NOT the same",
        "grids": list(map(str, GRIDS)),
        "near": NEAR - 1.0,
    }
    return values | {"runaways": say(WORDS["shared"]["runaways"], values)}


def reversal(gain: xarray.Dataset) -> dict[str, Any]:
    """Where, without a fault and with the observer, the adaptive arm is the better one: by gain at the start."""
    peaks = {arm: gain["peak"].sel(case="none", observer="on", arm=arm).values for arm in ARMS}
    gains = gain["gain"].values
    exact, adapted = (float(np.interp(0.0, np.log(gains), peaks[arm])) for arm in ARMS)
    preset_peak = float(np.interp(np.log(0.5), np.log(gains), peaks["with"]))
    start, belief = _crossing(gains, peaks["with"], exact), 1.0 / _crossing(gains, peaks["without"], preset_peak)
    bounds = {
        f"the adaptation starts below {short(start)} of the exact gain": start,
        f"the factors are believed less than {short(belief)} times too large": belief,
    }
    when = " and ".join(words for words, bound in bounds.items() if np.isfinite(bound))
    return {
        "start_gain": start,
        "belief_ratio": belief,
        "same_start": adapted / exact,
        "bounds": when or "the gain is one of the scan",
        "when": when,
    }


def _crossing(gains: np.ndarray, peaks: np.ndarray, level: float) -> float:
    """The gain at which falling peaks cross a level, along straight lines of logarithms; nan if they do not."""
    good = np.isfinite(peaks)
    x, y = np.log(gains[good]), np.log(peaks[good])
    below = np.flatnonzero(y < np.log(level))
    if not below.size or below[0] == 0:
        return float("nan")
    k = below[0]
    return float(np.exp(x[k - 1] + (np.log(level) - y[k - 1]) / (y[k] - y[k - 1]) * (x[k] - x[k - 1])))
