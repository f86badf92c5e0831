"""Fig. 3: the cable at four places under three controllers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import CONTROLLERS, THREE, Picture, along
from umbilical.plots.cable import PLACES
from umbilical.plots.figure import at_sigma

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def positions(runs: Runs) -> xarray.Dataset:
    """Fig. 3: y at four places under three controllers."""
    places = [
        along(
            [at_sigma(run, share).assign_attrs(run["displacement"].attrs) for share in PLACES.values()],
            "place",
            [*PLACES],
        )
        for run in map(runs.__getitem__, CONTROLLERS.values())
    ]
    return xarray.Dataset({"displacement": along(places, "controller", list(CONTROLLERS))})


def draw_positions(data: xarray.Dataset) -> Figure:
    """Fig. 3: ``displacement`` over ``controller``, ``place`` and ``time``; the ROV at the bottom."""
    y = data["displacement"]
    figure, panels = style.column(y.sizes["place"], 0.95)
    for number, (ax, place) in enumerate(zip(panels, y["place"].values, strict=True)):
        for who in y["controller"].values:
            style.line(ax, y.sel(controller=who, place=place), str(who))
        style.panel(ax, f"{style.letter(number)} $x = {place}$", style.unit_label(y))
    style.time_panels(panels, data)
    style.legend(figure)
    return figure


PICTURE = Picture(
    "fig3",
    "Fig. 3",
    "Displacement at l/4, l/2, 3l/4 and l without control, with PD and with the proposed law, which is the line "
    "at zero.",
    draw_positions,
    THREE,
    positions,
)
