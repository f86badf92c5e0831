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


def _draw(data: xarray.Dataset) -> Figure:
    """Arms beside each other in one scale of colours, a row for each observer."""
    from matplotlib.colors import LogNorm

    observers, arms = data["observer"].values, data["arm"].values
    figure, panels = style.column(len(observers), 1.6, len(arms))
    for k, row in enumerate(observers):
        axes = panels[k * len(arms) : (k + 1) * len(arms)]
        peaks = data["peak"].sel(observer=row).transpose("arm", data.attrs["y"], data.attrs["x"])
        norm = LogNorm(vmin=float(np.nanmin(peaks)), vmax=float(np.nanmax(peaks)))
        for ax, arm in zip(axes, arms, strict=True):
            cells = _cells(ax, data, peaks.sel(arm=arm).values, norm)
            _better(ax, data, peaks.sel(arm=arm).values, peaks.sel(arm="without").values)
            heading = f"disturbance observer {row}\n" if ax is axes[0] else ""
            size = style.TYPE if len(arms) < 3 else style.TYPE - 1.4
            title = f"{heading}{style.letter(panels.index(ax))} {ARM_WORDS[str(arm)]}"
            ax.set_title(title, fontsize=size, loc="left", pad=3)
            tidy = {"labelsize": style.TYPE - 1, "length": 2, "pad": 2}
            ax.tick_params(**tidy, labelleft=ax is axes[0], labelbottom=row == observers[-1])
        axes[0].set_ylabel(_axis(data[data.attrs["y"]]), fontsize=style.TYPE)
        style.log_axis(style.colour_bar(figure, cells, axes, style.unit_label(data["peak"])).ax.yaxis)
    figure.supxlabel(_axis(data[data.attrs["x"]]), fontsize=style.TYPE)
    return figure


def _cells(ax: Axes, data: xarray.Dataset, peaks: np.ndarray, norm: LogNorm) -> QuadMesh:
    """Peaks as colours; empty cells with a small x diverged, a white cross is the preset."""
    from matplotlib import colormaps

    x, y = (data[data.attrs[axis]] for axis in "xy")
    values = np.ma.masked_invalid(peaks)
    colours = colormaps["viridis"].with_extremes(bad=(0.0, 0.0, 0.0, 0.0))
    seamless = {"edgecolors": "face", "linewidth": 0.3}  # else a browser shows hairlines between cells
    picture = ax.pcolormesh(_borders(x), _borders(y), values, cmap=colours, norm=norm, **seamless)
    rows, columns = np.nonzero(values.mask)
    ax.plot(x.values[columns], y.values[rows], "x", color=INK, markersize=1.8, markeredgewidth=0.4)
    ax.set(xscale=x.attrs["scale"], yscale=y.attrs["scale"])
    for axis, values_of, ticks in ((ax.xaxis, x, 12 // data.sizes["arm"]), (ax.yaxis, y, 6)):
        if values_of.attrs["scale"] == "log":
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


def _better(ax: Axes, data: xarray.Dataset, own: np.ndarray, other: np.ndarray) -> None:
    """Dots where an arm is better than the one without fault control."""
    rows, columns = np.nonzero((own < other) | (np.isnan(other) & ~np.isnan(own)))
    x, y = (data[data.attrs[axis]].values for axis in "xy")
    ax.plot(x[columns], y[rows], ".", color="white", markersize=1.2)


def _axis(array: xarray.DataArray) -> str:
    unit = array.attrs["units"]
    return style.raised(array.attrs["long_name"] + (f" [{unit}]" if unit != "1" else ""))


def _picture(name: str, title: str, claims: str, caption: str) -> Picture:
    marks = "Dots: better than known factors; empty cells with a small x: diverged; white cross: the preset."
    return Picture(name, title, f"{caption} {marks}", claims, _draw)


PICTURES = (
    _picture(
        "map-time",
        "Loss of thrust by the instant of the fault",
        "C7a C7b A1",
        "Peak of the ROV after the fault.",
    ),
    _picture(
        "map-factors",
        "Stuck value by the error of the known factors",
        "C7a C7b A1 A3",
        "Peak of the ROV after the fault. Fault control uses no factors, so its columns are equal.",
    ),
    _picture(
        "map-rates",
        "Start of the adaptation by its rate",
        "A2 A3",
        "Peak of the ROV after motor 2 has died. With known factors nothing adapts, so all cells are equal.",
    ),
)
