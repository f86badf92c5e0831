"""The Lyapunov function of the proof along two runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import Picture
from umbilical.papers.rao2022.lyapunov import lyapunov
from umbilical.plots.figure import COLOURS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lyapunov_parts(runs: Runs) -> xarray.Dataset:
    """V(t) and its parts without a fault and with a dead motor, known factors."""
    cases = {"no fault": cell("none", "without"), "motor 2 dead": cell("dead", "without")}
    found = {case: lyapunov(runs[name]) for case, name in cases.items()}
    parts = list(found["no fault"])
    values = np.array([[found[case][part] for part in parts] for case in cases])
    time = runs[cell("none", "without")]["time"]
    words = {"units": "J", "symbol": "V", "long_name": "Lyapunov function of the proof, gamma = 1"}
    return xarray.Dataset(
        {"lyapunov": (("case", "part", "time"), values, words)}, {"case": list(cases), "part": parts, "time": time}
    )


def draw_lyapunov(data: xarray.Dataset) -> Figure:
    """``lyapunov`` over ``case``, ``part`` and ``time``, on a logarithmic axis; V_2 changes sign, its size is drawn."""
    values = data["lyapunov"]
    figure, panels = style.column(values.sizes["case"], 1.5)
    for number, (ax, case) in enumerate(zip(panels, values["case"].values, strict=True)):
        ax.plot(values["time"], values.sel(case=case, part="V"), color=COLOURS[5], linewidth=3.0, label="$V$")
        for who, part in (("proposed", "V_1"), ("load", "V_2"), ("pd", "V_3")):
            style.line(ax, abs(values.sel(case=case, part=part)), who, f"$|{part}|$" if part == "V_2" else f"${part}$")
        style.panel(ax, f"{style.letter(number)} {case}", style.unit_label(values))
        ax.set_yscale("log")
        ax.set_ylim(1e-9, 2.0 * float(values.max()))
        style.log_axis(ax.yaxis)
    style.time_panels(panels, data, marked=False)
    style.mark_fault(panels[-1], float(data.attrs["fault_time"]))
    style.legend(figure, 5)
    return figure


PICTURE = Picture(
    "lyapunov",
    "V(t)",
    "The Lyapunov function of the proof along two runs, and its parts. It falls between pushes of the load; V3 "
    "jumps at the fault, because D does.",
    draw_lyapunov,
    (cell("none", "without"), cell("dead", "without")),
    lyapunov_parts,
    cell("dead", "without"),
)
