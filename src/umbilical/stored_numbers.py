"""Numbers of a stored run that contradict each other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray

METRIC = "metric_"
"""Before the name of a metric in a file."""
PEAKS = {
    "tip_displacement": "tip_peak",
    "slope": "slope_peak",
    "thrust": "thrust_peak",
    "motor_speed": "motor_speed_peak",
    "motor_voltage": "motor_voltage_peak",
    "motor_current": "motor_current_peak",
}
"""Channels and the metric that none of their samples exceeds, for metrics are of every control sample."""
LARGEST_STORED = 1e100
"""No number of a completed run is larger."""


def wrong_values(data: xarray.Dataset) -> Iterator[str]:
    """What no run has that was completed: infinite numbers, metrics that are none, samples beyond their own metric."""
    for name in map(str, data.data_vars):
        largest = np.abs(data[name].values).max(initial=0.0) if data[name].dtype.kind == "f" else 0.0
        metric = METRIC + PEAKS.get(name, "")
        if largest > LARGEST_STORED or (name.startswith(METRIC) and np.isnan(largest)):
            yield f"{name}: reaches {largest:g}, which no completed run does"
        elif metric in data.variables and not largest <= (limit := float(data[metric])) * (1.0 + 1e-9):
            yield f"{name}: reaches {largest:g}, and {PEAKS[name]} is {limit:g}"


def wrong_times(data: xarray.Dataset, duration: float, *, over: bool) -> Iterator[str]:
    """What of the instants contradicts the end of the run, or that the scenario's duration, s."""
    end, last = float(data.attrs["end_time"]), data["time"].values[-1:]
    if end > duration * (1.0 + 1e-9) or (over and end < duration * (1.0 - 1e-9)):
        yield f"end_time = {end:g}: {data.attrs['status']}, and the scenario inside lasts {duration:g} s"
    elif (last > end * (1.0 + 1e-9)).any():
        yield f"time: goes on to {last[0]:g} s, and end_time is {end:g} s"
    elif data.attrs["status"] == "DIVERGED" and (last > end * (1.0 - 1e-9)).any():
        yield f"time: has a sample at {last[0]:g} s, the instant at which a diverged run has none any more"
