"""Where the adaptive law helps, where it harms, and what a box changes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.papers.rao2022.drawing.style import (
    LOOKS,
    TYPE,
    column,
    legend,
    letter,
    line,
    log_axis,
    panel,
    time_panels,
    unit_label,
)
from umbilical.plots.figure import COLOURS, QUIET

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


FAULT_WORDS = {"none": "no fault", "dead": "motor 2 dead"}
LARGEST_KAPPA = 5.0
"""rad2/(N s2), ten times the exact value: beyond, the loop has gone."""


def draw_adaptation(data: xarray.Dataset) -> Figure:
    """``tip_size`` and ``kappa_0`` over ``arm`` and ``time``; an arm ends where its run diverged."""
    figure, panels = column(2, 1.6)
    for number, (ax, name) in enumerate(zip(panels, ("tip_size", "kappa_0"), strict=True)):
        for arm in data["arm"].values:
            values = data[name].sel(arm=arm).dropna("time")
            line(ax, values, str(arm))
            if values.sizes["time"] < data.sizes["time"]:
                ax.plot(
                    values["time"][-1],
                    min(float(values[-1]), LARGEST_KAPPA),
                    "x",
                    color=LOOKS[arm].colour,
                    ms=4,
                    clip_on=False,
                )
        panel(ax, f"{letter(number)} {data[name].attrs['long_name']}", unit_label(data[name]))
    panels[0].set_yscale("log")
    panels[0].set_ylim(bottom=1e-3)
    log_axis(panels[0].yaxis)
    panels[1].set_ylim(0.0, LARGEST_KAPPA)
    time_panels(panels, data)
    legend(figure, 2)
    return figure


def draw_gain(data: xarray.Dataset) -> Figure:
    """``peak`` over ``observer``, ``case``, ``arm`` and ``gain``; a cross at the top where the run diverged."""
    figure, panels = column(data.sizes["observer"], 1.5)
    for number, (ax, observer) in enumerate(zip(panels, data["observer"].values, strict=True)):
        _scan(ax, data["peak"].sel(observer=observer))
        panel(ax, f"{letter(number)} disturbance observer {observer}; x: diverged", unit_label(data["peak"]))
        ax.set_xscale("log")
        ax.set_yscale("log")
        log_axis(ax.xaxis)
        log_axis(ax.yaxis)
        ax.axvline(1.0, color=QUIET, linewidth=0.7, linestyle=":")
        ax.tick_params(labelbottom=ax is panels[-1])
    panels[-1].set_xlabel(str(data["gain"].attrs["long_name"]), fontsize=TYPE)
    legend(figure, 2)
    return figure


def _scan(ax: Axes, peaks: xarray.DataArray) -> None:
    """A line for each case and arm, and a row of crosses where it has no value."""
    gains = peaks["gain"].values
    pairs = [(case, arm) for case in peaks["case"].values for arm in peaks["arm"].values]
    for k, (case, arm) in enumerate(pairs):
        values = peaks.sel(case=case, arm=arm).values
        lost = gains[np.isnan(values)]
        name = f"{FAULT_WORDS[str(case)]}, {LOOKS[str(arm)].text}"
        ax.plot(gains, values, ".-", color=COLOURS[k], linewidth=0.9, markersize=3, label=name)
        height = np.full(lost.size, 0.97 - 0.06 * k)
        ax.plot(lost, height, "x", color=COLOURS[k], markersize=3.5, transform=ax.get_xaxis_transform())
