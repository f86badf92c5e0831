"""A fault seen as a load by the disturbance observer."""

from __future__ import annotations

from collections.abc import Iterator

import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures.picture import Picture, abreast
from umbilical.papers.rao2022.figures.style import LOOKS, Panel, over_time, pair

CASES = {case: cell(case, "without") for case in ("dead", "stuck")}


def _data(runs: Runs) -> xarray.Dataset:
    """D and its estimate beside the load itself, known factors, after a fault."""
    names = ("payload_force", "disturbance", "disturbance_estimate")
    return xarray.Dataset({n: abreast({c: runs[name][n] for c, name in CASES.items()}, "case") for n in names})


def _panels(data: xarray.Dataset) -> Iterator[Panel]:
    for case in data["case"].values:
        load = data["payload_force"].sel(case=case).assign_attrs(data["disturbance"].attrs), LOOKS["load"]
        yield Panel(f"motor {data.attrs['fault_motor']} {case}", [load, *pair(data, "disturbance", case=case)])


PICTURE = Picture(
    "absorption",
    "Why nothing diverges",
    "After a fault, without fault control: the estimate follows load and lost thrust together.",
    "C7a C9",
    over_time(_panels, 1.15, 4),
    tuple(CASES.values()),
    _data,
    CASES["dead"],
)
