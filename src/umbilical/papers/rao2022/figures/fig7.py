"""Fig. 7: motor speeds, stuck motor and no fault."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import STUCK, Picture, by_case

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def speeds(runs: Runs) -> xarray.Dataset:
    """Fig. 7: motor speeds, stuck motor and no fault."""
    return by_case(runs, "motor_speed", ("none", "stuck"))


def draw_speeds(data: xarray.Dataset) -> Figure:
    """Fig. 7: ``motor_speed`` over ``case``, ``motor``, ``arm`` and ``time``."""
    return style.draw_motors(data, "motor_speed")


PICTURE = Picture(
    "fig7",
    "Fig. 7",
    "Motor speeds (a) with motor 2 stuck from 10 s on and (b) without a fault. The fault acts on the thrust: the "
    "motor still turns.",
    draw_speeds,
    STUCK,
    speeds,
    cell("stuck", "with"),
)
