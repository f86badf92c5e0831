"""Figs. 3 and 4: the cable at four places under three controllers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.papers.rao2022.drawing.style import (
    column,
    legend,
    letter,
    line,
    log_axis,
    panel,
    time_panels,
    unit_label,
)

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


def draw_positions(data: xarray.Dataset) -> Figure:
    """Fig. 3: ``displacement`` over ``controller``, ``place`` and ``time``; the ROV at the bottom."""
    y = data["displacement"]
    figure, panels = column(y.sizes["place"], 0.95)
    for number, (ax, place) in enumerate(zip(panels, y["place"].values, strict=True)):
        for who in y["controller"].values:
            line(ax, y.sel(controller=who, place=place), str(who))
        panel(ax, f"{letter(number)} $x = {place}$", unit_label(y))
    time_panels(panels, data)
    legend(figure)
    return figure


def draw_midpoint(data: xarray.Dataset) -> Figure:
    """Fig. 4: ``magnitude`` of the midpoint over ``controller`` and ``time``, on a logarithmic axis."""
    y = data["magnitude"]
    figure, (ax,) = column(1, 2.0)
    for who in y["controller"].values:
        line(ax, y.sel(controller=who), str(who))
    panel(ax, "", unit_label(y))
    ax.set_yscale("log")
    ax.set_ylim(1e-5, 2.0 * float(np.nanmax(y.values)))
    log_axis(ax.yaxis)
    time_panels([ax], data)
    legend(figure)
    return figure
