"""Maps as studies: the peak of the ROV after a fault over two numbers, and over the gain of the allocation.

Every case and arm of a map is a study: the observer and y are drawn on a grid, and each x is one of its arms. Thousands
of runs, so on a coarser grid than the figures: :data:`GRID`. With the paper's ``beta`` the ROV hardly feels the grid;
tests/papers compare coarse peaks with those of the default grid.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical import Study, load, sweep
from umbilical.papers.rao2022.experiments import ARMS, BELIEVED, BOX, OBSERVER, OBSERVERS, RATES, START, UPPER, preset
from umbilical.papers.rao2022.progress import Progress, parts

if TYPE_CHECKING:
    import xarray

Changes = Mapping[str, Any]
GRID: Changes = {"grid.elements": 8}
EARLY: Changes = {"faults.1.start": 0.1}
"""A fault so early that it comes before a loop runs away, in scans of the gain."""
FACTORS = (1.2, 0.8)
"""True thrust factors of the presets, N s2/rad2."""
EXACT = 1.0 / sum(FACTORS)
"""kappa_0 that delivers what is commanded, rad2/(N s2)."""
BOXED = "boxed"
RIM = BOX[UPPER][0]
PRESET_RATES = (0.1, 100.0, 100.0)
GAIN_CASES = ("none", "dead")


@dataclass(frozen=True)
class Axis:
    """One number that is varied; ``paper`` is its value in the presets, ``key`` its place there where it is drawn."""

    name: str
    meaning: str
    values: tuple[float, ...]
    paper: float
    unit: str = "1"
    scale: str = "linear"
    key: str = ""

    def coordinate(self) -> tuple[str, list[float], dict[str, str]]:
        """As xarray takes it."""
        words = {"units": self.unit, "long_name": self.meaning, "scale": self.scale, "symbol": ""}
        return self.name, list(self.values), words


@dataclass(frozen=True)
class Map:
    """Numbers varied over faults.

    Attributes:
        name: of the figure that shows it.
        title: of its data.
        cases: of faults.
        x: what ``setting`` makes changes of, for a case and an arm.
        y: what is drawn, if anything is.
        setting: changes of the preset of a case and an arm at x.
        arms: each with the axes that mean something to it.
    """

    name: str
    title: str
    cases: tuple[str, ...]
    x: Axis
    y: Axis | None
    setting: Callable[[str, str, float], Changes]
    arms: Mapping[str, str]

    def study(self, case: str, arm: str) -> Study:
        """All runs of a case and an arm; along an axis that means nothing to it there is one."""
        drawn: dict[str, tuple[Any, ...]] = {OBSERVER: tuple(observer == "on" for observer in OBSERVERS)}
        if self.y and "y" in self.arms[arm]:  # a start above the box is put on its rim
            top = RIM if arm == BOXED and self.y.key.startswith(START) else np.inf
            drawn[self.y.key] = tuple(min(value, top) for value in self.y.values)
        values = self.x.values if "x" in self.arms[arm] else (self.x.paper,)
        return Study.model_validate(
            {
                "name": f"{self.name} {case} {arm}",
                "scenario": load(preset(case, arm), {**GRID, **(BOX if arm == BOXED else {})}),
                "design": "grid",
                "factors": tuple({"key": k, "distribution": {"kind": "choice", "values": v}} for k, v in drawn.items()),
                "arms": tuple({"name": f"{x:g}", "changes": self.setting(case, arm, x)} for x in values),
            }
        )

    def run(self, progress: Progress) -> xarray.Dataset:
        """Peak and end of every run."""
        places = list(product(self.cases, self.arms))
        shape = len(OBSERVERS), len(self.y.values) if self.y else 1, len(self.x.values)
        shares = parts(progress, [1.0] * len(places))
        found = [_cells(self.study(*place), shape, share) for place, share in zip(places, shares, strict=True)]
        cells = np.array(found).reshape(len(self.cases), len(self.arms), 2, *shape).transpose(2, 3, 0, 1, 4, 5)
        return self.dataset(*cells.reshape(2, *(len(values) for _, values, _ in self.coordinates.values())))

    @property
    def coordinates(self) -> dict[str, tuple[str, list[Any], dict[str, str]]]:
        """Observer, case where there are several, arm, y and x, as xarray takes them."""
        cases = {"case": self.cases} if len(self.cases) > 1 else {}
        named = {"observer": OBSERVERS, **cases, "arm": self.arms}
        axes = {axis.name: axis.coordinate() for axis in (self.y, self.x) if axis}
        return {name: (name, list(values), {}) for name, values in named.items()} | axes

    def dataset(self, peaks: np.ndarray, ends: np.ndarray) -> xarray.Dataset:
        """Peaks and ends over the coordinates; in two dimensions it says which they are and where the presets are."""
        import xarray

        about: dict[str, Any] = {"title": self.title}
        if self.y:
            about |= {"x": self.x.name, "y": self.y.name, "paper_x": self.x.paper, "paper_y": self.y.paper}
        dims = tuple(self.coordinates)
        return xarray.Dataset({"peak": (dims, peaks, PEAK), "end_time": (dims, ends, END)}, self.coordinates, about)


PEAK = {"units": "m", "long_name": "largest |y(l,t)| after the fault; none where diverged", "symbol": "|y(l,t)|"}
COMPLETED, DIVERGED = range(2)
"""As a study's ``status`` has them; what is beyond was refused or failed."""
END = {"units": "s", "long_name": "instant the run ended at", "symbol": "t"}


def _cells(study: Study, shape: tuple[int, ...], progress: Progress) -> tuple[np.ndarray, np.ndarray]:
    """Peaks, m, not a number where a run diverged, and ends, s, of a study, in the shape of a map.

    Raises:
        RuntimeError: a run was refused, with the reason.
    """
    found = sweep(study, progress=progress)
    if (found["status"] > DIVERGED).any():
        raise RuntimeError(f"{study.name}: {', '.join(set(found['reason'].values.ravel()))}")
    metric = "tip_peak_after_fault" if "tip_peak_after_fault" in found.data else "tip_peak"
    both = found[metric].where(found["status"] == COMPLETED), found["end_time"]
    peak, end = (np.broadcast_to(cells.values.reshape(shape[0], -1, len(found.arms)), shape) for cells in both)
    return peak, end


def _steps(low: float, high: float) -> tuple[float, ...]:
    return tuple(float(v) for v in np.round(np.linspace(low, high, 15), 10))


def _powers(base: float, ratio: float, below: int, count: int = 15) -> tuple[float, ...]:
    return tuple(float(base * ratio**k) for k in range(-below, count - below))


def gain_setting(case: str, arm: str, gain: float) -> Changes:
    """The allocation at ``gain`` times its exact gain: by the believed factors, or the start of the adaptation."""
    early = {} if case == "none" else EARLY
    if arm == "with":
        return {START: (gain / sum(FACTORS), 0.0, 0.0), **early}
    return {BELIEVED: tuple(k / gain for k in FACTORS), **early}


GAINS = _powers(1.0, 2.0 ** (1 / 3), 6, 17)
"""Gain of the allocation at the start, sum of the true thrust factors times kappa_0: 1 is exact."""
SCANS = {
    one.name: one
    for one in (
        Map(
            "map-time",
            "Loss of thrust by the instant of the fault",
            ("partial",),
            Axis("fault_start", "instant of the fault", _steps(1.0, 43.0), 10.0, "s"),
            Axis("effectiveness", "effectiveness left", _steps(0.0, 1.0), 0.5, key="faults.1.effectiveness"),
            lambda case, arm, instant: {"faults.1.start": instant},
            dict.fromkeys(ARMS, "xy"),
        ),
        Map(
            "map-factors",
            "Stuck value by the error of the known factors",
            ("stuck",),
            Axis("believed_ratio", "believed / true factors", _powers(1.0, 2.0 ** (1 / 7), 7), 1.0, scale="log"),
            Axis("stuck_value", "stuck value", _steps(-700.0, 700.0), 100.0, "rad2/s2", key="faults.1.value"),
            lambda case, arm, ratio: {BELIEVED: tuple(k * ratio for k in FACTORS)} if arm == "without" else {},
            {"without": "xy", "with": "y", BOXED: "y"},
        ),
        Map(
            "map-rates",
            "Start of the adaptation by its rate, motor 2 dead",
            ("dead",),
            Axis("rate_ratio", "rates / those of the preset", _powers(1.0, 10.0 ** (1 / 3), 6), 1.0, scale="log"),
            Axis("kappa_start", r"$\kappa_0(0)$", _powers(0.25, 2.0**0.5, 6), 0.25, "rad2/(N s2)", "log", f"{START}.1"),
            lambda case, arm, ratio: {} if arm == "without" else {RATES: tuple(k * ratio for k in PRESET_RATES)},
            {"without": "", "with": "xy", BOXED: "xy"},
        ),
        Map(
            "gain",
            "Gain of the allocation",
            GAIN_CASES,
            Axis("gain", "gain of the allocation at the start (1: exact)", GAINS, 1.0, scale="log"),
            None,
            gain_setting,
            dict.fromkeys(ARMS, "x"),
        ),
    )
}
"""Every map by name, and last the scan of the gain, which is made with and without them."""
MAPS = tuple(name for name in SCANS if name != "gain")


def compute_maps(
    names: Collection[str] = (*MAPS, "gain"), progress: Progress | None = None
) -> dict[str, xarray.Dataset]:
    """The maps of these names and the scan of the gain, by name."""
    chosen = [one for name, one in SCANS.items() if name in names]
    shares = parts(progress, [4.0 if one.y else 1.0 for one in chosen])
    return {one.name: one.run(share) for one, share in zip(chosen, shares, strict=True)}
