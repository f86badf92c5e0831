"""Maps: the peak of the ROV after a fault over two numbers, without fault control, with it, and with it in a box."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import Picture

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.collections import QuadMesh
    from matplotlib.colors import LogNorm
    from matplotlib.figure import Figure

ARM_WORDS = {"without": "known factors", "with": "fault control", "boxed": r"$\kappa$ in a box"}
"""Short enough for a third of a column."""
INK = "#000000"
"""Becomes the text's colour on a page, in the light and in the dark."""


def draw_map(data: xarray.Dataset) -> Figure:
    """``peak`` over ``observer``, ``arm``, and the two dimensions named in ``data.attrs``.

    Empty cells with a small x diverged; dots mark where an arm is better than known factors; the cross is the preset.
    """
    observers, arms = data["observer"].values, data["arm"].values
    figure, panels = style.column(len(observers), 1.6, len(arms))
    for row, observer in enumerate(observers):
        own = panels[row * len(arms) : (row + 1) * len(arms)]
        _row(figure, own, data, str(observer))
        for place, (ax, arm) in enumerate(zip(own, arms, strict=True)):
            title = f"{style.letter(row * len(arms) + place)} {ARM_WORDS[str(arm)]}"
            heading = "" if place else f"disturbance observer {observer}\n"
            _labels(ax, data, heading + title, place == 0, row == len(observers) - 1)
    figure.supxlabel(_axis(data[data.attrs["x"]]), fontsize=style.TYPE)
    return figure


def _row(figure: Figure, panels: list[Axes], data: xarray.Dataset, observer: str) -> None:
    """The arms beside each other in one scale of colours."""
    from matplotlib.colors import LogNorm

    peaks = data["peak"].sel(observer=observer)
    norm = LogNorm(vmin=float(np.nanmin(peaks)), vmax=float(np.nanmax(peaks)))
    pictures = [_cells(ax, peaks.sel(arm=arm), data, norm) for ax, arm in zip(panels, data["arm"].values, strict=True)]
    for ax, arm in zip(panels, data["arm"].values, strict=True):
        _better(ax, peaks.sel(arm=arm), peaks.sel(arm="without"), data)
    bar = figure.colorbar(pictures[0], ax=panels, pad=0.02)
    bar.set_label(style.unit_label(data["peak"]), fontsize=style.TYPE)
    bar.ax.tick_params(labelsize=style.TYPE - 1, length=2, pad=2)
    style.log_axis(bar.ax.yaxis)


def _cells(ax: Axes, peaks: xarray.DataArray, data: xarray.Dataset, norm: LogNorm) -> QuadMesh:
    from matplotlib import colormaps

    x, y = data.attrs["x"], data.attrs["y"]
    values = np.ma.masked_invalid(peaks.transpose(y, x).values)
    colours = colormaps["viridis"].with_extremes(bad=(0.0, 0.0, 0.0, 0.0))
    seamless = {"edgecolors": "face", "linewidth": 0.3}  # else a browser shows hairlines between cells
    picture = ax.pcolormesh(_borders(data[x]), _borders(data[y]), values, cmap=colours, norm=norm, **seamless)
    rows, columns = np.nonzero(values.mask)
    ax.plot(data[x].values[columns], data[y].values[rows], "x", color=INK, markersize=1.8, markeredgewidth=0.4)
    ax.set_xscale(data[x].attrs["scale"])
    ax.set_yscale(data[y].attrs["scale"])
    for axis, name, ticks in ((ax.xaxis, x, 12 // data.sizes["arm"]), (ax.yaxis, y, 6)):
        if data[name].attrs["scale"] == "log":
            style.log_axis(axis, ticks)
    ax.plot(data.attrs["paper_x"], data.attrs["paper_y"], "+", color="white", markersize=5, markeredgewidth=1.0)
    return picture


def _borders(axis: xarray.DataArray) -> np.ndarray:
    """Where the cells around some values end: in the middle between them, on their own scale."""
    log = axis.attrs["scale"] == "log"
    values = np.log(axis.values) if log else axis.values
    half = np.diff(values) / 2.0
    borders = np.concatenate([[values[0] - half[0]], values[:-1] + half, [values[-1] + half[-1]]])
    return np.exp(borders) if log else borders


def _better(ax: Axes, peaks: xarray.DataArray, without: xarray.DataArray, data: xarray.Dataset) -> None:
    """Dots where an arm is better than the one without fault control."""
    x, y = data.attrs["x"], data.attrs["y"]
    own, other = (values.transpose(y, x).values for values in (peaks, without))
    better = (own < other) | (np.isnan(other) & ~np.isnan(own))
    rows, columns = np.nonzero(better)
    ax.plot(data[x].values[columns], data[y].values[rows], ".", color="white", markersize=1.2)


def _labels(ax: Axes, data: xarray.Dataset, title: str, leftmost: bool, lowest: bool) -> None:
    size = style.TYPE if data.sizes["arm"] < 3 else style.TYPE - 1.4
    ax.set_title(title, fontsize=size, loc="left", pad=3)
    ax.tick_params(labelsize=style.TYPE - 1, length=2, pad=2, labelleft=leftmost, labelbottom=lowest)
    if leftmost:
        ax.set_ylabel(_axis(data[data.attrs["y"]]), fontsize=style.TYPE)


def _axis(array: xarray.DataArray) -> str:
    unit = array.attrs["units"]
    return style.raised(array.attrs["long_name"] + (f" [{unit}]" if unit != "1" else ""))


MARKS = "Dots: better than known factors; empty cells with a small x: diverged; white cross: the preset."
PICTURES = (
    Picture(
        "map-time",
        "Loss of thrust by the instant of the fault",
        f"Peak of the ROV after the fault. {MARKS}",
        draw_map,
    ),
    Picture(
        "map-factors",
        "Stuck value by the error of the known factors",
        f"Peak of the ROV after the fault. Fault control uses no factors, so its columns are equal. {MARKS}",
        draw_map,
    ),
    Picture(
        "map-rates",
        "Start of the adaptation by its rate",
        f"Peak of the ROV after motor 2 has died. With known factors nothing adapts, so all cells are equal. {MARKS}",
        draw_map,
    ),
)
