"""The weights of the adaptive allocation with their ideal values."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import FAILED, Picture, along, weights

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def kappa(runs: Runs) -> xarray.Dataset:
    """kappa_0 and the sum of the offsets, with the values that would deliver what is commanded."""
    cases = ("dead", "stuck")
    chosen = [runs[cell(case, "with")] for case in cases]
    found = {name: along([weights(run)[name] for run in chosen], "case", list(cases)) for name in weights(chosen[0])}
    return xarray.Dataset(found)


def draw_kappa(data: xarray.Dataset) -> Figure:
    """``kappa_0`` and ``kappa_sum`` over ``case`` and ``time``, each with its ``ideal``, after the fault."""
    names = ("kappa_0", "kappa_sum")
    figure, panels = style.column(len(names) * data.sizes["case"], 0.95)
    places = [(case, name) for case in data["case"].values for name in names]
    for number, (ax, (case, name)) in enumerate(zip(panels, places, strict=True)):
        style.line(ax, data[name].sel(case=case), "with", "adapted")
        style.line(ax, data[f"{name}_ideal"].sel(case=case), "ideal", "ideal")
        style.panel(
            ax, f"{style.letter(number)} motor {data.attrs['fault_motor']} {case}", style.unit_label(data[name])
        )
    style.time_panels(panels, data)
    style.legend(figure)
    return figure


PICTURE = Picture(
    "kappa",
    "kappa(t)",
    "The adaptive allocation: kappa_0 and the sum of the offsets, with the values that would deliver what is "
    "commanded.",
    draw_kappa,
    FAILED,
    kappa,
    cell("dead", "with"),
)
