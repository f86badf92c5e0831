"""The cable: a map over time and depth, and four places along it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.plots.figure import as_figure, at_sigma, axes_for, axis_label, draw_channel, finish

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.run import Run

PLACES = {"l/4": 0.25, "l/2": 0.5, "3l/4": 0.75, "l": 1.0}
"""Where the paper's Fig. 3 looks, as shares of the length."""
COLUMNS = 600
"""Instants in a map; more would not show."""


def plot_cable(run: Run, *, ax: Axes | None = None) -> Axes:
    """Displacement (m) as colour over time (s) and distance from the vessel (m), which hangs down as the cable does.

    The coloured region ends where the cable ends, so paying out and hauling in show as they are.

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.
        ax: axes to draw into; those of a figure of its own if left out.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_cable(run).get_ylabel()
    'distance from the vessel $x$ [m]'
    """
    ax = axes_for(run, ax)
    y = run["displacement"]
    chosen = y.isel(time=slice(None, None, max(1, y.sizes["time"] // COLUMNS)))
    length = run["length"].sel(time=chosen["time"]).values
    depth = chosen["sigma"].values[None, :] * length[:, None]
    times = np.broadcast_to(chosen["time"].values[:, None], depth.shape)
    size = float(np.abs(chosen.values).max()) or 1.0
    colours = {"cmap": "RdBu_r", "vmin": -size, "vmax": size}
    picture = ax.pcolormesh(times, depth, chosen.values, shading="gouraud", rasterized=True, **colours)
    as_figure(ax).colorbar(picture, ax=ax, label=axis_label(y), format="%.3g", pad=0.02)
    finish(ax, run, y.attrs["long_name"], "distance from the vessel $x$ [m]")
    ax.grid(visible=False)
    ax.set_ylim(float(length.max()), 0.0)
    return ax


def plot_positions(run: Run, *, ax: Axes | None = None) -> Axes:
    """Displacement at l/4, l/2, 3l/4 and l over time, m.

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.
        ax: axes to draw into; those of a figure of its own if left out.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> len(umbilical.plot_positions(run).lines)
    4
    """
    ax = axes_for(run, ax)
    for number, (name, sigma) in enumerate(PLACES.items()):
        draw_channel(ax, at_sigma(run, sigma), f"$x = {name}$", colour=number)
    y = run["displacement"]
    return finish(ax, run, "displacement", axis_label(y))
