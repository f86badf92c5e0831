"""Where the ROV is, and what pushes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical.plots.figure import axes_for, axis_label, draw, finish

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.run import Run


def plot_tip(run: Run, *, ax: Axes | None = None) -> Axes:
    """Displacement of the ROV over time, m."""
    ax = axes_for(run, ax)
    y = run["tip_displacement"]
    draw(ax, y)
    return finish(ax, run, y.attrs["long_name"], axis_label(y))


def plot_thrust(run: Run, *, ax: Axes | None = None) -> Axes:
    """Thrust as delivered and as commanded over time, N."""
    ax = axes_for(run, ax)
    draw(ax, run["thrust"], "delivered")
    draw(ax, run["thrust_command"], "commanded", colour=1, dashed=True)
    return finish(ax, run, "thrust", axis_label(run["thrust"]))
