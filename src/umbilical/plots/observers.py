"""Estimates on top of the truth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.errors import expect
from umbilical.plots.figure import axes_for, axis_label, draw, finish

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

    from umbilical.run import Run

FAST, SHOWN_TURNS = 80, 20
"""Of a signal that changes sides more often than the first, so many changes are shown."""
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

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.
        channel: the truth that was estimated.
        motor: of a motor's channel, which, from 1.
        ax: axes to draw into; those of a figure of its own if left out.

    Raises:
        ValueError: nothing of that name was estimated in this run, or there is no such motor.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_observers(run).get_ylabel()
    '$D$ [N]'
    """
    expect(run, "Run", "open_run")
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
    shown = _first_turns(truth)
    if shown < truth.sizes["time"]:
        truth, estimate = truth.isel(time=slice(shown)), estimate.isel(time=slice(shown))
        title = f"{title}: the first {float(truth['time'][-1]):.3g} s"
    draw(ax, truth, "truth")
    draw(ax, estimate, "estimate", colour=1, dashed=True)
    return finish(ax, run, title, axis_label(truth))


def _first_turns(truth: xarray.DataArray) -> int:
    """Samples that are shown: of a fast signal so many that its estimate can be told from it."""
    values = truth.values
    aside = values - 0.5 * (values.max() + values.min())
    far = np.flatnonzero(np.abs(aside) > 0.1 * np.abs(aside).max())  # a ripple on a slow curve does not count
    crossings = far[1:][np.diff(aside[far] > 0.0)]
    return int(crossings[SHOWN_TURNS]) + 1 if crossings.size > FAST else values.size
