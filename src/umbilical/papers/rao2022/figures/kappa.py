"""The weights of the adaptive allocation with their ideal values."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures.picture import Picture, abreast, allocation_weights
from umbilical.papers.rao2022.figures.style import LOOKS, Panel, over_time

CASES = {case: cell(case, "with") for case in ("dead", "stuck")}


def _data(runs: Runs) -> xarray.Dataset:
    """kappa_0 and the sum of the offsets, with the values that would deliver what is commanded."""
    found = {case: allocation_weights(runs[name]) for case, name in CASES.items()}
    names = found["dead"].keys()
    return xarray.Dataset({name: abreast({c: weights[name] for c, weights in found.items()}, "case") for name in names})


def _panels(data: xarray.Dataset) -> Iterator[Panel]:
    adapted = LOOKS["with"]._replace(text="adapted")
    for case, name in product(data["case"].values, ("kappa_0", "kappa_sum")):
        one = data.sel(case=case)
        lines = [(one[name], adapted), (one[f"{name}_ideal"], LOOKS["ideal"])]
        yield Panel(f"motor {data.attrs['fault_motor']} {case}", lines)


PICTURE = Picture(
    "kappa",
    "kappa(t)",
    "The adaptive allocation: kappa_0 and the sum of the offsets, with the values that would deliver what is "
    "commanded.",
    "C7b",
    over_time(_panels, 0.95),
    tuple(CASES.values()),
    _data,
    CASES["dead"],
)
