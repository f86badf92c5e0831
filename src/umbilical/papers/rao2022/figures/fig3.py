"""Fig. 3: the cable at four places under three controllers."""

from __future__ import annotations

from collections.abc import Iterator

import xarray

from umbilical import Run
from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures.picture import CONTROLLERS, Picture, abreast, by_controller
from umbilical.papers.rao2022.figures.style import Panel, lines_of, over_time
from umbilical.plots.cable import PLACES
from umbilical.plots.figure import at_sigma


def _data(runs: Runs) -> xarray.Dataset:
    """y at four places under three controllers."""

    def places(run: Run) -> xarray.DataArray:
        words = run["displacement"].attrs
        return abreast({name: at_sigma(run, share).assign_attrs(words) for name, share in PLACES.items()}, "place")

    return xarray.Dataset({"displacement": by_controller(runs, places)})


def _panels(data: xarray.Dataset) -> Iterator[Panel]:
    for place in data["place"].values:
        yield Panel(f"$x = {place}$", lines_of(data, "displacement", "controller", place=place))


PICTURE = Picture(
    "fig3",
    "Fig. 3",
    "Displacement at l/4, l/2, 3l/4 and l without control, with PD and with the proposed law, which is the line "
    "at zero.",
    "C1 C2 C3",
    over_time(_panels, 0.95),
    tuple(CONTROLLERS.values()),
    _data,
)
