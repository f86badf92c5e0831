"""Estimates on top of the truth."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical.plots.figure import axes_for, axis_label, draw, finish

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.run import Run

ESTIMATES = {
    "tip_velocity": "tip_velocity_estimate",
    "tip_slope_rate": "tip_slope_rate_estimate",
    "disturbance": "disturbance_estimate",
    "motor_disturbance": "motor_disturbance_estimate",
}
"""Truths and the estimates of them."""


def estimated(run: Run) -> list[str]:
    """Truths that an observer of this run estimated; one that never left zero was not running."""
    return [truth for truth, estimate in ESTIMATES.items() if estimate in run.data and bool(run[estimate].any())]


def plot_observers(run: Run, channel: str = "disturbance", *, motor: int = 1, ax: Axes | None = None) -> Axes:
    """A truth and its estimate over time; ``channel`` is a key of ``ESTIMATES``, ``motor`` counts from 1.

    Raises:
        ValueError: nothing of that name was estimated in this run, or there is no such motor.
    """
    known = estimated(run)
    if channel not in known:
        raise ValueError(
            f"{run.scenario.name}: {channel} was not estimated; estimated: {', '.join(known) or 'nothing'}"
        )
    truth, estimate = run[channel], run[ESTIMATES[channel]]
    title = truth.attrs["long_name"].partition(":")[0]
    if "motor" in truth.dims:
        if motor not in truth["motor"].values:
            raise ValueError(f"{run.scenario.name}: there is no motor {motor}")
        truth, estimate, title = truth.sel(motor=motor), estimate.sel(motor=motor), f"{title}, motor {motor}"
    ax = axes_for(run, ax)
    draw(ax, truth, "truth")
    draw(ax, estimate, "estimate", colour=1, dashed=True)
    return finish(ax, run, title, axis_label(truth))
