"""The whole cable over time under three controllers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray

from umbilical import Run
from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import CONTROLLERS, Picture, by_controller

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROWS = 500
"""Of pixels along the cable, more than a panel has."""
THIN = slice(None, None, 4)
"""Of the samples, those that a figure of this size shows."""


def _data(runs: Runs) -> xarray.Dataset:
    """y(x,t) under three controllers, thinned."""
    shares = np.linspace(0.0, 1.0, 51)

    def thinned(run: Run) -> xarray.DataArray:
        y, sigma = run["displacement"].isel(time=THIN), run["sigma"]
        values = np.array([np.interp(shares, sigma.values, row) for row in y.values])
        coordinates = {"time": y["time"], "sigma": ("sigma", shares, sigma.attrs)}
        return xarray.DataArray(values, coordinates, ("time", "sigma"), attrs=y.attrs)

    length = runs["free"]["length"].isel(time=THIN)
    return xarray.Dataset({"displacement": by_controller(runs, thinned), "length": length})


def _draw(data: xarray.Dataset) -> Figure:
    """The coloured region ends where the cable ends."""
    y = data["displacement"]
    figure, panels = style.column(y.sizes["controller"], 1.45)
    for number, (ax, who) in enumerate(zip(panels, y["controller"].values, strict=True)):
        _cable(figure, ax, y.sel(controller=who), data["length"])
        style.dress_panel(ax, f"{style.letter(number)} {style.LOOKS[str(who)].text}", "$x$ [m]")
        style.time_axis(ax, data, labelled=ax is panels[-1])
        ax.grid(visible=False)
    return figure


def _cable(figure: Figure, ax: Axes, y: xarray.DataArray, length: xarray.DataArray) -> None:
    """One map with its own colours; a power of ten stands in the label, so that all bars are alike."""
    times, longest = y["time"].values, float(length.max())
    x = np.linspace(0.0, longest, ROWS)
    ends = zip(length.values, y.values, strict=True)
    values = np.array([np.interp(x, y["sigma"].values * end, row, right=np.nan) for end, row in ends])
    size = float(np.abs(y.values).max())
    power = 3 * int(np.floor(np.log10(size) / 3.0))
    look = {"cmap": "RdBu_r", "vmin": -size / 10.0**power, "vmax": size / 10.0**power, "aspect": "auto"}
    picture = ax.imshow(values.T / 10.0**power, extent=(times[0], times[-1], longest, 0.0), **look)
    unit = style.unit_label(y)
    style.colour_bar(figure, picture, ax, unit.replace("[", f"[$10^{{{power}}}$ ") if power else unit)


PICTURE = Picture(
    "spacetime",
    "The cable over time",
    "Displacement of the whole cable, vessel at the top; each panel has its own scale.",
    "C1 C2",
    _draw,
    tuple(CONTROLLERS.values()),
    _data,
)
