"""What a study found, as pictures: distributions, paired ratios, maps over two draws, influences."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.analysis.paired import compare, exceedance
from umbilical.plots.figure import COLOURS, QUIET, new_figure
from umbilical.quantities import METRICS, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.studies.results import StudyResult

USUAL = "tip_peak"
_SHOWN = 10
_DECADE = 10.0


def plot_distribution(result: StudyResult, metric: str = USUAL, *, ax: Axes | None = None) -> Axes:
    """Share of the members in which a metric stays below a value, for each arm; what diverged never does."""
    ax = ax or new_figure(7.0, 4.2).add_subplot()
    spread = []
    for colour, arm in enumerate(result.arms):
        values = result.values(metric, arm)
        values = np.sort(values[~np.isnan(values)])
        shares = np.arange(1, values.size + 1) / max(values.size, 1)
        finite = np.isfinite(values)
        style = "--" if colour == len(result.arms) - 1 and len(result.arms) > 1 else "-"
        named = arm + _beyond(result, metric, arm)
        ax.step(values[finite], shares[finite], where="post", color=_colour(colour), label=named, linestyle=style)
        spread += [values[finite]]
    _logarithmic_if_wide(ax, np.concatenate(spread))
    if (limit := result.study.limits.get(metric)) is not None:
        ax.axvline(limit, color=QUIET, linestyle=":")
    ax.set(xlabel=label(metric), ylabel="share of the members below", ylim=(0.0, 1.02))
    return _finish(ax, f"{result.data.sizes['member']} members")


def _beyond(result: StudyResult, metric: str, arm: str) -> str:
    """How often an arm exceeds the study's limit, with its interval; nothing where there is no limit."""
    if (limit := result.study.limits.get(metric)) is None:
        return ""
    found = exceedance(result.values(metric, arm), limit)
    return f"\n  beyond {limit:g}: {100 * found.value:.3g} % ({100 * found.low:.3g} to {100 * found.high:.3g})"


def plot_comparison(result: StudyResult, metric: str = USUAL, *, ax: Axes | None = None) -> Axes:
    """Each arm against the one before it, draw by draw: how the ratio of a metric is distributed.

    Raises:
        ValueError: there is only one arm.
    """
    if len(result.arms) < 2:
        raise ValueError(f"{result.study.name}: there is only one arm, and nothing to compare")
    ax = ax or new_figure(7.0, 4.2).add_subplot()
    spread = []
    for colour, (other, arm) in enumerate(zip(result.arms[:-1], result.arms[1:], strict=True), start=1):
        one, reference = result.values(metric, arm), result.values(metric, other)
        found = compare(one, reference)
        with np.errstate(invalid="ignore", divide="ignore"):
            ratio = np.where(one == reference, 1.0, one / reference)
        ratio = np.sort(ratio[np.isfinite(ratio)])
        words = (
            f"{arm}\n  over {other}: median {found.ratio.value:.3g} ({found.ratio.low:.3g} to {found.ratio.high:.3g})"
        )
        shares = np.arange(1, ratio.size + 1) / found.members
        ax.step(ratio, shares, where="post", color=_colour(colour), label=words)
        spread.append(ratio)
    _logarithmic_if_wide(ax, np.concatenate(spread))
    ax.axvline(1.0, color=QUIET, linestyle=":")
    ax.set(xlabel=f"ratio of {metric}, on the same draw", ylabel="share of the members below", ylim=(0.0, 1.02))
    return _finish(ax, "each arm against the one before; left of 1 it is better")


def plot_map(
    result: StudyResult, metric: str = USUAL, x: str = "", y: str = "", arm: str = "", *, ax: Axes | None = None
) -> Axes:
    """Mean of a metric over two draws, as a map: cells of a grid, or bins of a continuum; empty where all diverged.

    Args:
        result: what a study found.
        metric: its name.
        x, y: what is drawn; left out, the first two that are numbers and vary.
        arm: its name; the first if left out.
        ax: where to draw.

    Raises:
        ValueError: fewer than two numbers are drawn.
    """
    names = numbers_drawn(result)
    if len(names) < 2:
        raise ValueError(f"{result.study.name}: a map needs two numbers that are drawn")
    x, y, arm = x or names[0], y or names[1], arm or result.arms[0]
    ax = ax or new_figure(6.0, 4.2).add_subplot()
    edges = [_edges(result[name].values) for name in (x, y)]
    values = result.values(metric, arm)
    sound = np.isfinite(values)
    places = result[x].values[sound], result[y].values[sound]
    total, *_ = np.histogram2d(*places, bins=edges, weights=values[sound])
    count, *_ = np.histogram2d(*places, bins=edges)
    mean = np.divide(total, count, out=np.full_like(total, np.nan), where=count > 0)
    every = np.concatenate([result.values(metric, name) for name in result.arms])  # one scale for all arms
    scale = {"vmin": 0.0, "vmax": every[np.isfinite(every)].max(initial=0.0)}
    picture = ax.pcolormesh(edges[0], edges[1], mean.T, cmap="viridis", **scale)
    ax.get_figure(root=True).colorbar(picture, ax=ax, label=label(metric))  # type: ignore[union-attr]
    ax.set(xlabel=_named(result, x), ylabel=_named(result, y))
    ax.set_title(arm, fontsize=9.5, loc="left")
    return ax


def plot_sensitivity(result: StudyResult, metric: str = USUAL, arm: str = "", *, ax: Axes | None = None) -> Axes:
    """Influence of each draw on a metric, the strongest on top.

    Raises:
        MissingPartnerError: SALib is not installed.
        ValueError: too few members, or the metric does not vary.
    """
    from umbilical.studies.sensitivity import rank

    arm = arm or result.arms[-1]
    found = rank(result, metric, arm)[:_SHOWN][::-1]
    ax = ax or new_figure(7.0, 4.2).add_subplot()
    ax.barh([i.name for i in found], [i.first for i in found], xerr=[i.first_error for i in found], color=COLOURS[0])
    unit = METRICS[metric].unit
    share = "share of the variance explained alone"
    ax.set_xlabel(f"mean effect on {metric} [{unit}]" if result.study.design == "morris" else f"{share}, {metric}")
    ax.tick_params(labelsize=7)
    ax.set_title(arm, fontsize=9.5, loc="left")
    return ax


def plot_study(result: StudyResult, metric: str = USUAL) -> Figure:
    """A first look at a study: maps where two numbers were combined, else distributions and paired ratios."""
    mapped = result.study.design == "grid" and len(numbers_drawn(result)) >= 2
    panels = result.arms if mapped else (("both",) if len(result.arms) < 2 else ("distribution", "comparison"))
    figure = new_figure(5.6 * len(panels), 4.4)
    for ax, panel in zip(np.atleast_1d(figure.subplots(1, len(panels))), panels, strict=True):
        if mapped:
            plot_map(result, metric, arm=panel, ax=ax)
        else:
            (plot_comparison if panel == "comparison" else plot_distribution)(result, metric, ax=ax)
    figure.suptitle(f"{result.study.name}: {METRICS[metric].meaning}", fontsize=11)
    return figure


def numbers_drawn(result: StudyResult) -> list[str]:
    """Names of the draws that are numbers and vary."""
    names = [str(name) for name in result["variable"].values]
    return [n for n in names if result[n].dtype.kind in "fi" and not n.endswith(".motor") and np.ptp(result[n].values)]


def _edges(values: np.ndarray) -> np.ndarray:
    """Borders between single values where they are few, else of equal bins."""
    single = np.unique(values)
    if single.size > 40:
        return np.linspace(single[0], single[-1], max(int(np.sqrt(values.size) / 2.0), 4) + 1)
    middle = (single[1:] + single[:-1]) / 2.0
    return np.concatenate([[2 * single[0] - middle[0]], middle, [2 * single[-1] - middle[-1]]])


def _named(result: StudyResult, name: str) -> str:
    unit = result[name].attrs["units"]
    return f"{name} [{unit}]" if unit not in ("", "1") else name


def _colour(number: int) -> str:
    return COLOURS[number % len(COLOURS)]


def _logarithmic_if_wide(ax: Axes, values: np.ndarray) -> None:
    if values.size and values.min() > 0.0 and values.max() > _DECADE * values.min():
        ax.set_xscale("log")


def _finish(ax: Axes, title: str) -> Axes:
    ax.set_title(title, fontsize=9.5, loc="left")
    ax.grid(alpha=0.25, linewidth=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(fontsize=7, frameon=True, framealpha=0.9, edgecolor="none", loc="best")  # lines may run behind it
    return ax


STUDY_PLOTS = {
    "overview": plot_study,
    "distribution": plot_distribution,
    "comparison": plot_comparison,
    "map": plot_map,
    "sensitivity": plot_sensitivity,
}
"""Every picture of a study by the name the command line gives it; each takes a result and a metric."""
