"""What a study found, as pictures: distributions, paired ratios, influences, and a first look."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.analysis.paired import Estimate
from umbilical.errors import expect
from umbilical.plots.figure import COLOURS, QUIET, dress, new_figure
from umbilical.plots.study_map import USUAL, largest_mean, numbers_drawn, plot_map
from umbilical.quantities import METRICS, label
from umbilical.studies.sensitivity import influences
from umbilical.studies.statistics import against, at, beyond, interval_text, percentage, ratios
from umbilical.studies.sweep import worst

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.studies.results import StudyResult

_SHOWN = 10
_WORST = 3
_DECADE = 10.0


def plot_distribution(result: StudyResult, metric: str = USUAL, *, ax: Axes | None = None) -> Axes:
    """Share of the members in which a metric stays below a value, for each arm; what diverged never does.

    Bars are the intervals of the median and of the 95 % quantile; the legend names the worst members.
    """
    ax = ax or new_figure(7.0, 4.2 + _legend(result)).add_subplot()
    spread = []
    for colour, arm in enumerate(result.arms):
        values = result.values(metric, arm)
        values = np.sort(values[~np.isnan(values)])
        shares = np.arange(1, values.size + 1) / max(values.size, 1)
        finite = np.isfinite(values)
        named = f"{arm}\n  {_in_words(result, metric, arm)}"
        ax.step(values[finite], shares[finite], where="post", label=named, **_look(colour))
        for share in (0.5, 0.95):
            _interval(ax, at(result, metric, arm, share), share, _look(colour)["color"])
        spread += [values[finite]]
    _logarithmic_if_wide(ax, np.concatenate(spread))
    if (limit := result.study.limits.get(metric)) is not None:
        ax.axvline(limit, color=QUIET, linestyle=":")
    ax.set(xlabel=label(metric), ylabel="share of the members below", ylim=(0.0, 1.02))
    return _finish(ax, f"{result.data.sizes['member']} members")


def _in_words(result: StudyResult, metric: str, arm: str) -> str:
    """Median, how often the study's limit is exceeded, and the worst members."""
    limit = result.study.limits.get(metric)
    parts = [f"median {interval_text(at(result, metric, arm, 0.5), 3)}"]
    parts += [f"beyond {limit:g}: {percentage(beyond(result, metric, arm, limit))}"] if limit is not None else []
    parts += [f"worst {', '.join(f'#{number}' for number in worst(result, metric, arm, _WORST))}"]
    return "\n  ".join(parts)


def _interval(ax: Axes, found: Estimate, share: float, colour: str) -> None:
    """A bar from one end of an interval to the other; an open end is an arrow at the estimate."""
    if not np.isfinite(found.value) or np.isnan(found.low):
        return
    ends = [end if np.isfinite(end) else found.value for end in found[1:]]
    ax.plot(ends, [share, share], color=colour, linewidth=2.5)
    for place, end, arrow in zip(ends, found[1:], "<>", strict=True):
        ax.plot(place, share, "|" if np.isfinite(end) else arrow, color=colour, markersize=7)


def plot_comparison(result: StudyResult, metric: str = USUAL, *, ax: Axes | None = None) -> Axes:
    """Each arm against the first, draw by draw: how the ratio of a metric is distributed.

    Raises:
        ValueError: there is only one arm.
    """
    if len(result.arms) < 2:
        raise ValueError(f"{result.study.name}: there is only one arm, and nothing to compare")
    ax = ax or new_figure(7.0, 4.2 + _legend(result)).add_subplot()
    spread = []
    other = result.arms[0]
    for colour, arm in enumerate(result.arms[1:], start=1):
        found = against(result, metric, arm, other)
        ratio = ratios(result, metric, arm, other)
        ratio = np.sort(ratio[np.isfinite(ratio)])
        zeros, ratio = np.count_nonzero(ratio == 0.0), ratio[ratio > 0.0]  # 0: only the other one diverged
        text = f"{arm}\n  median {interval_text(found.ratio, 3)}"
        shares = (zeros + np.arange(1, ratio.size + 1)) / max(found.members, 1)
        ax.step(ratio, shares, where="post", label=text, **_look(colour))
        spread.append(ratio)
    _logarithmic_if_wide(ax, np.concatenate(spread))
    ax.axvline(1.0, color=QUIET, linestyle=":")
    ax.set(xlabel=f"ratio of {metric}, on the same draw", ylabel="share of the members below", ylim=(0.0, 1.02))
    return _finish(ax, f"each arm over {other}: below 1 the arm is better")


def plot_sensitivity(result: StudyResult, metric: str = USUAL, arm: str = "", *, ax: Axes | None = None) -> Axes:
    """Influence of each draw on a metric, the strongest on top; in every arm, or in one.

    Raises:
        MissingPartnerError: SALib is not installed.
        ValueError: too few members, or the metric varies in no arm.
    """
    ranked = influences(result, metric, (arm,) if arm else result.arms)
    found = {name: each for name, each in ranked.items() if not isinstance(each, str)}
    if not found:
        raise ValueError([*ranked.values()][-1])
    names = [influence.name for influence in next(iter(found.values()))][:_SHOWN]
    ax = ax or new_figure(7.0, 4.2).add_subplot()
    height = 0.8 / len(found)
    for place, (name, ranking) in enumerate(found.items()):
        by_name = {influence.name: influence for influence in ranking}
        rows = [by_name[drawn] for drawn in names]
        lower = np.arange(len(rows)) + (place - (len(found) - 1) / 2.0) * height
        errors = np.nan_to_num([row.first_error for row in rows])
        bars = {"height": height, "color": _look(result.arms.index(name))["color"], "label": name}
        ax.barh(lower, [row.first for row in rows], xerr=errors if errors.any() else None, **bars)
    ax.set_yticks(range(len(names)), names)
    ax.invert_yaxis()
    unit = METRICS[metric].unit
    share = "share of the variance explained alone"
    ax.set_xlabel(f"mean effect on {metric} [{unit}]" if result.study.design == "morris" else f"{share}, {metric}")
    ax.tick_params(labelsize=7)
    return _finish(ax, f"{result.data.sizes['member']} members ({result.study.design})")


def plot_study(result: StudyResult, metric: str = USUAL) -> Figure:
    """A first look at a study: maps where two numbers were combined, else distributions and paired ratios.

    Args:
        result: from :func:`umbilical.sweep` or :func:`umbilical.open_study`.
        metric: which to draw, by its name in a run's metrics.

    >>> import umbilical
    >>> study = umbilical.load_study("fault-map", {"campaigns.1.start.count": 2, "scenario.duration": 0.5})
    >>> umbilical.plot_study(umbilical.sweep(study)).savefig("study.png")
    """
    expect(result, "StudyResult", "open_study")
    if result.study.design == "grid" and len(numbers_drawn(result)) >= 2:
        return _title(_maps(result, metric), result, metric)
    panels = (plot_distribution, plot_comparison) if len(result.arms) > 1 else (plot_distribution,)
    figure = new_figure(6.4 * len(panels), 4.4 + _legend(result))
    for ax, draw in zip(np.atleast_1d(figure.subplots(1, len(panels))), panels, strict=True):
        draw(result, metric, ax=ax)
    return _title(figure, result, metric)


def _legend(result: StudyResult) -> float:
    """Height of the legend below a picture, inches."""
    return 0.55 * -(-len(result.arms) // 2)


def _maps(result: StudyResult, metric: str) -> Figure:
    """One map for each arm, and for the last one's ratio to the first; a row of them for each motor that fails."""
    rows = _motors(result)
    top = largest_mean(result, metric, rows)
    columns: list[dict[str, Any]] = [{"arm": a, "top": top, "bar": a == result.arms[-1]} for a in result.arms]
    columns += [{"arm": result.arms[-1], "over": result.arms[0]}] if len(result.arms) > 1 else []
    figure = new_figure(4.6 * len(columns), 3.6 * len(rows))
    panels = figure.subplots(len(rows), len(columns), squeeze=False)
    for line, where in zip(panels, rows, strict=True):
        for ax, column in zip(line, columns, strict=True):
            plot_map(result, metric, where=where, ax=ax, **column)
    return figure


def _motors(result: StudyResult) -> list[Mapping[str, Any]]:
    """The motors that fail, one by one; one part with everything where they do not vary."""
    names = [f"{campaign.name}.motor" for campaign in result.study.campaigns]
    varied = [name for name in names if np.unique(result[name].values).size > 1]
    return [{varied[0]: number} for number in np.unique(result[varied[0]].values)] if varied else [{}]


def _title(figure: Figure, result: StudyResult, metric: str) -> Figure:
    figure.suptitle(f"{result.study.name}: {METRICS[metric].meaning}", fontsize=11)
    return figure


def _look(number: int) -> dict[str, Any]:
    """Neighbours differ in dashes, too, the dashed ones on top, so that both show where they agree."""
    return {"color": COLOURS[number % len(COLOURS)]} | ({"linestyle": "--", "zorder": 3} if number % 2 else {})


def _logarithmic_if_wide(ax: Axes, values: np.ndarray) -> None:
    if values.size and values.min() > 0.0 and values.max() > _DECADE * values.min():
        ax.set_xscale("log")


def _finish(ax: Axes, title: str) -> Axes:
    below = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.16), "borderaxespad": 0.0}  # where no line is
    return dress(ax, title, below | {"fontsize": 7, "ncols": min(len(ax.get_legend_handles_labels()[1]), 2)})


STUDY_PLOTS = {
    "overview": plot_study,
    "distribution": plot_distribution,
    "comparison": plot_comparison,
    "map": plot_map,
    "sensitivity": plot_sensitivity,
}
"""Every picture of a study by the name the command line gives it; each takes a result and a metric."""
