"""The file formats of a result: NetCDF4, which holds everything, and CSV and MAT for other tools.

Each is a function between a dataset and bytes. No clock, host or path enters them: equal datasets give equal bytes.
"""

from __future__ import annotations

import io
import platform
from collections.abc import Callable, Iterable, Iterator
from importlib.metadata import version
from numbers import Integral
from typing import TYPE_CHECKING

import numpy as np

from umbilical import __version__
from umbilical.errors import FileError
from umbilical.machine import in_words, memory

if TYPE_CHECKING:
    import xarray


RESULT_SCHEMA = 2
"""Version of the layout of a result file; raised when a reader of the old layout would misread the new one."""

_SIGNATURE = b"\x89HDF\r\n\x1a\n"


def versions() -> dict[str, str]:
    """What a result depends on beside its scenario: the version of this package, of numpy, numba and Python."""
    found = {"umbilical": __version__, "numpy": np.__version__, "numba": version("numba")}
    found["python"] = ".".join(platform.python_version_tuple()[:2])
    return {f"version_{name}": each for name, each in found.items()}


def to_netcdf(data: xarray.Dataset) -> bytes:
    """The dataset as a NetCDF4 (HDF5) file, for any reader of that format."""
    plain = {name: {"_FillValue": None} for name in data.variables}
    return bytes(data.to_netcdf(None, engine="h5netcdf", encoding=plain))


def from_netcdf(content: bytes, origin: str) -> xarray.Dataset:
    """The dataset in a NetCDF4 file of ours.

    Args:
        content: the whole file.
        origin: what to call it in an error.

    Raises:
        FileError: not NetCDF4, damaged or cut short, not written by Umbilical, or of another schema version.
    """
    import xarray

    if not content.startswith(_SIGNATURE):
        raise FileError(f"{origin}: this is not a NetCDF4 file" + (" (it is empty)" if not content else ""))
    try:  # numbers as they are stored: no unit makes a date of them
        _check_root(content)
        with xarray.open_dataset(io.BytesIO(content), engine="h5netcdf", decode_times=False) as data:
            _check_schema(data, origin)
            _check_size(data, origin)
            return data.load()
    except FileError:
        raise
    except Exception as error:  # whatever a decoder stumbles over, the file is what is wrong
        raise FileError(f"{origin}: the file is damaged or cut short ({_first_line(error)})") from error


def _check_root(content: bytes) -> None:
    """Raise where attributes of the root cannot be read: h5netcdf would leave half a file, and that complains."""
    import h5py

    with h5py.File(io.BytesIO(content), "r") as file:
        dict(file.attrs)


def _check_size(data: xarray.Dataset, origin: str) -> None:
    """A small file may promise arrays of any size: they are looked at before they are made."""
    if data.nbytes > 0.5 * memory():
        raise FileError(f"{origin}: its arrays take {in_words(data.nbytes)}, and this machine has {in_words(memory())}")


def _check_schema(data: xarray.Dataset, origin: str) -> None:
    version = data.attrs.get("result_schema")
    if version is None:
        raise FileError(f"{origin}: a NetCDF4 file, but not a result written by Umbilical")
    if not isinstance(version, Integral) or version != RESULT_SCHEMA:
        raise FileError(
            f"{origin}: result layout {version}, and this version of Umbilical reads layout {RESULT_SCHEMA}; "
            "read it with xarray, or simulate its scenario again"
        )


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or [""])[0] or type(error).__name__


def _to_csv(data: xarray.Dataset) -> bytes:
    """The time series as a table: a column for each channel of time, and for each motor of a motor channel.

    Two comment lines come first (what it is; the unit of every column), then the names. What lies along the cable is
    left out: a table has no place for it.
    """
    return csv_of(f"{data.attrs['title']}, scenario {data.attrs['scenario_hash']}", _columns(data))


def csv_of(title: str, columns: Iterable[tuple[str, str, np.ndarray]]) -> bytes:
    """Columns, each a name, a unit and values, as CSV below two lines of comment: the title and the units."""
    names, units, values = zip(*columns, strict=True)
    rows = zip(*(map(shown_in_csv, column.tolist()) for column in values), strict=True)
    lines = [f"# {title}", "# " + ",".join(units), ",".join(names), *(",".join(row) for row in rows), ""]
    return "\n".join(lines).encode()


def shown_in_csv(value: object) -> str:
    """A number with all its digits, a word as it is, nothing where there is no number.

    >>> shown_in_csv(0.1), shown_in_csv(float("nan")), shown_in_csv("dead")
    ('0.1', '', 'dead')
    """
    return "" if value != value else str(value)


def _columns(data: xarray.Dataset) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, unit and values of every column, time first."""
    yield "time", data["time"].attrs["units"], data["time"].values
    for name, array in data.data_vars.items():
        unit = array.attrs.get("units", "")
        if array.dims == ("time",):
            yield str(name), unit, array.values
        elif array.ndim == 2 and array.dims[0] == "time" and array.dims[1] != "sigma":
            numbers = data[array.dims[1]].values
            yield from ((f"{name}_{k}", unit, array.values[:, j]) for j, k in enumerate(numbers))


def to_mat(data: xarray.Dataset) -> bytes:
    """Every array under its own name as a MATLAB 5 file, with ``units`` and the scenario's text beside them."""
    from scipy.io import savemat

    content: dict[str, object] = {str(name): array.values for name, array in data.variables.items()}
    content["units"] = {str(name): array.attrs.get("units", "") for name, array in data.variables.items()}
    content |= {name: data.attrs[name] for name in ("title", "scenario", "scenario_hash", "convention")}
    file = io.BytesIO()
    savemat(file, content, oned_as="column", long_field_names=True)
    # The format opens with 116 bytes of free text, where scipy puts the time of day.
    return b"MATLAB 5.0 MAT-file, written by Umbilical".ljust(116) + file.getvalue()[116:]


EXPORTS: dict[str, Callable[[xarray.Dataset], bytes]] = {"csv": _to_csv, "mat": to_mat}
