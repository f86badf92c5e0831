"""Maps: the peak of the ROV after a fault over two numbers at a time, and over the gain of the allocation."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.papers.rao2022.experiments import ARMS, BELIEVED, BOX, OBSERVERS, RATES, START, preset
from umbilical.papers.rao2022.map_runs import FACTORS, Changes, Outcome, Point, gain_point, make_point, run_points
from umbilical.papers.rao2022.progress import Progress

if TYPE_CHECKING:
    import xarray

BOXED = "boxed"
RIM = BOX["control.allocation.upper"][0]
PRESET_RATES = (0.1, 100.0, 100.0)
Place = tuple[str | float, ...]


@dataclass(frozen=True)
class Axis:
    """One number that is varied; ``paper`` is its value in the presets."""

    name: str
    meaning: str
    values: tuple[float, ...]
    paper: float
    unit: str = "1"
    scale: str = "linear"

    def coordinate(self) -> tuple[str, list[float], dict[str, str]]:
        """As xarray takes it."""
        words = {"units": self.unit, "long_name": self.meaning, "scale": self.scale, "symbol": ""}
        return self.name, list(self.values), words


@dataclass(frozen=True)
class Slice:
    """Two numbers varied over a fault; ``setting`` says what an arm runs at (x, y), as preset and changes."""

    name: str
    title: str
    x: Axis
    y: Axis
    setting: Callable[[str, float, float], tuple[str, Changes]]
    arms: tuple[str, ...] = ARMS

    def points(self) -> Iterator[tuple[Place, Point]]:
        """Every place (observer, arm, y, x) with its run."""
        for observer, arm, y, x in product(OBSERVERS, self.arms, self.y.values, self.x.values):
            name, changes = self.setting(arm, x, y)
            yield (observer, arm, y, x), make_point(name, observer, changes)


def _steps(low: float, high: float) -> tuple[float, ...]:
    return tuple(float(v) for v in np.round(np.linspace(low, high, 15), 10))


def _powers(base: float, ratio: float, below: int, count: int = 15) -> tuple[float, ...]:
    return tuple(float(base * ratio**k) for k in range(-below, count - below))


def _failing(arm: str, instant: float, effectiveness: float) -> tuple[str, Changes]:
    return preset("partial", arm), {"faults.1.start": instant, "faults.1.effectiveness": effectiveness}


def _stuck(arm: str, ratio: float, value: float) -> tuple[str, Changes]:
    """Fault control uses no factors, so the ratio means nothing to it and one run serves a whole row."""
    changes: dict[str, Any] = {"faults.1.value": value}
    if arm == "without":
        return preset("stuck", arm), changes | {BELIEVED: tuple(k * ratio for k in FACTORS)}
    return preset("stuck", "with"), changes | (BOX if arm == BOXED else {})


def _adapting(arm: str, factor: float, start: float) -> tuple[str, Changes]:
    """Without fault control nothing adapts: one run serves the whole map. A start above the box is put on its rim."""
    if arm == "without":
        return preset("dead", arm), {}
    boxed = arm == BOXED
    changes = {RATES: tuple(k * factor for k in PRESET_RATES), START: (min(start, RIM) if boxed else start, 0.0, 0.0)}
    return preset("dead", "with"), changes | (BOX if boxed else {})


SLICES = (
    Slice(
        "map-time",
        "Loss of thrust by the instant of the fault",
        Axis("fault_start", "instant of the fault", _steps(1.0, 43.0), 10.0, "s"),
        Axis("effectiveness", "effectiveness left", _steps(0.0, 1.0), 0.5),
        _failing,
    ),
    Slice(
        "map-factors",
        "Stuck value by the error of the known factors",
        Axis("believed_ratio", "believed / true factors", _powers(1.0, 2.0 ** (1 / 7), 7), 1.0, scale="log"),
        Axis("stuck_value", "stuck value", _steps(-700.0, 700.0), 100.0, "rad2/s2"),
        _stuck,
        (*ARMS, BOXED),
    ),
    Slice(
        "map-rates",
        "Start of the adaptation by its rate, motor 2 dead",
        Axis("rate_ratio", "rates / those of the preset", _powers(1.0, 10.0 ** (1 / 3), 6), 1.0, scale="log"),
        Axis("kappa_start", r"$\kappa_0(0)$", _powers(0.25, 2.0**0.5, 6), 0.25, "rad2/(N s2)", scale="log"),
        _adapting,
        (*ARMS, BOXED),
    ),
)

GAINS = _powers(1.0, 2.0 ** (1 / 3), 6, 17)
"""Gain of the allocation at the start, sum of the true thrust factors times kappa_0: 1 is exact."""
GAIN_CASES = ("none", "dead")
GAIN = "gain"
"""Name of the scan, which is made with and without the maps."""
MAPS = tuple(one.name for one in SLICES)
NAMES = (*MAPS, GAIN)


def compute_maps(names: Collection[str] = NAMES, progress: Progress | None = None) -> dict[str, xarray.Dataset]:
    """The scan of the gain and the maps of these names, by name."""
    chosen = [one for one in SLICES if one.name in names]
    places = {one.name: dict(one.points()) for one in chosen}
    if GAIN in names:
        places[GAIN] = {place: gain_point(*place) for place in gain_places()}
    found = run_points([point for points in places.values() for point in points.values()], progress)
    outcomes = {name: [found[point] for point in points.values()] for name, points in places.items()}
    maps = {one.name: _map(one, outcomes[one.name]) for one in chosen}
    return maps | ({GAIN: _gain(outcomes[GAIN])} if GAIN in names else {})


def gain_places() -> Iterator[tuple[str, str, str, float]]:
    """Observer, case, arm and gain of every run of the scan."""
    return product(OBSERVERS, GAIN_CASES, ARMS, GAINS)


def _map(one: Slice, outcomes: Sequence[Outcome]) -> xarray.Dataset:
    import xarray

    coordinates = {axis.name: axis.coordinate() for axis in (one.y, one.x)}
    attributes = {"title": one.title, "x": one.x.name, "y": one.y.name, "paper_x": one.x.paper, "paper_y": one.y.paper}
    return xarray.Dataset(
        *_table(outcomes, {"observer": list(OBSERVERS), "arm": list(one.arms), **coordinates}), attrs=attributes
    )


def _gain(outcomes: Sequence[Outcome]) -> xarray.Dataset:
    import xarray

    axis = Axis("gain", "gain of the allocation at the start (1: exact)", GAINS, 1.0, scale="log")
    arms = {"observer": list(OBSERVERS), "case": list(GAIN_CASES), "arm": list(ARMS), "gain": axis.coordinate()}
    return xarray.Dataset(*_table(outcomes, arms), attrs={"title": "Gain of the allocation"})


def _table(outcomes: Sequence[Outcome], coordinates: dict) -> tuple[dict, dict]:
    """Outcomes in the order of the coordinates, as variables and coordinates of a dataset."""
    peak = {"units": "m", "long_name": "largest |y(l,t)| after the fault; none where diverged", "symbol": "|y(l,t)|"}
    end = {"units": "s", "long_name": "instant the run ended at", "symbol": "t"}
    sizes = [len(c[1]) if isinstance(c, tuple) else len(c) for c in coordinates.values()]
    values = np.array(outcomes).reshape(*sizes, 2)
    dims = tuple(coordinates)
    return {"peak": (dims, values[..., 0], peak), "end_time": (dims, values[..., 1], end)}, coordinates
