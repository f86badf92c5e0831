"""Fig. 5: states of the ROV and what the high-gain observers make of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import HEALTHY, Picture, with_estimates

if TYPE_CHECKING:
    from matplotlib.figure import Figure

START_OVER = 2.0
"""s after which the jump of the load at the start has passed the ROV."""


def states(runs: Runs) -> xarray.Dataset:
    """Fig. 5: x2 and z2 with their estimates."""
    return with_estimates(runs[cell("none", "without")], "tip_velocity", "tip_slope_rate")


def draw_states(data: xarray.Dataset) -> Figure:
    """Fig. 5: ``tip_velocity`` and ``tip_slope_rate`` over ``time`` with their estimates; z2 also near its peak."""
    velocity, rate = data["tip_velocity"], data["tip_slope_rate"]
    figure, panels = style.column(3, 1.2)
    style.pair(panels[0], velocity, data["tip_velocity_estimate"], f"(a) {_first(velocity)}")
    style.pair(panels[1], rate, data["tip_slope_rate_estimate"], f"(b) {_first(rate)}")
    style.time_panels(panels[:2], data)
    peak = float(abs(rate).sel(time=slice(START_OVER, None)).idxmax("time"))
    style.pair_near(panels[2], rate, data["tip_slope_rate_estimate"], (peak - 0.5, peak + 1.0), "(c) the same, near")
    style.legend(figure)
    return figure


def _first(array: xarray.DataArray) -> str:
    return str(array.attrs["long_name"])


PICTURE = Picture(
    "fig5",
    "Fig. 5",
    "ROV velocity x2 and slope rate z2 with the estimates of the high-gain observers, (c) z2 "
    "near its largest value after the start; proposed law, no fault.",
    draw_states,
    HEALTHY,
    states,
)
