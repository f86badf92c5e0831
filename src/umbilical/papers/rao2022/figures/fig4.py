"""Fig. 4: the midpoint under three controllers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import CONTROLLERS, THREE, Picture, along
from umbilical.plots.figure import at_sigma

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def midpoint(runs: Runs) -> xarray.Dataset:
    """Fig. 4: |y(l/2,t)| under three controllers."""
    words = {"units": "m", "symbol": "|y(l/2,t)|", "long_name": "size of the displacement at the midpoint"}
    sizes = [abs(at_sigma(runs[name], 0.5)).assign_attrs(words) for name in CONTROLLERS.values()]
    return xarray.Dataset({"magnitude": along(sizes, "controller", list(CONTROLLERS))})


def draw_midpoint(data: xarray.Dataset) -> Figure:
    """Fig. 4: ``magnitude`` of the midpoint over ``controller`` and ``time``, on a logarithmic axis."""
    y = data["magnitude"]
    figure, (ax,) = style.column(1, 2.0)
    for who in y["controller"].values:
        style.line(ax, y.sel(controller=who), str(who))
    style.panel(ax, "", style.unit_label(y))
    ax.set_yscale("log")
    ax.set_ylim(1e-5, 2.0 * float(np.nanmax(y.values)))
    style.log_axis(ax.yaxis)
    style.time_panels([ax], data)
    style.legend(figure)
    return figure


PICTURE = Picture(
    "fig4",
    "Fig. 4",
    "Size of the displacement at the midpoint; logarithmic, so that all three controllers show.",
    draw_midpoint,
    THREE,
    midpoint,
)
