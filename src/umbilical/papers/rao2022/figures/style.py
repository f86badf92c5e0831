"""What the figures of a paper share: one column's width, small type, one look for each line, panels with letters."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from umbilical.plots.figure import COLOURS, QUIET, axis_label, new_figure

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

COLUMN_WIDTH = 85.0 / 25.4
"""Inches; one column of a page of A4 with two."""
TYPE = 7.0
"""Points, when the figure is printed as wide as it is."""
RESOLUTION = 300
"""Dots per inch of a PNG."""
NO_FAULT = "none"
FAULT_WORDS = {"none": "no fault", "dead": "motor 2 dead"}


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


def column(rows: int, height: float, columns: int = 1) -> tuple[Figure, list[Axes]]:
    """A figure as wide as a column, with panels row by row; ``height`` of one row in inches."""
    figure = new_figure(COLUMN_WIDTH, rows * height + 0.25)
    engine = figure.get_layout_engine()
    assert engine is not None
    engine.set(w_pad=0.02, h_pad=0.02, hspace=0.02, wspace=0.02)  # type: ignore[call-arg]
    panels = figure.subplots(rows, columns, squeeze=False)
    return figure, list(panels.ravel())


def line(ax: Axes, array: xarray.DataArray, who: str, text: str | None = None) -> None:
    """One array over time in the look of ``who``; it is named in the legend, unless ``text`` is empty."""
    look = LOOKS[who]
    name = look.text if text is None else text
    (drawn,) = ax.plot(array["time"].values, array.values, color=look.colour, linewidth=look.width, label=name or None)
    if look.dashes:
        drawn.set_dashes(look.dashes)


def panel(ax: Axes, title: str, ylabel: str, xlabel: str = "") -> None:
    """Title at the left, labels, ticks and grid in the type of the page."""
    from matplotlib.ticker import MaxNLocator

    ax.set_title(title, fontsize=TYPE, loc="left", pad=3)
    ax.set_ylabel(ylabel, fontsize=TYPE)
    ax.set_xlabel(xlabel, fontsize=TYPE)
    ax.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10], min_n_ticks=3))
    ax.tick_params(labelsize=TYPE - 0.5, length=2, pad=2)
    ax.grid(alpha=0.25, linewidth=0.4)
    ax.spines[["top", "right"]].set_visible(False)
    for side in ("left", "bottom"):
        ax.spines[side].set_linewidth(0.6)


def time_panels(panels: Sequence[Axes], data: xarray.Dataset, *, marked: bool = True) -> None:
    """Panels over the same time: one axis of time at the bottom; the fault, if any, is marked in all or in none."""
    time = data["time"]
    for ax in panels:
        ax.set_xlim(float(time[0]), float(time[-1]))
        if marked and "fault_time" in data.attrs:
            mark_fault(ax, float(data.attrs["fault_time"]))
        if ax is not panels[-1]:
            ax.tick_params(labelbottom=False)
    panels[-1].set_xlabel(f"{time.attrs['long_name']} [{time.attrs['units']}]", fontsize=TYPE)


def mark_fault(ax: Axes, instant: float) -> None:
    """The instant a motor fails; the legend names it, where no curve can run over the word."""
    ax.axvline(instant, color=QUIET, linewidth=0.7, linestyle="--", zorder=0.5, label="fault")


def legend(figure: Figure, columns: int = 3) -> None:
    """The names of all lines, each once, above the whole figure, where no curve is."""
    named = {name: handle for ax in figure.axes for handle, name in zip(*ax.get_legend_handles_labels(), strict=True)}
    names = sorted(named, key="fault".__eq__)
    figure.legend(
        [named[name] for name in names],
        names,
        loc="outside upper center",
        ncols=columns,
        fontsize=TYPE,
        frameon=False,
        borderpad=0.1,
        handlelength=2.2,
        columnspacing=1.2,
    )


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


def pair(ax: Axes, truth: xarray.DataArray, estimate: xarray.DataArray, title: str) -> None:
    """A truth and its estimate in one panel."""
    line(ax, truth, "truth")
    line(ax, estimate, "estimate")
    panel(ax, title, unit_label(truth))


def pair_near(
    ax: Axes, truth: xarray.DataArray, estimate: xarray.DataArray, window: tuple[float, float], title: str
) -> None:
    """A pair over a part of the time."""
    part = slice(*window)
    pair(ax, truth.sel(time=part), estimate.sel(time=part), title)
    time_panels([ax], truth.sel(time=part).to_dataset(name="part"))


def case_title(case: str, data: xarray.Dataset, number: str = "") -> str:
    """(b) without a fault, (a) with one, as in the paper; numbered where there are several."""
    return "(b) no fault" if case == NO_FAULT else f"(a{number}) motor {data.attrs['fault_motor']} {case}"


def mark_cases(panels: list[Axes], cases: list[str], data: xarray.Dataset) -> None:
    """The axis of time, and the fault where there is one."""
    time_panels(panels, data, marked=False)
    for ax, case in zip(panels, cases, strict=True):
        if case != NO_FAULT:
            mark_fault(ax, float(data.attrs["fault_time"]))


def draw_motors(data: xarray.Dataset, name: str) -> Figure:
    """A channel over ``case``, ``motor``, ``arm`` and ``time``."""
    values = data[name]
    cases = [*(c for c in values["case"].values if c != NO_FAULT), NO_FAULT]
    shown = [case for case in cases for _ in values["motor"].values]
    motors = [*values["motor"].values] * len(cases)
    figure, panels = column(len(shown), 0.95)
    for ax, case, motor in zip(panels, shown, motors, strict=True):
        for arm in values["arm"].values:
            line(ax, values.sel(case=case, arm=arm, motor=motor), str(arm))
        panel(ax, f"{case_title(str(case), data)}: motor {motor}", unit_label(values))
    mark_cases(panels, shown, data)
    legend(figure, 3)
    return figure
