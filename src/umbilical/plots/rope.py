"""The rope: its shape in two views, the tension along it and over time with its snaps, the circle it keeps watch in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.plots.figure import COLOURS, QUIET, axes_for, axis_label, draw_channel, dress, finish, new_figure

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
        ValueError: the run is of a string, which has one plane: its displacement is in :func:`umbilical.plot_cable`.
    """
    _of_a_rope(run)
    figure = new_figure(9.0, 6.0)
    views = figure.subplots(1, 2, sharey=True)
    place = run["position"].values
    chosen = np.unique(np.linspace(0, place.shape[0] - 1, SHAPES).round().astype(int))
    for axis, (ax, name) in enumerate(zip(views, "xy", strict=True)):
        for order, k in enumerate(chosen):
            ax.plot(place[k, axis], place[k, 2], color=COLOURS[0], alpha=0.25 + 0.75 * order / max(chosen.size - 1, 1))
            ax.plot(place[k, axis, -1], place[k, 2, -1], "o", color=COLOURS[1], markersize=4)
        middle = 0.5 * float(place[:, axis].min() + place[:, axis].max())
        half = max(0.6 * float(np.ptp(place[:, axis])), LEAST_SHARE * float(np.ptp(place[:, 2])))
        dress(ax, xlabel=f"${name}$ [m]", xlim=(middle - half, middle + half))
    views[0].set_ylabel("height $z$ [m]")
    figure.suptitle(f"{run.name}: shape of the cable, {run['time'].values[0]:g} to {run.end_time:g} s")
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
    slack, share = float(run["slack_length"].max()), run.metrics["slack_share"]
    told = f"slack on up to {slack:.3g} m, in {100.0 * share:.3g} % of the time" if share else "never slack"
    ax.set(xlabel=axis_label(pull), ylabel=r"$\sigma = x/l$, 0 at the vessel", xlim=(0.0, None), ylim=(1.0, 0.0))
    return dress(ax, f"{run.name}: tension along the cable, {told}")


def plot_tensions(run: Run, *, ax: Axes | None = None) -> Axes:
    """Tension at the vessel, at the body and the smallest along the cable over time; slack is shaded, snaps are marked.

    Raises:
        ValueError: the run is of a string.
    """
    _of_a_rope(run)
    ax = axes_for(run, ax)
    draw_channel(ax, run["top_tension"], "at the vessel", colour=0)
    draw_channel(ax, run["end_tension"], "at the body", colour=1)
    draw_channel(ax, run["lowest_tension"], "smallest along the cable", colour=6, dashed=True)
    time, slack = run["time"].values, run["slack_length"].values > 0.0
    if slack.any():
        where = {"where": slack.tolist(), "transform": ax.get_xaxis_transform(), "label": "slack somewhere"}
        ax.fill_between(time, 0.0, 1.0, color=QUIET, alpha=0.25, linewidth=0.0, **where)
    if (snaps := run.snaps).size:
        ax.plot(snaps[:, 0], snaps[:, 1], "v", color="black", markersize=5, label=f"{snaps.shape[0]} snaps")
    return finish(ax, run, "tension", axis_label(run["tension"]))


def plot_watch(run: Run, *, ax: Axes | None = None) -> Axes:
    """Path of the body from above, m, and the circle about its start that it stays within.

    Raises:
        ValueError: the run is of a string.
    """
    _of_a_rope(run)
    ax = axes_for(run, ax)
    x, y = run["body_position"].values[:, 0], run["body_position"].values[:, 1]
    radius, round_ = run.metrics["watch_radius"], np.linspace(0.0, 2.0 * np.pi, 181)
    ax.plot(x, y, color=COLOURS[0], linewidth=1.0, label="body")
    ax.plot(x[0], y[0], "o", color=COLOURS[2], label="start")
    ax.plot(x[-1], y[-1], "s", color=COLOURS[1], label="end")
    name = f"watch circle, {radius:.3g} m"
    ax.plot(x[0] + radius * np.cos(round_), y[0] + radius * np.sin(round_), "--", color=QUIET, label=name)
    ax.set(xlabel="$x$ [m]", ylabel="$y$ [m]", aspect="equal")
    beside = {"loc": "upper left", "bbox_to_anchor": (1.0, 1.0)}
    return dress(ax, f"{run.name}: the body from above", beside)


def _of_a_rope(run: Run) -> None:
    if "position" not in run.data:
        raise ValueError(f'{run.name}: a run of the string has no shape in space; set model = "rope"')
