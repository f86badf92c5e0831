"""Figs. 6 to 8: with and without a fault, with and without fault control."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical.papers.rao2022.drawing.style import column, legend, line, mark_fault, panel, time_panels, unit_label

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HEALTHY = "none"


def draw_boundary(data: xarray.Dataset) -> Figure:
    """Fig. 6: ``tip_displacement`` over ``case``, ``arm`` and ``time``; (a) each fault, (b) none."""
    y = data["tip_displacement"]
    cases = [*(c for c in y["case"].values if c != HEALTHY), HEALTHY]
    figure, panels = column(len(cases), 1.0)
    for ax, case in zip(panels, cases, strict=True):
        for arm in y["arm"].values:
            line(ax, y.sel(case=case, arm=arm), str(arm))
        panel(ax, _title(str(case), data, str(cases.index(case) + 1)), unit_label(y))
    _mark(panels, cases, data)
    legend(figure, 3)
    return figure


def draw_speeds(data: xarray.Dataset) -> Figure:
    """Fig. 7: ``motor_speed`` over ``case``, ``motor``, ``arm`` and ``time``."""
    return _motors(data, "motor_speed")


def draw_voltages(data: xarray.Dataset) -> Figure:
    """Fig. 8: ``motor_voltage`` over ``case``, ``motor``, ``arm`` and ``time``."""
    return _motors(data, "motor_voltage")


def _motors(data: xarray.Dataset, name: str) -> Figure:
    values = data[name]
    cases = [*(c for c in values["case"].values if c != HEALTHY), HEALTHY]
    shown = [case for case in cases for _ in values["motor"].values]
    motors = [*values["motor"].values] * len(cases)
    figure, panels = column(len(shown), 0.95)
    for ax, case, motor in zip(panels, shown, motors, strict=True):
        for arm in values["arm"].values:
            line(ax, values.sel(case=case, arm=arm, motor=motor), str(arm))
        panel(ax, f"{_title(str(case), data)}: motor {motor}", unit_label(values))
    _mark(panels, shown, data)
    legend(figure, 3)
    return figure


def _title(case: str, data: xarray.Dataset, number: str = "") -> str:
    """(b) without a fault, (a) with one, as in the paper; numbered where there are several."""
    return "(b) no fault" if case == HEALTHY else f"(a{number}) motor {data.attrs['fault_motor']} {case}"


def _mark(panels: list[Axes], cases: list[str], data: xarray.Dataset) -> None:
    """The axis of time, and the fault where there is one."""
    time_panels(panels, data, marked=False)
    for ax, case in zip(panels, cases, strict=True):
        if case != HEALTHY:
            mark_fault(ax, float(data.attrs["fault_time"]))
