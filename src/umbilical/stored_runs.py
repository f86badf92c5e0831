"""Runs read back from their files, and refused where a file is not what it says."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from umbilical import files
from umbilical.contents import (
    check_contents,
    instant,
    json_of,
    kind_of,
    one_of,
    pairs,
    refuse,
    text_rule,
    whole_number,
    wrong_array,
)
from umbilical.coordinates import dimensions
from umbilical.errors import FileError, ScenarioError
from umbilical.formats import from_netcdf, versions
from umbilical.quantities import CHANNELS
from umbilical.run import CONTROLLER, SNAPS, Run, Status
from umbilical.scenario.scenario import parse_document
from umbilical.stored_numbers import METRIC, wrong_times, wrong_values

if TYPE_CHECKING:
    import xarray


def open_run(path: str | os.PathLike[str]) -> Run:
    """A stored run.

    Args:
        path: a .nc file.

    Raises:
        FileError: the file is missing, unreadable, damaged, not a result of Umbilical, of another schema version, or
            holds a scenario this version refuses.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> path = run.save("run.nc")
    >>> umbilical.open_run("run.nc").metrics["tip_peak"] == run.metrics["tip_peak"]
    True
    """
    data = _of_a_run(path)
    try:
        scenario = parse_document(data.attrs["scenario"], f"{path}: the scenario inside")
    except ScenarioError as error:
        raise FileError(f"{error}\n(this version of Umbilical refuses it; xarray still reads the numbers)") from error
    refuse(wrong_times(data, scenario.duration, over=data.attrs["status"] == Status.COMPLETED.name), str(path))
    return Run(data, scenario)


def scenario_text(path: str | os.PathLike[str]) -> str:
    """The TOML text of the scenario a stored run came from; raises as :func:`open_run` does."""
    return _of_a_run(path).attrs["scenario"]


def controller_name(path: str | os.PathLike[str]) -> str:
    """As :attr:`umbilical.run.Run.controller`, of a stored run; raises as :func:`open_run` does."""
    return _of_a_run(path).attrs.get(CONTROLLER, "")


_ORIGIN = dict.fromkeys(("title", "convention", "scenario", "scenario_hash", "reason"), text_rule)
_VERSIONS = dict.fromkeys(versions(), text_rule)
_ENDING = {"status": one_of(Status.__members__), "end_time": instant, "notices": json_of(list, str)}
_SOMETIMES = {SNAPS: pairs, CONTROLLER: text_rule}


def _of_a_run(path: str | os.PathLike[str]) -> xarray.Dataset:
    data = from_netcdf(files.read(path), str(path))
    if (kind := kind_of(data)) != "run":
        raise FileError(f"{path}: this is the result of a {kind}, not of a run")
    some = {name: rule for name, rule in _SOMETIMES.items() if name in data.attrs}
    check_contents(data, _ORIGIN | _ENDING | _VERSIONS | {"seed": whole_number} | some, "time", str(path))
    refuse(filter(None, _wrong_arrays(data)), str(path))
    return data


def _wrong_arrays(data: xarray.Dataset) -> Iterator[str]:
    """What keeps arrays from being those of a run."""
    for name in map(str, data.variables):
        if name in CHANNELS:
            yield wrong_array(data[name], dimensions(name), "f")
        elif name.startswith(METRIC):
            yield wrong_array(data[name], (), "f")
        elif name in data.sizes:
            yield wrong_array(data[name], (name,), "fiu")
    if data.attrs["status"] == Status.COMPLETED.name:
        yield from wrong_values(data)
    for name in sorted({"time", "sigma"} & set(data.coords)):
        places = data[name].values
        if places.dtype.kind == "f" and not (np.isfinite(places).all() and (np.diff(places) > 0.0).all()):
            yield f"{name}: must be finite and increase"
