"""The gain of the allocation from which on the loop runs away."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np
import xarray

from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import Picture
from umbilical.plots.figure import COLOURS, QUIET

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CASE_WORDS = {"none": "no fault", "dead": "motor 2 dead"}


def _draw(data: xarray.Dataset) -> Figure:
    figure, panels = style.column(data.sizes["observer"], 1.5)
    for number, (ax, observer) in enumerate(zip(panels, data["observer"].values, strict=True)):
        _scan(ax, data["peak"].sel(observer=observer))
        title = f"{style.letter(number)} disturbance observer {observer}; x: diverged"
        style.dress_panel(ax, title, style.unit_label(data["peak"]))
        ax.set(xscale="log", yscale="log")
        style.log_axis(ax.xaxis)
        style.log_axis(ax.yaxis)
        ax.axvline(1.0, color=QUIET, linewidth=0.7, linestyle=":")
        ax.tick_params(labelbottom=ax is panels[-1])
    panels[-1].set_xlabel(str(data["gain"].attrs["long_name"]), fontsize=style.TYPE)
    style.legend(figure, 2)
    return figure


def _scan(ax: Axes, peaks: xarray.DataArray) -> None:
    """A line for each case and arm, and a row of crosses at the top where it diverged."""
    gains = peaks["gain"].values
    for k, (case, arm) in enumerate(product(peaks["case"].values, peaks["arm"].values)):
        values = peaks.sel(case=case, arm=arm).values
        lost = gains[np.isnan(values)]
        name = f"{CASE_WORDS[str(case)]}, {style.LOOKS[str(arm)].text}"
        ax.plot(gains, values, ".-", color=COLOURS[k], linewidth=0.9, markersize=3, label=name)
        height = np.full(lost.size, 0.97 - 0.06 * k)
        ax.plot(lost, height, "x", color=COLOURS[k], markersize=3.5, transform=ax.get_xaxis_transform())


PICTURE = Picture(
    "gain",
    "Where the loop runs away",
    "Peak of the ROV over the gain of the allocation at the start; motor 2 healthy, or dead from 0.1 s on. Crosses "
    "at the top: diverged.",
    "C6 C7a T3 A2",
    _draw,
)
