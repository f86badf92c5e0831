"""What a study found: metrics over members and arms with units, the draws beside them, the study inside."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from umbilical import files
from umbilical.contents import CONTENTS, check_contents, contents_of, json_of, kind_of, refuse, text_rule, wrong_array
from umbilical.errors import FileError, ScenarioError
from umbilical.formats import RESULT_SCHEMA, from_netcdf, to_netcdf, versions
from umbilical.quantities import METRICS
from umbilical.result import ResultFaces
from umbilical.run import CONVENTION
from umbilical.scenario.document import read_document
from umbilical.scenario.inventory import words_at
from umbilical.scenario.scenario import Scenario
from umbilical.studies.distributions import Drawn
from umbilical.studies.members import Draws
from umbilical.studies.rows import NAMES, STATUSES, Row
from umbilical.studies.study import Study, admit_study

if TYPE_CHECKING:
    import xarray

KIND = "study"


@dataclass(frozen=True, eq=False, repr=False)
class StudyResult(ResultFaces):
    """The result of a study.

    Attributes:
        data: every metric over ``member`` (from 1) and ``arm``, with units; what was drawn as coordinates of ``member``
            under its own key; ``point``, the draws in the unit cube; ``status``, ``reason`` and ``end_time``.
        study: what was run.

    >>> import umbilical
    >>> study = umbilical.load_study("fault-map", {"campaigns.1.start.count": 2, "scenario.duration": 0.5})
    >>> found = umbilical.sweep(study)
    >>> found["tip_peak"].dims
    ('member', 'arm')
    """

    shown_by: ClassVar[str] = "umbilical.faces.study"
    drawn_by: ClassVar[str] = "plot_study"

    data: xarray.Dataset
    study: Study

    def __getitem__(self, name: str) -> xarray.DataArray:
        return self.data[name]

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name} {size}" for name, size in self.data.sizes.items())
        return f"<StudyResult {self.study.name} ({sizes})>"

    @property
    def arms(self) -> tuple[str, ...]:
        """Names of the arms."""
        return tuple(str(name) for name in self.data["arm"].values)

    @property
    def metrics(self) -> tuple[str, ...]:
        """Names of the metrics."""
        return tuple(name for name in METRICS if name in self.data)

    def scenario(self, member: int, arm: str | None = None) -> Scenario:
        """The scenario of one member, to run it alone; the first arm's if none is named.

        Raises:
            KeyError: there is no such member or arm.
        """
        arms = self.arms
        if not 1 <= member <= self.data.sizes["member"] or (arm is not None and arm not in arms):
            raise KeyError(f"{self.study.name}: no member {member} in arm {arm}")
        draws = Draws(self.study)
        return draws.scenario(draws.member(member), 0 if arm is None else arms.index(arm))

    def ended(self, arm: str, status: str) -> np.ndarray:
        """Whether each member ended so in an arm; a status of :data:`~umbilical.studies.rows.STATUSES`."""
        return self.data["status"].sel(arm=arm).values == STATUSES.index(status)

    def values(self, metric: str, arm: str) -> np.ndarray:
        """A metric of every member in one arm: infinite where the run diverged, since that is worse than any number;
        not a number where nothing was measured: the scenario was refused, its controller failed, or it has no such
        metric (a peak after no fault)."""
        chosen = self.data.sel(arm=arm)
        found = chosen[metric].values if metric in chosen else np.full(chosen.sizes["member"], np.nan)
        values = np.where(self.ended(arm, "COMPLETED"), found, np.nan)
        return np.where(self.ended(arm, "DIVERGED"), np.inf, values)

    @property
    def lost(self) -> tuple[str, ...]:
        """Names of the arms in which not one member completed."""
        return tuple(arm for arm in self.arms if not self.ended(arm, "COMPLETED").any())

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Store as NetCDF4; the same study gives the same bytes.

        Raises:
            OutputError: as for :meth:`umbilical.run.Run.save`.
        """
        return files.write(path, to_netcdf(self.data), force=force)


def assemble_study(study: Study, rows: Iterable[Row]) -> StudyResult:
    """Put rows, in any order, under their names."""
    import xarray

    draws = Draws(study)
    shape = (len(draws), len(study.arms))
    numbers = np.full((*shape, len(NAMES)), np.nan)
    status, end, reason = np.zeros(shape, dtype=np.int8), np.zeros(shape), np.full(shape, "", dtype=object)
    for row in rows:
        for arm, cell in enumerate(row.cells):
            place = row.number - 1, arm
            numbers[place], status[place], end[place] = cell.metrics, STATUSES.index(cell.status), cell.end_time
            reason[place] = "" if cell.status == "COMPLETED" else cell.reason
    dims = ("member", "arm")
    named: dict[str, Any] = {
        name: (dims, np.ascontiguousarray(numbers[..., k]), _words(METRICS[name].unit, METRICS[name].meaning))
        for k, name in enumerate(NAMES)
        if not np.isnan(numbers[..., k]).all()
    }
    flags = {"flag_values": np.arange(len(STATUSES), dtype=np.int8), "flag_meanings": " ".join(STATUSES)}
    named["status"] = (dims, status, {"long_name": "how the run ended", **flags})
    named["reason"] = (dims, reason, {"long_name": "why it did not complete"})
    named["end_time"] = (dims, end, _words("s", "instant the run ended at"))
    named["point"] = (("member", "variable"), draws.points, _words("1", "draws in the unit cube"))
    data = xarray.Dataset(named, _coordinates(study, draws), _identity(study))
    data.attrs[CONTENTS] = contents_of(data)
    return StudyResult(data, study)


def _coordinates(study: Study, draws: Draws) -> dict[str, Any]:
    """Members, arms, what is drawn, and the draws themselves with their units and meanings."""
    found: dict[str, Any] = {
        "member": ("member", np.arange(1, len(draws) + 1), _words("1", "member")),
        "arm": ("arm", np.array([arm.name for arm in study.arms]), {"long_name": "what is compared"}),
        "variable": ("variable", np.array([v.name for v in draws.variables], str), {"long_name": "what is drawn"}),
    }
    first, relative = next(draws.undrawn()), {factor.key for factor in study.factors if factor.relative}
    for place, (name, _, unit, meaning) in enumerate(draws.variables):
        if not meaning:  # of a factor; kinds of tables decide on its words, and those are the first arm's
            unit, meaning = words_at(first, name)
            meaning = meaning or name
        words = _words("1", f"factor on the {meaning}") if name in relative else _words(unit, meaning)
        found[name] = ("member", _array(draws.column(place)), words)
    return found


def _array(values: list[Drawn]) -> np.ndarray:
    """Texts as objects, each as long as it is: the longest would decide about the memory of all."""
    if any(isinstance(value, str) for value in values):
        return np.array([str(value) for value in values], dtype=object)
    return np.array(values)


def _words(unit: str, meaning: str) -> dict[str, str]:
    return {"units": unit, "long_name": meaning}


def _identity(study: Study) -> dict[str, str | int]:
    return {
        "title": f"Umbilical study {study.name}",
        "kind": KIND,
        "result_schema": RESULT_SCHEMA,
        "convention": CONVENTION,
        "study": study.to_toml(),
        "study_hash": study.hash,
        "limits": json.dumps(study.limits, sort_keys=True),
        **versions(),
    }


def open_study(path: str | os.PathLike[str]) -> StudyResult:
    """A stored study.

    Args:
        path: a .nc file.

    Raises:
        FileError: missing, damaged, no study's result, or of a study this version refuses.

    >>> import umbilical
    >>> study = umbilical.load_study("fault-map", {"campaigns.1.start.count": 2, "scenario.duration": 0.5})
    >>> found = umbilical.sweep(study, "map")
    >>> umbilical.open_study("map/study.nc").data.equals(found.data)
    True
    """
    data, origin = _open(path), f"{path}: the study inside"
    try:
        study = admit_study(read_document(data.attrs["study"], origin), origin)
    except ScenarioError as error:
        raise FileError(f"{error}\n(this version of Umbilical refuses it; xarray still reads the numbers)") from error
    refuse(filter(None, _wrong_arrays(data, study)), str(path))
    return StudyResult(data, study)


def study_of_file(path: str | os.PathLike[str]) -> str:
    """TOML text of the study a result came from; raises as :func:`open_study`."""
    return _open(path).attrs["study"]


def is_study_file(path: str | os.PathLike[str]) -> bool:
    """Whether a result file is a study's; raises FileError for what is no result."""
    return kind_of(from_netcdf(files.read(path), str(path))) == KIND


_TEXTS = ("title", "convention", "study", "study_hash", *versions())
_RULES = {**dict.fromkeys(_TEXTS, text_rule), "limits": json_of(dict, int, float)}
_CELLS = ("member", "arm")
_NEEDED = {"status": (_CELLS, "i"), "reason": (_CELLS, "U"), "end_time": (_CELLS, "f")}
_NEEDED |= dict.fromkeys(METRICS, (_CELLS, "f")) | {"point": (("member", "variable"), "f"), "arm": (("arm",), "U")}
"""Dimensions and kinds of a result's arrays."""


def _open(path: str | os.PathLike[str]) -> xarray.Dataset:
    data = from_netcdf(files.read(path), str(path))
    if (kind := kind_of(data)) != KIND:
        raise FileError(f"{path}: this is the result of a {kind}, not of a study")
    check_contents(data, _RULES, "", str(path))
    return data


def _wrong_arrays(data: xarray.Dataset, study: Study) -> Iterator[str]:
    """What keeps arrays from being those of the study."""
    draws, arms = Draws(study), [arm.name for arm in study.arms]
    needed = _NEEDED | {variable.name: (("member",), "fiuU") for variable in draws.variables}
    yield from (wrong_array(data[name], *kind) for name, kind in needed.items() if name in data or name not in METRICS)
    if data["arm"].values.tolist() != arms:
        yield f"arm: must be those of the study inside, {', '.join(arms)}"
    if not np.array_equal(data["member"].values, np.arange(1, len(draws) + 1)):
        yield f"member: must run from 1 to {len(draws)}"
    if not np.isin(data["status"].values, range(len(STATUSES))).all():
        yield f"status: must be from 0 to {len(STATUSES) - 1}"
    if data["status"].attrs.get("flag_meanings") != " ".join(STATUSES):
        yield f"status: its flag_meanings must be {' '.join(STATUSES)}"
