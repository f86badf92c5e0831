"""The whole cable over time under three controllers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import CONTROLLERS, THREE, Picture, along

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROWS = 500
"""Of pixels along the cable, more than a panel has."""


def spacetime(runs: Runs) -> xarray.Dataset:
    """y(x,t) under three controllers, thinned to what a figure of this size shows."""
    thin = slice(None, None, 4)
    shares = np.linspace(0.0, 1.0, 51)
    maps = []
    for name in CONTROLLERS.values():
        y = runs[name]["displacement"].isel(time=thin)
        nodes = runs[name]["sigma"].values
        values = np.array([np.interp(shares, nodes, row) for row in y.values])
        words = runs[name]["sigma"].attrs
        maps.append(
            xarray.DataArray(
                values, {"time": y["time"], "sigma": ("sigma", shares, words)}, ("time", "sigma"), attrs=y.attrs
            )
        )
    length = runs["free"]["length"].isel(time=thin)
    return xarray.Dataset({"displacement": along(maps, "controller", list(CONTROLLERS)), "length": length})


def draw_spacetime(data: xarray.Dataset) -> Figure:
    """``displacement`` over ``controller``, ``time`` and ``sigma``; the coloured region ends where the cable ends."""
    y = data["displacement"]
    figure, panels = style.column(y.sizes["controller"], 1.45)
    for number, (ax, who) in enumerate(zip(panels, y["controller"].values, strict=True)):
        _cable(figure, ax, y.sel(controller=who), data["length"])
        style.panel(ax, f"{style.letter(number)} {style.LOOKS[str(who)].text}", "$x$ [m]")
        ax.grid(visible=False)
    style.time_panels(panels, data)
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
    bar = figure.colorbar(picture, ax=ax, pad=0.02)
    unit = style.unit_label(y)
    bar.set_label(unit.replace("[", f"[$10^{{{power}}}$ ") if power else unit, fontsize=style.TYPE)
    bar.ax.tick_params(labelsize=style.TYPE - 1, length=2, pad=2)


PICTURE = Picture(
    "spacetime",
    "The cable over time",
    "Displacement of the whole cable, vessel at the top; each panel has its own scale.",
    draw_spacetime,
    THREE,
    spacetime,
)
