"""What the winch does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical.plots.figure import COLOURS, axes_for, axis_label, draw, finish

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.run import Run


def plot_winch(run: Run, *, ax: Axes | None = None) -> Axes:
    """Length of the cable (left, m) and winch speed (right, m/s; positive pays out) over time.

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.
        ax: axes to draw into; those of a figure of its own if left out.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_winch(run).get_ylabel()
    '$l$ [m]'
    """
    ax = axes_for(run, ax)
    draw(ax, run["length"], "length")
    ax.plot([], [], color=COLOURS[1], linestyle="--", label="speed, right")
    beside = ax.twinx()
    draw(beside, run["payout_speed"], colour=1, dashed=True)
    beside.set_ylabel(axis_label(run["payout_speed"]))
    beside.spines[["top"]].set_visible(False)
    return finish(ax, run, "winch", axis_label(run["length"]))


def moves(run: Run) -> bool:
    """Whether the winch pays out or hauls in."""
    return bool(run["payout_speed"].any())
