"""A fault seen as a load by the disturbance observer."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import FAILED, Picture, along

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def absorption(runs: Runs) -> xarray.Dataset:
    """D and its estimate beside the load itself, known factors, after a fault."""
    names = ("payload_force", "disturbance", "disturbance_estimate")
    cases = ("dead", "stuck")
    return xarray.Dataset(
        {name: along([runs[cell(case, "without")][name] for case in cases], "case", list(cases)) for name in names}
    )


def draw_absorption(data: xarray.Dataset) -> Figure:
    """A fault seen as a load: ``disturbance`` and its estimate over ``case``, beside the load itself."""
    cases = data["case"].values
    figure, panels = style.column(len(cases), 1.15)
    for number, (ax, case) in enumerate(zip(panels, cases, strict=True)):
        one = data.sel(case=case)
        style.line(ax, one["payload_force"], "load")
        style.pair(
            ax,
            one["disturbance"],
            one["disturbance_estimate"],
            f"{style.letter(number)} motor {data.attrs['fault_motor']} {case}",
        )
    style.time_panels(panels, data)
    style.legend(figure, 4)
    return figure


PICTURE = Picture(
    "absorption",
    "Why nothing diverges",
    "After a fault, without fault control: the estimate follows load and lost thrust together.",
    draw_absorption,
    FAILED,
    absorption,
    cell("dead", "without"),
)
