"""Columns of a file by name, with their units: what stands there, as numbers, nothing yet chosen or converted."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from umbilical import files
from umbilical.columns import delimited
from umbilical.errors import FileError

_NETCDF = (b"\x89HDF", b"CDF\x01", b"CDF\x02")


@dataclass(frozen=True)
class Columns:
    """What a file holds.

    Attributes:
        origin: what to call the file.
        names: of the columns.
        units: as the file gives them; empty where it gives none.
        values: each of the shape (rows,); NaN where a cell is blank. Dates are seconds since 1970.
        dates: names of the columns that were dates.
        lines: where each row stands in the file, counted from 1.
    """

    origin: str
    names: tuple[str, ...]
    units: dict[str, str]
    values: dict[str, np.ndarray]
    dates: frozenset[str]
    lines: np.ndarray


def read_columns(path: Path, content: bytes | None = None) -> Columns:
    """Read a CSV or NetCDF file.

    CSV: a line of names, each with its unit as in ``sway [m]`` or in a line of its own; comma, semicolon or tabulator
    between columns; a decimal comma where the separator is none; UTF-8 or what spreadsheets write beside it.

    Args:
        path: the file.
        content: its bytes, where they are read already.

    Raises:
        FileError: it is missing, empty, damaged, or a cell holds neither a number nor a date.
    """
    data = files.read(path) if content is None else content
    if data.startswith(_NETCDF):
        return _of_netcdf(data, str(path))
    parsed = delimited.parse_delimited(delimited.decode(data, str(path)), str(path))
    return Columns(str(path), *parsed)


def _of_netcdf(content: bytes, origin: str) -> Columns:
    """Every variable over the one dimension that most of them share."""
    import xarray

    engine = "h5netcdf" if content.startswith(_NETCDF[0]) else "scipy"
    try:
        with xarray.open_dataset(io.BytesIO(content), engine=engine, decode_times=False) as data:
            loaded = data.load()
    except Exception as error:  # whatever a decoder stumbles over, the file is what is wrong
        raise FileError(f"{origin}: the file is damaged or no NetCDF ({type(error).__name__})") from error
    variables = loaded.variables.items()
    lists = {str(name): array for name, array in variables if array.ndim == 1 and array.dtype.kind in "fiu"}
    dims = [array.dims[0] for array in lists.values()]
    if not dims:
        raise FileError(f"{origin}: holds no variable over one dimension")
    shared = max(dict.fromkeys(dims), key=lambda dim: (dims.count(dim), dim == "time"))
    chosen = {name: array for name, array in lists.items() if array.dims[0] == shared}
    ordered = dict(sorted(chosen.items(), key=lambda item: item[0] != str(shared)))
    units = {name: str(array.attrs.get("units", "")) for name, array in ordered.items()}
    dates = frozenset(name for name, unit in units.items() if " since " in unit)
    # Of ``days since 1970-01-01`` the number counts, not the day.
    units = {name: unit.split(" since ")[0] for name, unit in units.items()}
    values = {name: array.values.astype(float) for name, array in ordered.items()}
    return Columns(origin, tuple(units), units, values, dates, np.arange(1, loaded.sizes[shared] + 1))
