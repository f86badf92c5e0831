"""Fig. 5: states of the ROV and what the high-gain observers make of them."""

from __future__ import annotations

import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures.picture import HEALTHY, Picture, with_estimates
from umbilical.papers.rao2022.figures.style import Panel, over_time, pair

START_OVER = 2.0
"""s after which the jump of the load at the start has passed the ROV."""


def _data(runs: Runs) -> xarray.Dataset:
    """x2 and z2 with their estimates."""
    return with_estimates(runs[HEALTHY], "tip_velocity", "tip_slope_rate")


def _panels(data: xarray.Dataset) -> list[Panel]:
    """z2 also near its peak."""
    peak = float(abs(data["tip_slope_rate"]).sel(time=slice(START_OVER, None)).idxmax("time"))
    whole = [Panel(data[name].attrs["long_name"], pair(data, name)) for name in ("tip_velocity", "tip_slope_rate")]
    return [*whole, Panel("the same, near", whole[1].lines, window=(peak - 0.5, peak + 1.0))]


PICTURE = Picture(
    "fig5",
    "Fig. 5",
    "ROV velocity x2 and slope rate z2 with the estimates of the high-gain observers, (c) z2 "
    "near its largest value after the start; proposed law, no fault.",
    "C5 C10",
    over_time(_panels, 1.2),
    (HEALTHY,),
    _data,
)
