"""Maps of a study: a metric over two draws, an arm as it is or against another."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from umbilical.plots.figure import as_figure, new_figure
from umbilical.quantities import label
from umbilical.studies.statistics import ratios

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.studies.results import StudyResult

USUAL = "tip_peak"
_FACTORS = (1.01, 1.02, 1.05, 1.1, 1.2, 1.3, 1.5, 2.0, 3.0, 5.0, *(10.0**k for k in range(1, 13)))
_SINGLE = 40
"""Up to so many different values each has its own row of cells."""


class _Axis(NamedTuple):
    """One axis of a map: where each member is on it, the borders of its cells, and names where values are no scale."""

    name: str
    places: np.ndarray
    edges: np.ndarray
    ticks: tuple[str, ...] = ()


class Cells(NamedTuple):
    """Mean of each cell over the runs that completed, the share that did not, and the most members in one cell."""

    mean: np.ndarray
    lost: np.ndarray
    members: int


def plot_map(
    result: StudyResult, metric: str = USUAL, x: str = "", y: str = "", arm: str = "", *, over: str = "",
    where: Mapping[str, Any] | None = None, top: float | None = None, bar: bool = True, ax: Axes | None = None,
) -> Axes:  # fmt: skip
    """Mean of a metric over two draws, as a map: cells of a grid, or bins of a continuum.

    Means are over the runs that completed; cells in which some did not say how many in percent.

    Args:
        result: what a study found.
        metric: its name.
        x, y: what is drawn; left out, the first two that are numbers and vary.
        arm: its name; the first if left out.
        over: another arm: the ratio to it on the same draws is shown, instead of the metric.
        where: what is drawn, and the value it has in the members shown; all of them if left out.
        top: end of the scale of colours; the largest mean if left out.
        bar: whether the scale of colours stands beside it.
        ax: where to draw.

    Raises:
        ValueError: fewer than two numbers are drawn, or no such draw.
    """
    x, y = axes_of_a_map(result, x, y)
    arm = arm or result.arms[0]
    ax = ax or new_figure(6.0, 4.2).add_subplot()
    across, up = (_axis(result, name) for name in (x, y))
    found = _cells(result, ratios(result, metric, arm, over) if over else result.values(metric, arm), across, up, where)
    style = _around_one(found.mean) if over else _from_zero(top or _largest(found.mean))
    picture = ax.pcolormesh(across.edges, up.edges, found.mean.T, **style)
    text = f"ratio of {metric}" if over else label(metric)
    text = f"mean of {text}" if found.members > 1 else text
    if bar:
        scale = as_figure(ax).colorbar(picture, ax=ax, label=text)
        if over:
            ticks = _round_ratios(style["norm"].vmax)
            scale.set_ticks([*ticks], labels=[*ticks.values()])
            scale.minorticks_off()
    _mark_lost(ax, across, up, found.lost)
    _name_axes(ax, result, across, up)
    shown = [f"{name} = {value:g}" for name, value in (where or {}).items()]
    ax.set_title("\n".join([", ".join([arm, *shown]), *([f"over {over}"] if over else [])]), fontsize=8.5, loc="left")
    return ax


def largest_mean(result: StudyResult, metric: str, where: list[Mapping[str, Any]]) -> float:
    """Largest mean of a cell in any arm and any of these parts of the study: the end of a scale that all share."""
    across, up = (_axis(result, name) for name in axes_of_a_map(result))
    means = [_cells(result, result.values(metric, arm), across, up, part).mean for arm in result.arms for part in where]
    return _largest(np.array(means))


def axes_of_a_map(result: StudyResult, x: str = "", y: str = "") -> tuple[str, str]:
    """Names of what a map is over: those given, else the first numbers that vary.

    Raises:
        ValueError: fewer than two numbers are drawn, or no such draw.
    """
    drawn = [str(name) for name in result["variable"].values]
    for name in filter(None, (x, y)):
        if name not in drawn:
            raise ValueError(f"{name} is not drawn; there are {', '.join(drawn)}")
    left = [name for name in numbers_drawn(result) if name not in (x, y)]
    if len(left) < (not x) + (not y):
        raise ValueError(f"{result.study.name}: a map needs two numbers that are drawn")
    x = x or left.pop(0)
    return x, y or left.pop(0)


def numbers_drawn(result: StudyResult) -> list[str]:
    """Names of the draws that are numbers and vary."""
    names = [str(name) for name in result["variable"].values]
    return [n for n in names if result[n].dtype.kind in "fi" and not _is_name(result, n) and np.ptp(result[n].values)]


def _is_name(result: StudyResult, name: str) -> bool:
    """Whether values are names, between which there is nothing: texts, truth values, and numbers of motors."""
    return result[name].dtype.kind not in "fi" or name.endswith(".motor")


def _axis(result: StudyResult, name: str) -> _Axis:
    values = result[name].values
    single, places = np.unique(values, return_inverse=True)
    if _is_name(result, name):
        return _Axis(name, places.astype(float), np.arange(single.size + 1) - 0.5, tuple(map(str, single)))
    if single.size > _SINGLE or single.size < 2:
        bins = max(int(np.sqrt(values.size) / 2.0), 4)
        return _Axis(name, values, np.histogram_bin_edges(values, bins))
    middle = (single[1:] + single[:-1]) / 2.0
    return _Axis(name, values, np.concatenate([[2 * single[0] - middle[0]], middle, [2 * single[-1] - middle[-1]]]))


def _cells(result: StudyResult, values: np.ndarray, x: _Axis, y: _Axis, where: Mapping[str, Any] | None) -> Cells:
    chosen = ~np.isnan(values)
    for name, value in (where or {}).items():
        chosen &= result[name].values == value
    sound, bins = chosen & np.isfinite(values), [x.edges, y.edges]
    total, *_ = np.histogram2d(x.places[sound], y.places[sound], bins=bins, weights=values[sound])
    count, *_ = np.histogram2d(x.places[sound], y.places[sound], bins=bins)
    every, *_ = np.histogram2d(x.places[chosen], y.places[chosen], bins=bins)
    nothing = np.full_like(total, np.nan)
    mean = np.divide(total, count, out=nothing.copy(), where=count > 0)
    return Cells(mean, 1.0 - np.divide(count, every, out=nothing, where=every > 0), int(every.max()))


def _largest(means: np.ndarray) -> float:
    return float(means[np.isfinite(means)].max(initial=0.0)) or 1.0


def _from_zero(top: float) -> dict[str, Any]:
    return {"cmap": "viridis", "vmin": 0.0, "vmax": top}


def _around_one(ratio: np.ndarray) -> dict[str, Any]:
    """Blue where the ratio is below 1, red above, white where nothing changes."""
    from matplotlib.colors import LogNorm

    sound = ratio[np.isfinite(ratio) & (ratio > 0.0)]
    most = float(np.exp(np.abs(np.log(sound)).max(initial=0.01)))
    return {"cmap": "RdBu_r", "norm": LogNorm(1.0 / most, most)}


def _round_ratios(most: float) -> dict[float, str]:
    """Round factors up to the largest ratio with their names, and what is as much smaller."""
    factors = [f for f in _FACTORS if f <= most][-3:]
    return {1.0: "1"} | {f: f"x {f:g}" for f in factors} | {1.0 / f: f"/ {f:g}" for f in factors}


def _mark_lost(ax: Axes, x: _Axis, y: _Axis, lost: np.ndarray) -> None:
    """How many runs of a cell did not complete, in percent, where any did not."""
    across, up = (((axis.edges[1:] + axis.edges[:-1]) / 2.0).tolist() for axis in (x, y))
    for column, row in np.argwhere(lost > 0.0):
        text = f"{100.0 * lost[column, row]:.0f} %\nlost"
        box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.5}
        ax.text(across[column], up[row], text, ha="center", va="center", fontsize=6, bbox=box)


def _name_axes(ax: Axes, result: StudyResult, x: _Axis, y: _Axis) -> None:
    ax.set(xlabel=_named(result, x.name), ylabel=_named(result, y.name))
    if x.ticks:
        ax.set_xticks(range(len(x.ticks)), x.ticks)
    if y.ticks:
        ax.set_yticks(range(len(y.ticks)), y.ticks)


def _named(result: StudyResult, name: str) -> str:
    unit = result[name].attrs.get("units", "1")
    return f"{name} [{unit}]" if unit not in ("", "1") else name
