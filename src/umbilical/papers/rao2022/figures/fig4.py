"""Fig. 4: the midpoint under three controllers."""

from __future__ import annotations

import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures.picture import CONTROLLERS, Picture, by_controller
from umbilical.papers.rao2022.figures.style import Panel, lines_of, over_time
from umbilical.plots.figure import at_sigma


def _data(runs: Runs) -> xarray.Dataset:
    """\\|y(l/2,t)\\| under three controllers."""
    words = {"units": "m", "symbol": "|y(l/2,t)|", "long_name": "size of the displacement at the midpoint"}
    return xarray.Dataset({"magnitude": by_controller(runs, lambda run: abs(at_sigma(run, 0.5)).assign_attrs(words))})


def _panels(data: xarray.Dataset) -> list[Panel]:
    top = 2.0 * float(data["magnitude"].max())
    return [Panel("", lines_of(data, "magnitude", "controller"), bottom=1e-5, top=top, log=True)]


PICTURE = Picture(
    "fig4",
    "Fig. 4",
    "Size of the displacement at the midpoint; logarithmic, so that all three controllers show.",
    "C4",
    over_time(_panels, 2.0),
    tuple(CONTROLLERS.values()),
    _data,
)
