"""Wave spectra over time that buoys and wave models write, as wavespectra reads them: Hs, Tp and times of each."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

import numpy as np

from umbilical.errors import FileError, MissingPartnerError, import_partner

_TEXTS = {
    rb"SWAN": ("swan", "read_swan"),
    rb"Forecast valid for": ("octopus", "read_octopus"),
    rb'\s*\{\s*"coords"': ("json", "read_json"),
    rb"#?YY(YY)? +MM +DD +hh( +mm)? +(Sep_Freq|\.?\d)": ("ndbc_ascii", "read_ndbc_ascii"),
}
"""How files of text begin, and who reads them."""
_NETCDF: dict[tuple[str, ...], tuple[str, str, dict[str, Any]]] = {
    ("efth", "freq"): ("netcdf", "", {}),
    ("efth", "frequency"): ("ww3", "from_ww3", {}),
    ("spectral_wave_density",): ("ndbc", "from_ndbc", {"directional": False}),
    ("d2fd",): ("era5", "from_era5", {}),
    ("density", "frequency"): ("ncswan", "from_ncswan", {}),
}
"""What NetCDF of spectra holds, and who renames it; wavespectra's own names need nobody."""
_OVER = {"time", "freq", "dir"}
_MISSING = "wave spectra need wavespectra: pip install 'umbilical[seas]'"


def read_spectra(content: bytes, origin: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Hs, m, Tp, s, and times, s, of spectra at one site.

    Args:
        content: of the file.
        origin: the file: SWAN, OCTOPUS or NDBC text, wavespectra's JSON, NetCDF of WAVEWATCH III, SWAN, NDBC, ERA5 or
            wavespectra.

    Returns:
        Three arrays of the shape (times,); None where the file holds no spectra.

    Raises:
        FileError: it is damaged, or of several sites.
        MissingPartnerError: wavespectra is not installed.
    """
    if content[:4] == b"\x89HDF" or content[:3] == b"CDF":
        found = _of_netcdf(content, origin)
        return None if found is None else _of_one_site(found["efth"], origin)
    readers = [reader for begin, reader in _TEXTS.items() if re.match(begin, content)]
    return _of_one_site(_reader(*readers[0], origin)(origin)["efth"], origin) if readers else None


def _of_netcdf(content: bytes, origin: Path) -> Any:
    import xarray

    try:
        engine: Any = "h5netcdf" if content[:4] == b"\x89HDF" else "scipy"
        with xarray.open_dataset(io.BytesIO(content), engine=engine) as data:
            names = next((names for names in _NETCDF if set(names) <= set(map(str, data.variables))), None)
            if names is None:
                return None
            module, rename, options = _NETCDF[names]
            return _reader(module, rename, origin)(data.load(), **options) if rename else data.load()
    except MissingPartnerError:
        raise
    except Exception as error:  # whatever a decoder stumbles over, the file is what is wrong
        raise FileError(f"{origin}: the file is damaged or no NetCDF ({type(error).__name__})") from error


def _reader(module: str, function: str, origin: Path) -> Any:
    """A reader of wavespectra whose errors say that the file is wrong."""
    right = getattr(import_partner(f"wavespectra.input.{module}", _MISSING), function)

    def read(*arguments: Any, **options: Any) -> Any:
        try:
            return right(*arguments, **options)
        except Exception as error:  # of any reader
            raise FileError(f"{origin}: wavespectra cannot read it as {module}: {error}") from error

    return read


def _of_one_site(spectra: Any, origin: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    import_partner("wavespectra", _MISSING)  # it gives arrays the attribute spec
    one = spectra.squeeze([name for name, size in spectra.sizes.items() if size == 1 and name not in _OVER])
    if set(one.dims) - _OVER or "time" not in one.dims:
        sizes = ", ".join(f"{name} {size}" for name, size in one.sizes.items())
        raise FileError(f"{origin}: spectra over {sizes}; one site over time is read: write one with xarray's isel")
    seconds = (one["time"].values - one["time"].values[0]) / np.timedelta64(1, "s")
    return one.spec.hs().values.astype(float), one.spec.tp().values.astype(float), seconds.astype(float)
