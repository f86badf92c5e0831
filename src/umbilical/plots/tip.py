"""Where the ROV is, and what pushes it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from umbilical.plots.figure import axes_for, axis_label, draw, finish
from umbilical.run import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_tip(run: Run | Sequence[Run], *, names: Sequence[str] = (), ax: Axes | None = None) -> Axes:
    """Displacement of the ROV over time, m; of several runs one line each, named by ``names`` or by scenario.

    Args:
        run: one result or several.
        names: a name for each of several.
        ax: axes to draw into; those of a figure of its own if left out.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_tip([run, run], names=["one", "the same"]).get_ylabel()
    '$x_1$ [m]'
    """
    runs: list[Any] = [*run] if isinstance(run, list | tuple) else [run]
    if not runs:
        raise ValueError("there is no run to draw")
    ax = axes_for(runs[0], ax)
    labels = list(names) or ([one.scenario.name for one in runs] if len(runs) > 1 else [""])
    for number, (one, label) in enumerate(zip(runs, labels, strict=True)):
        draw(ax, one["tip_displacement"], label, colour=number)
    y = runs[0]["tip_displacement"]
    return finish(ax, runs[0], y.attrs["long_name"], axis_label(y))


def plot_thrust(run: Run, *, ax: Axes | None = None) -> Axes:
    """Thrust as delivered and as commanded over time, N."""
    ax = axes_for(run, ax)
    draw(ax, run["thrust"], "delivered")
    draw(ax, run["thrust_command"], "commanded", colour=1, dashed=True)
    return finish(ax, run, "thrust", axis_label(run["thrust"]))
