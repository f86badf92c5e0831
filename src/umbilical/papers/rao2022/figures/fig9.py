"""Fig. 9: the disturbances with their estimates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import HEALTHY, Picture, with_estimates

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MANY_SWINGS = 100
"""Changes of sign beyond which a curve becomes a band."""


def disturbances(runs: Runs) -> xarray.Dataset:
    """Fig. 9: the disturbances with their estimates."""
    return with_estimates(runs[cell("none", "without")], "disturbance", "motor_disturbance")


def draw_disturbances(data: xarray.Dataset) -> Figure:
    """Fig. 9: ``disturbance`` of the ROV, ``motor_disturbance`` of each ``motor``, with their estimates.

    A motor whose disturbance swings too often for the width of a column is shown over the first two seconds.
    """
    truth, estimate = data["motor_disturbance"], data["motor_disturbance_estimate"]
    figure, panels = style.column(1 + truth.sizes["motor"], 1.2)
    style.pair(panels[0], data["disturbance"], data["disturbance_estimate"], "(a) disturbance of the ROV")
    style.time_panels(panels[:1], data)
    for ax, number in zip(panels[1:], truth["motor"].values, strict=True):
        title = f"{style.letter(int(number))} scaled voltage disturbance, motor {number}"
        one, other = truth.sel(motor=number), estimate.sel(motor=number)
        if _swings(one) > MANY_SWINGS:
            style.pair_near(ax, one, other, (0.0, 2.0), title)
        else:
            style.pair(ax, one, other, title)
            style.time_panels([ax], data)
    style.legend(figure)
    return figure


def _swings(array: xarray.DataArray) -> int:
    return int(np.count_nonzero(np.diff(np.sign(array.values))))


PICTURE = Picture(
    "fig9",
    "Fig. 9",
    "What the controller sees as disturbance of the ROV, and the voltage disturbance of each motor, with estimates.",
    draw_disturbances,
    HEALTHY,
    disturbances,
)
