"""What the figures of a paper share: one column's width, small type, one look for each line, panels over time."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from umbilical.plots.figure import COLOURS, QUIET, axis_label, new_figure

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.cm import ScalarMappable
    from matplotlib.colorbar import Colorbar
    from matplotlib.figure import Figure

COLUMN_WIDTH = 85.0 / 25.4
"""Inches; one column of a page of A4 with two."""
TYPE = 7.0
"""Points, when the figure is printed as wide as it is."""
RESOLUTION = 300
"""Dots per inch of a PNG."""
NO_FAULT = "none"


class Look(NamedTuple):
    """How one line is drawn, and its name in a legend. Colour never is the only difference."""

    text: str
    colour: str
    dashes: tuple[float, ...] = ()
    width: float = 1.0


LOOKS = {
    "none": Look("no control", COLOURS[6], (1, 1)),
    "pd": Look("PD", COLOURS[1], (4, 1.5)),
    "proposed": Look("proposed", COLOURS[0]),
    "without": Look("known factors", COLOURS[0]),
    "with": Look("fault control", COLOURS[1], (4, 1.5)),
    "truth": Look("actual", COLOURS[0]),
    "estimate": Look("estimated", COLOURS[1], (4, 1.5)),
    "load": Look("load $d$", COLOURS[2], (1, 1)),
    "ideal": Look("ideal", COLOURS[6], (1, 1), 0.8),
    "boxed": Look(r"the same, $\kappa$ in a box", COLOURS[2], (6, 1.5, 1, 1.5)),
    "fast": Look("fault control, ten times faster", COLOURS[3], (2, 1)),
}
"""Every kind of line by the name its data give it."""


class Panel(NamedTuple):
    """Lines over time.

    Attributes:
        title: gets a letter in front, unless it has one or stands alone.
        lines: arrays over time, each with its look.
        window: part of the time that is shown, s; all of it if left out.
        marked: whether the fault is marked, where the data have one.
        bottom, top: limits of the axis.
        log: whether it is logarithmic.
    """

    title: str
    lines: list[tuple[xarray.DataArray, Look]]
    window: tuple[float, float] | None = None
    marked: bool = True
    bottom: float | None = None
    top: float | None = None
    log: bool = False


def lines_of(data: xarray.Dataset, name: str, over: str, **place: object) -> list[tuple[xarray.DataArray, Look]]:
    """A line for each entry of a dimension, which names its look, at a place in the others."""
    return [(data[name].sel({over: who, **place}), LOOKS[str(who)]) for who in data[over].values]


def pair(data: xarray.Dataset, name: str, **place: object) -> list[tuple[xarray.DataArray, Look]]:
    """A truth and its estimate."""
    return [(data[n].sel(place), LOOKS[who]) for n, who in ((name, "truth"), (f"{name}_estimate", "estimate"))]


def over_time(
    panels: Callable[[xarray.Dataset], Iterable[Panel]], height: float, columns: int = 3
) -> Callable[[xarray.Dataset], Figure]:
    """What draws panels of lines below each other: each so many inches high, so many names in a row of the legend."""
    return partial(_draw_over_time, panels=panels, height=height, columns=columns)


def _draw_over_time(
    data: xarray.Dataset, panels: Callable[[xarray.Dataset], Iterable[Panel]], height: float, columns: int
) -> Figure:
    drawn = list(panels(data))
    figure, axes = column(len(drawn), height)
    for k, (ax, one) in enumerate(zip(axes, drawn, strict=True)):
        for array, look in one.lines:
            _line(ax, array if one.window is None else array.sel(time=slice(*one.window)), look, one.top)
        alone = len(drawn) == 1 or one.title.startswith("(")
        dress_panel(ax, one.title if alone else f"{letter(k)} {one.title}", unit_label(one.lines[0][0]))
        if one.log:
            ax.set_yscale("log")
        ax.set_ylim(one.bottom, one.top)
        if one.log:
            log_axis(ax.yaxis)
        last = k + 1 == len(drawn) or drawn[k + 1].window != one.window
        time_axis(ax, data, labelled=last, marked=one.marked, window=one.window)
    legend(figure, columns)
    return figure


def _line(ax: Axes, array: xarray.DataArray, look: Look, top: float | None) -> None:
    """One array over time; a cross where it ends early, because its run diverged."""
    there = array.dropna("time")
    style = {"color": look.colour, "linewidth": look.width, "linestyle": (0, look.dashes) if look.dashes else "-"}
    ax.plot(there["time"].values, there.values, label=look.text, **style)
    if there.sizes["time"] < array.sizes["time"]:
        end = min(float(there[-1]), float("inf") if top is None else top)
        ax.plot(there["time"][-1], end, "x", color=look.colour, ms=4, clip_on=False)


def column(rows: int, height: float, columns: int = 1) -> tuple[Figure, list[Axes]]:
    """A figure as wide as a column, with panels row by row; ``height`` of one row in inches."""
    figure = new_figure(COLUMN_WIDTH, rows * height + 0.25)
    engine = figure.get_layout_engine()
    assert engine is not None
    engine.set(w_pad=0.02, h_pad=0.02, hspace=0.02, wspace=0.02)  # type: ignore[call-arg]
    panels = figure.subplots(rows, columns, squeeze=False)
    return figure, list(panels.ravel())


def dress_panel(ax: Axes, title: str, ylabel: str) -> None:
    """Title at the left, labels, ticks and grid in the type of the page."""
    from matplotlib.ticker import MaxNLocator

    ax.set_title(title, fontsize=TYPE, loc="left", pad=3)
    ax.set_ylabel(ylabel, fontsize=TYPE)
    ax.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10], min_n_ticks=3))
    ax.tick_params(labelsize=TYPE - 0.5, length=2, pad=2)
    ax.grid(alpha=0.25, linewidth=0.4)
    ax.spines[["top", "right"]].set_visible(False)
    for side in ("left", "bottom"):
        ax.spines[side].set_linewidth(0.6)


def time_axis(
    ax: Axes,
    data: xarray.Dataset,
    *,
    labelled: bool,
    marked: bool = True,
    window: tuple[float, float] | None = None,
) -> None:
    """The axis of time of one panel, and the fault, if there is one: the legend names it, where no curve can run over
    the word."""
    time = data["time"] if window is None else data["time"].sel(time=slice(*window))
    ax.set_xlim(float(time[0]), float(time[-1]))
    if marked and "fault_time" in data.attrs:
        ax.axvline(data.attrs["fault_time"], color=QUIET, linewidth=0.7, linestyle="--", zorder=0.5, label="fault")
    ax.tick_params(labelbottom=labelled)
    if labelled:
        ax.set_xlabel(f"{time.attrs['long_name']} [{time.attrs['units']}]", fontsize=TYPE)


def colour_bar(figure: Figure, picture: ScalarMappable, ax: Axes | list[Axes], label: str) -> Colorbar:
    """The scale of colours beside one panel, or beside a row of them."""
    bar = figure.colorbar(picture, ax=ax, pad=0.02)
    bar.set_label(label, fontsize=TYPE)
    bar.ax.tick_params(labelsize=TYPE - 1, length=2, pad=2)
    return bar


def legend(figure: Figure, columns: int = 3) -> None:
    """The names of all lines, each once, above the whole figure, where no curve is."""
    named = {name: handle for ax in figure.axes for handle, name in zip(*ax.get_legend_handles_labels(), strict=True)}
    names = sorted(named, key="fault".__eq__)
    look = {"fontsize": TYPE, "frameon": False, "borderpad": 0.1, "handlelength": 2.2, "columnspacing": 1.2}
    figure.legend([named[name] for name in names], names, loc="outside upper center", ncols=columns, **look)


def letter(number: int) -> str:
    """(a), (b), ... of panel 0, 1, ..."""
    return f"({chr(ord('a') + number)})"


def unit_label(array: xarray.DataArray) -> str:
    """Symbol and unit, from the data."""
    return raised(axis_label(array))


def raised(label: str) -> str:
    """A label with the powers in its unit raised.

    >>> raised("stuck value [rad2/s2]")
    'stuck value [rad$^2$/s$^2$]'
    """
    text, bracket, unit = label.rpartition("[")
    return text + bracket + re.sub(r"(?<=[a-z])(\d)", r"$^\1$", unit)


def log_axis(axis: Axis, ticks: int = 6) -> None:
    """A logarithmic axis with at most some ticks: plain 1, 2 and 5 over less than two decades, else powers of ten."""
    from matplotlib.ticker import LogFormatterSciNotation, LogLocator, NullLocator

    low, high = sorted(axis.get_view_interval())
    axis.set_minor_locator(NullLocator())
    if high < 100.0 * low:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter("{x:g}")
    else:
        axis.set_major_locator(LogLocator(numticks=ticks))
        axis.set_major_formatter(LogFormatterSciNotation())


def faults_first(data: xarray.Dataset) -> list[str]:
    """Cases in the paper's order: (a) with a fault, (b) without one."""
    return sorted(map(str, data["case"].values), key=NO_FAULT.__eq__)


def case_title(case: str, data: xarray.Dataset, number: str = "") -> str:
    """(b) without a fault, (a) with one, as in the paper; numbered where there are several."""
    return "(b) no fault" if case == NO_FAULT else f"(a{number}) motor {data.attrs['fault_motor']} {case}"
