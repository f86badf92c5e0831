"""The gain of the allocation from which on the loop runs away."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray

from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import Picture
from umbilical.plots.figure import COLOURS, QUIET

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def draw_gain(data: xarray.Dataset) -> Figure:
    """``peak`` over ``observer``, ``case``, ``arm`` and ``gain``; a cross at the top where the run diverged."""
    figure, panels = style.column(data.sizes["observer"], 1.5)
    for number, (ax, observer) in enumerate(zip(panels, data["observer"].values, strict=True)):
        _scan(ax, data["peak"].sel(observer=observer))
        style.panel(
            ax, f"{style.letter(number)} disturbance observer {observer}; x: diverged", style.unit_label(data["peak"])
        )
        ax.set_xscale("log")
        ax.set_yscale("log")
        style.log_axis(ax.xaxis)
        style.log_axis(ax.yaxis)
        ax.axvline(1.0, color=QUIET, linewidth=0.7, linestyle=":")
        ax.tick_params(labelbottom=ax is panels[-1])
    panels[-1].set_xlabel(str(data["gain"].attrs["long_name"]), fontsize=style.TYPE)
    style.legend(figure, 2)
    return figure


def _scan(ax: Axes, peaks: xarray.DataArray) -> None:
    """A line for each case and arm, and a row of crosses where it has no value."""
    gains = peaks["gain"].values
    pairs = [(case, arm) for case in peaks["case"].values for arm in peaks["arm"].values]
    for k, (case, arm) in enumerate(pairs):
        values = peaks.sel(case=case, arm=arm).values
        lost = gains[np.isnan(values)]
        name = f"{style.FAULT_WORDS[str(case)]}, {style.LOOKS[str(arm)].text}"
        ax.plot(gains, values, ".-", color=COLOURS[k], linewidth=0.9, markersize=3, label=name)
        height = np.full(lost.size, 0.97 - 0.06 * k)
        ax.plot(lost, height, "x", color=COLOURS[k], markersize=3.5, transform=ax.get_xaxis_transform())


PICTURE = Picture(
    "gain",
    "Where the loop runs away",
    "Peak of the ROV over the gain of the allocation at the start; motor 2 healthy, or dead from 0.1 s on. Crosses "
    "at the top: diverged.",
    draw_gain,
)
