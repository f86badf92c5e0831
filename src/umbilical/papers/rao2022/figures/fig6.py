"""Fig. 6: the ROV with and without a fault, with and without fault control."""

from __future__ import annotations

from collections.abc import Iterator

import xarray

from umbilical.papers.rao2022.experiments import ARMS, CASES, Runs, cell
from umbilical.papers.rao2022.figures.picture import Picture, by_case
from umbilical.papers.rao2022.figures.style import NO_FAULT, Panel, case_title, faults_first, lines_of, over_time


def _data(runs: Runs) -> xarray.Dataset:
    """y(l,t) in every case with and without fault control."""
    data = by_case(runs, "tip_displacement", CASES)
    data["tip_displacement"].attrs["symbol"] = "y(l,t)"
    return data


def _panels(data: xarray.Dataset) -> Iterator[Panel]:
    """(a) each fault, (b) none."""
    for number, case in enumerate(faults_first(data), start=1):
        lines = lines_of(data, "tip_displacement", "arm", case=case)
        yield Panel(case_title(case, data, str(number)), lines, marked=case != NO_FAULT)


PICTURE = Picture(
    "fig6",
    "Fig. 6",
    "The ROV (a) with a fault of motor 2, three kinds of it, and (b) without one; thrust factors known, and fault "
    "control.",
    "C6 C7a C7b C7c C11 T1 T3",
    over_time(_panels, 1.0),
    tuple(cell(case, arm) for case in CASES for arm in ARMS),
    _data,
    cell("stuck", "with"),
)
