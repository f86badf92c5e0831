"""A dataset of any dimensions as a table of text."""

from __future__ import annotations

import io
from collections.abc import Iterator
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray


def to_csv(data: xarray.Dataset) -> bytes:
    """The dataset as CSV: what it is, the unit of every column, names, numbers.

    With ``time``, a row for each instant and a column for each of everything else (``displacement pd l/2``);
    without, a row for each cell.
    """
    columns = list(_over_time(data) if "time" in data.dims else _cells(data))
    head = [f"# {data.attrs['title']}", "# " + ",".join(unit for _, unit, _ in columns)]
    text = io.StringIO()
    text.write("\n".join([*head, ",".join(name for name, _, _ in columns)]) + "\n")
    rows = zip(*(map(_shown, values) for _, _, values in columns), strict=True)
    text.writelines(",".join(row) + "\n" for row in rows)
    return text.getvalue().encode()


def _over_time(data: xarray.Dataset) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, unit and values of every column, time first; what does not depend on time is left out."""
    yield "time", data["time"].attrs["units"], data["time"].values
    for name, array in data.data_vars.items():
        if "time" not in array.dims:
            continue
        others = [dim for dim in array.dims if dim != "time"]
        for place in product(*(range(array.sizes[dim]) for dim in others)):
            one = array.isel(dict(zip(others, place, strict=True)))
            words = [_shown(data[dim].values[k]) for dim, k in zip(others, place, strict=True)]
            yield " ".join([str(name), *words]), array.attrs["units"], one.values


def _cells(data: xarray.Dataset) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, unit and values of every column: the coordinates of each cell, then the variables there."""
    dims = [str(dim) for dim in data[next(iter(data.data_vars))].dims]
    places = list(product(*(data[dim].values for dim in dims)))
    for k, dim in enumerate(dims):
        yield dim, data[dim].attrs.get("units", ""), np.array([place[k] for place in places], dtype=object)
    for name, array in data.data_vars.items():
        yield str(name), array.attrs["units"], array.transpose(*dims).values.ravel()


def _shown(value: object) -> str:
    """A number with all its digits, a word as it is, nothing where there is no number."""
    if isinstance(value, float | np.floating):
        return "" if np.isnan(value) else repr(float(value))
    return str(value)
