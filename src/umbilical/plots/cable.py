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
COLUMNS, ROWS = 900, 400
"""Instants and depths in a map; more would not show."""


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
    values, deepest = _seen(run)
    size = float(abs(y).max()) or 1.0
    where = (float(run["time"][0]), float(run["time"][-1]), deepest, 0.0)
    picture = ax.imshow(values, cmap="RdBu_r", vmin=-size, vmax=size, extent=where, aspect="auto")
    as_figure(ax).colorbar(picture, ax=ax, label=axis_label(y), format="%.3g", pad=0.02)
    finish(ax, run, y.attrs["long_name"], "distance from the vessel $x$ [m]")
    ax.grid(visible=False)
    return ax


def _seen(run: Run) -> tuple[np.ndarray, float]:
    """Displacement in rows of equal depth and columns of equal time, NaN below the cable's end, and the largest depth.

    A mesh that follows the cable would be drawn triangle by triangle: seconds.
    """
    time, sigma = run["time"].values, run["sigma"].values
    columns = time[0] + (np.arange(COLUMNS) + 0.5) / COLUMNS * (time[-1] - time[0])
    nearest = np.searchsorted((time[1:] + time[:-1]) / 2.0, columns)
    length, y = run["length"].values[nearest], run["displacement"].values[nearest]
    deepest = float(run["length"].max())
    depth = (np.arange(ROWS) + 0.5) / ROWS * deepest
    seen = [np.interp(depth, sigma * end, row, right=np.nan) for end, row in zip(length, y, strict=True)]
    return np.transpose(seen), deepest


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
