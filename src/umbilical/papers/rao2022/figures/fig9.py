"""Fig. 9: the disturbances with their estimates."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures.picture import HEALTHY, Picture, with_estimates
from umbilical.papers.rao2022.figures.style import Panel, over_time, pair

MANY_SWINGS = 100
"""Changes of sign beyond which a curve becomes a band."""


def _data(runs: Runs) -> xarray.Dataset:
    """The disturbances with their estimates."""
    return with_estimates(runs[HEALTHY], "disturbance", "motor_disturbance")


def _panels(data: xarray.Dataset) -> Iterator[Panel]:
    """A disturbance that swings too often for the width of a column is shown over the first two seconds."""
    yield Panel("disturbance of the ROV", pair(data, "disturbance"))
    for number in data["motor"].values:
        lines = pair(data, "motor_disturbance", motor=number)
        swings = np.count_nonzero(np.diff(np.sign(lines[0][0].values)))
        window = (0.0, 2.0) if swings > MANY_SWINGS else None
        yield Panel(f"scaled voltage disturbance, motor {number}", lines, window)


PICTURE = Picture(
    "fig9",
    "Fig. 9",
    "What the controller sees as disturbance of the ROV, and the voltage disturbance of each motor, with estimates.",
    "C9",
    over_time(_panels, 1.2),
    (HEALTHY,),
    _data,
)
