"""Figs. 5 and 9, and what the disturbance observer makes of a fault: estimates on top of the truth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.papers.rao2022.drawing.style import column, legend, letter, line, panel, time_panels, unit_label

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


START_OVER = 2.0
"""s after which the jump of the load at the start has passed the ROV."""
MANY_SWINGS = 100
"""Changes of sign beyond which a curve becomes a band."""


def draw_states(data: xarray.Dataset) -> Figure:
    """Fig. 5: ``tip_velocity`` and ``tip_slope_rate`` over ``time`` with their estimates; z2 also near its peak."""
    velocity, rate = data["tip_velocity"], data["tip_slope_rate"]
    figure, panels = column(3, 1.2)
    _pair(panels[0], velocity, data["tip_velocity_estimate"], f"(a) {_first(velocity)}")
    _pair(panels[1], rate, data["tip_slope_rate_estimate"], f"(b) {_first(rate)}")
    time_panels(panels[:2], data)
    peak = float(abs(rate).sel(time=slice(START_OVER, None)).idxmax("time"))
    _near(panels[2], rate, data["tip_slope_rate_estimate"], (peak - 0.5, peak + 1.0), "(c) the same, near")
    legend(figure)
    return figure


def draw_disturbances(data: xarray.Dataset) -> Figure:
    """Fig. 9: ``disturbance`` of the ROV, ``motor_disturbance`` of each ``motor``, with their estimates.

    A motor whose disturbance swings too often for the width of a column is shown over the first two seconds.
    """
    truth, estimate = data["motor_disturbance"], data["motor_disturbance_estimate"]
    figure, panels = column(1 + truth.sizes["motor"], 1.2)
    _pair(panels[0], data["disturbance"], data["disturbance_estimate"], "(a) disturbance of the ROV")
    time_panels(panels[:1], data)
    for ax, number in zip(panels[1:], truth["motor"].values, strict=True):
        title = f"{letter(int(number))} scaled voltage disturbance, motor {number}"
        one, other = truth.sel(motor=number), estimate.sel(motor=number)
        if _swings(one) > MANY_SWINGS:
            _near(ax, one, other, (0.0, 2.0), title)
        else:
            _pair(ax, one, other, title)
            time_panels([ax], data)
    legend(figure)
    return figure


def _swings(array: xarray.DataArray) -> int:
    return int(np.count_nonzero(np.diff(np.sign(array.values))))


def _near(
    ax: Axes, truth: xarray.DataArray, estimate: xarray.DataArray, window: tuple[float, float], title: str
) -> None:
    """A pair over a part of the time."""
    part = slice(*window)
    _pair(ax, truth.sel(time=part), estimate.sel(time=part), title)
    time_panels([ax], truth.sel(time=part).to_dataset(name="part"))


def draw_absorption(data: xarray.Dataset) -> Figure:
    """A fault seen as a load: ``disturbance`` and its estimate over ``case``, beside the load itself."""
    cases = data["case"].values
    figure, panels = column(len(cases), 1.15)
    for number, (ax, case) in enumerate(zip(panels, cases, strict=True)):
        one = data.sel(case=case)
        line(ax, one["payload_force"], "load")
        _pair(
            ax,
            one["disturbance"],
            one["disturbance_estimate"],
            f"{letter(number)} motor {data.attrs['fault_motor']} {case}",
        )
    time_panels(panels, data)
    legend(figure, 4)
    return figure


def _pair(ax: Axes, truth: xarray.DataArray, estimate: xarray.DataArray, title: str) -> None:
    line(ax, truth, "truth")
    line(ax, estimate, "estimate")
    panel(ax, title, unit_label(truth))


def _first(array: xarray.DataArray) -> str:
    return str(array.attrs["long_name"])
