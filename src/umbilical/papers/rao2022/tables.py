"""A dataset of any dimensions as a table of text."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from umbilical.formats import csv_of, shown_in_csv

if TYPE_CHECKING:
    import xarray


def to_csv(data: xarray.Dataset) -> bytes:
    """The dataset as CSV: what it is, the unit of every column, names, numbers.

    With ``time``, a row for each instant and a column for each of everything else (``displacement pd l/2``);
    without, a row for each cell.
    """
    return csv_of(data.attrs["title"], _over_time(data) if "time" in data.dims else _cells(data))


def _over_time(data: xarray.Dataset) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, unit and values of every column, time first; what does not depend on time is left out."""
    yield "time", data["time"].attrs["units"], data["time"].values
    for name, array in data.data_vars.items():
        if "time" not in array.dims:
            continue
        others = [dim for dim in array.dims if dim != "time"]
        for place in product(*(range(array.sizes[dim]) for dim in others)):
            one = array.isel(dict(zip(others, place, strict=True)))
            words = [shown_in_csv(data[dim].values[k]) for dim, k in zip(others, place, strict=True)]
            yield " ".join([str(name), *words]), array.attrs["units"], one.values


def _cells(data: xarray.Dataset) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, unit and values of every column: the coordinates of each cell, then the variables there."""
    dims = [str(dim) for dim in data[next(iter(data.data_vars))].dims]
    places = list(product(*(data[dim].values for dim in dims)))
    for k, dim in enumerate(dims):
        yield dim, data[dim].attrs.get("units", ""), np.array([place[k] for place in places], dtype=object)
    for name, array in data.data_vars.items():
        yield str(name), array.attrs["units"], array.transpose(*dims).values.ravel()
