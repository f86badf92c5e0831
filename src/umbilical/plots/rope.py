"""The rope: its shape in two views, and the tension along it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.plots.figure import axes_for, axis_label, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.run import Run

SHAPES = 9
"""Instants at which a shape is drawn."""
LEAST_SHARE = 0.02
"""Least half width of a view over its height, so that round-off does not look like a shape."""


def plot_shape(run: Run) -> Figure:
    """The cable from the side in both vertical planes, at instants through the run, m; later ones are darker.

    Raises:
        ValueError: the run is of a string, which has one plane: its displacement is in :func:`plot_cable`.
    """
    _of_a_rope(run)
    figure = new_figure(9.0, 6.0)
    views = figure.subplots(1, 2, sharey=True)
    place = run["position"].values
    chosen = np.unique(np.linspace(0, place.shape[0] - 1, SHAPES).round().astype(int))
    for axis, (ax, name) in enumerate(zip(views, "xy", strict=True)):
        for order, k in enumerate(chosen):
            ax.plot(place[k, axis], place[k, 2], color="C0", alpha=0.25 + 0.75 * order / max(chosen.size - 1, 1))
            ax.plot(place[k, axis, -1], place[k, 2, -1], "o", color="C1", markersize=4)
        ax.set_xlabel(f"${name}$ [m]")
        middle = 0.5 * float(place[:, axis].min() + place[:, axis].max())
        half = max(0.6 * float(np.ptp(place[:, axis])), LEAST_SHARE * float(np.ptp(place[:, 2])))
        ax.set_xlim(middle - half, middle + half)
        ax.grid(visible=True, alpha=0.3)
    views[0].set_ylabel("height $z$ [m]")
    figure.suptitle(f"{run.scenario.name}: shape of the cable, {run['time'].values[0]:g} to {run.end_time:g} s")
    return figure


def plot_tension(run: Run, *, ax: Axes | None = None) -> Axes:
    """Smallest, mean and largest tension along the cable over the run, N; where the smallest is 0 it was slack.

    Raises:
        ValueError: the run is of a string.
    """
    _of_a_rope(run)
    ax = axes_for(run, ax)
    pull, sigma = run["tension"], run["sigma"].values
    ax.fill_betweenx(sigma, pull.min("time"), pull.max("time"), alpha=0.25, label="smallest to largest")
    ax.plot(pull.mean("time"), sigma, label="mean")
    ax.axvline(0.0, color="0.3", linewidth=0.8)
    ax.set_xlabel(axis_label(pull))
    ax.set_ylabel(r"$\sigma = x/l$, 0 at the vessel")
    ax.set_ylim(1.0, 0.0)
    ax.set_title(f"{run.scenario.name}: tension along the cable", loc="left")
    ax.legend()
    return ax


def _of_a_rope(run: Run) -> None:
    if "position" not in run.data:
        raise ValueError(f'{run.scenario.name}: a run of the string has no shape in space; set model = "rope"')
