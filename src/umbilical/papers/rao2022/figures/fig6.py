"""Fig. 6: the ROV with and without a fault, with and without fault control."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import ARMS, CASES, Runs, cell
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import Picture, by_case

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def boundary(runs: Runs) -> xarray.Dataset:
    """Fig. 6: y(l,t) in every case with and without fault control."""
    data = by_case(runs, "tip_displacement", CASES)
    data["tip_displacement"].attrs["symbol"] = "y(l,t)"
    return data


def draw_boundary(data: xarray.Dataset) -> Figure:
    """Fig. 6: ``tip_displacement`` over ``case``, ``arm`` and ``time``; (a) each fault, (b) none."""
    y = data["tip_displacement"]
    cases = [*(c for c in y["case"].values if c != style.NO_FAULT), style.NO_FAULT]
    figure, panels = style.column(len(cases), 1.0)
    for ax, case in zip(panels, cases, strict=True):
        for arm in y["arm"].values:
            style.line(ax, y.sel(case=case, arm=arm), str(arm))
        style.panel(ax, style.case_title(str(case), data, str(cases.index(case) + 1)), style.unit_label(y))
    style.mark_cases(panels, cases, data)
    style.legend(figure, 3)
    return figure


PICTURE = Picture(
    "fig6",
    "Fig. 6",
    "The ROV (a) with a fault of motor 2, three kinds of it, and (b) without one; thrust factors known, and fault "
    "control.",
    draw_boundary,
    tuple(cell(case, arm) for case in CASES for arm in ARMS),
    boundary,
    cell("stuck", "with"),
)
