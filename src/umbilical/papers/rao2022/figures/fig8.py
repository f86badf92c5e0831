"""Fig. 8: motor voltages, stuck motor and no fault."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import STUCK, Picture, by_case

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def voltages(runs: Runs) -> xarray.Dataset:
    """Fig. 8: motor voltages, stuck motor and no fault."""
    return by_case(runs, "motor_voltage", ("none", "stuck"))


def draw_voltages(data: xarray.Dataset) -> Figure:
    """Fig. 8: ``motor_voltage`` over ``case``, ``motor``, ``arm`` and ``time``."""
    return style.draw_motors(data, "motor_voltage")


PICTURE = Picture(
    "fig8",
    "Fig. 8",
    "Motor voltages (a) with motor 2 stuck from 10 s on and (b) without a fault.",
    draw_voltages,
    STUCK,
    voltages,
    cell("stuck", "with"),
)
