"""A run: named arrays with units, how it ended, and the scenario it came from."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from umbilical import files
from umbilical.contents import CONTENTS, contents_of, stated_sizes
from umbilical.coordinates import attributes, coordinates, dimensions
from umbilical.errors import OutputError
from umbilical.formats import EXPORTS, RESULT_SCHEMA, to_netcdf, versions
from umbilical.quantities import CHANNELS, METRICS
from umbilical.result import ResultFaces
from umbilical.stored_numbers import METRIC
from umbilical.tables import html_table, shown_unit, text_table

if TYPE_CHECKING:
    import xarray

    from umbilical.scenario import Scenario

CONVENTION = (
    "x runs along the cable from the vessel (0) to the ROV (length), y is transverse, "
    "paying out is positive; SI units, angles in radians"
)

_LOGGED = "controller_"
CONTROLLER = "controller"
"""Attribute with the name of a controller that decided in place of the scenario's own."""
SNAPS = "snaps"
"""Attribute with the snaps of a rope, as JSON: pairs of an instant, s, and a peak, N."""
_SHOWN_SNAPS = 5


class Status(Enum):
    """How a run ended. The value is the command line's exit code.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> run.status is umbilical.Status.COMPLETED, umbilical.Status.DIVERGED.exit_code
    (True, 3)
    """

    COMPLETED = 0
    DIVERGED = 3
    FAILED = 5
    INTERRUPTED = 130

    @property
    def exit_code(self) -> int:
        """What ``umbilical run`` returns: 0 completed, 3 diverged, 5 the controller failed, 130 interrupted."""
        return self.value


@dataclass(frozen=True)
class Arrays:
    """What a dataset will be made of, once somebody asks: xarray takes longer to load than a run to simulate."""

    data_vars: dict[str, tuple]
    coords: dict[str, tuple]
    attrs: dict[str, Any]

    def __post_init__(self) -> None:
        for name, (dims, values, *_) in self.data_vars.items():
            if (found := np.shape(values)) != (needed := tuple(len(self.coords[dim][1]) for dim in dims)):
                raise ValueError(f"{name} has the shape {found}; over {', '.join(dims)} it is {needed}")

    def __getitem__(self, name: str) -> np.ndarray:
        return self.data_vars[name][1]

    def dataset(self) -> xarray.Dataset:
        """The same with labels."""
        import xarray

        data = xarray.Dataset(self.data_vars, self.coords, self.attrs)
        data.attrs[CONTENTS] = contents_of(data)
        return data


class Run(ResultFaces):
    """The result of one simulation, complete or not.

    Attributes:
        data: every channel with ``units``, ``long_name`` and ``symbol``, over ``time`` and where it applies ``sigma``
            (x/l, 0 vessel, 1 ROV), ``motor`` (from 1), ``kappa_index`` or ``axis``; no dimension is ever dropped.
        scenario: what was simulated.
        timing: seconds spent, by part; of this process only, never stored.

    Example:
        >>> import umbilical
        >>> run = umbilical.simulate(umbilical.load("paper").replace({"duration": 1.0}))
        >>> run["tip_displacement"].attrs["units"]
        'm'
    """

    drawn_by: ClassVar[str] = "plot_overview"

    def __init__(
        self, data: xarray.Dataset | Arrays, scenario: Scenario, timing: Mapping[str, float] | None = None
    ) -> None:
        self._kept = data
        self.scenario = scenario
        self.timing = dict(timing or {})

    @property
    def data(self) -> xarray.Dataset:
        """Every channel and metric, labelled."""
        if isinstance(self._kept, Arrays):
            self._kept = self._kept.dataset()
        return self._kept

    def __getitem__(self, name: str) -> xarray.DataArray:
        return self.data[name]

    @property
    def status(self) -> Status:
        """How it ended."""
        return Status[self._kept.attrs["status"]]

    @property
    def reason(self) -> str:
        """Why it ended, in words."""
        return self._kept.attrs["reason"]

    @property
    def end_time(self) -> float:
        """The instant it ended at, s."""
        return float(self._kept.attrs["end_time"])

    @property
    def controller(self) -> str:
        """What decided in place of the scenario's own controller, which a file does not hold; empty for nothing."""
        return self._kept.attrs.get(CONTROLLER, "")

    @property
    def name(self) -> str:
        """The scenario's name, and the controller's that decided in place of its own."""
        return f"{self.scenario.name} with {self.controller}" if self.controller else self.scenario.name

    def with_controller(self, name: str) -> Run:
        """This run, with the name of what decided in place of the scenario's own controller."""
        self._kept.attrs[CONTROLLER] = name
        return self

    def with_notices(self, notices: Sequence[str]) -> Run:
        """This run, with something to be said of it first."""
        if notices:
            said = [*notices, *json.loads(self._kept.attrs["notices"])]
            self._kept.attrs["notices"] = json.dumps(said, ensure_ascii=False)
        return self

    @property
    def notices(self) -> tuple[str, ...]:
        """What the user should know about this run."""
        return (*json.loads(self._kept.attrs["notices"]), *self._cut(), *self._other_scenario())

    @property
    def metrics(self) -> dict[str, float]:
        """Single numbers by name, in SI units; their words are :data:`umbilical.quantities.METRICS`."""
        names = [str(name).removeprefix(METRIC) for name in self._kept.data_vars if str(name).startswith(METRIC)]
        return {name: float(self._kept[METRIC + name]) for name in names if name in METRICS}

    @property
    def snaps(self) -> np.ndarray:
        """When a rope snapped taut, s, and the peak of its tension, N, of the first thousand: shape (snaps, 2)."""
        return np.array(json.loads(self._kept.attrs.get(SNAPS, "[]")), dtype=float).reshape(-1, 2)

    def _cut(self) -> tuple[str, ...]:
        """What must be said of a part of a run: its metrics are not the part's own."""
        if isinstance(self._kept, Arrays):
            return ()
        left, of = self.data.sizes["time"], stated_sizes(self.data)["time"]
        return (f"{left} of {of} samples are left; the metrics are those of the whole run",) * (left < of)

    def _other_scenario(self) -> tuple[str, ...]:
        """What must be said where the scenario is not the one that was simulated."""
        was, now = self._kept.attrs["scenario_hash"], self.scenario.hash
        told = f"the scenario inside is {now[:12]} and the run was of {was[:12]}: it was changed, or is read otherwise"
        return (f"{told} by this version",) * (was != now)

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name} {size}" for name, size in self.data.sizes.items())
        return f"<Run {self._headline()} ({sizes})>"

    def _repr_html_(self) -> str:
        notes = "".join(f"<p>{escape(notice)}</p>" for notice in self.notices)
        plays = "<p><code>umbilical.show(run)</code> plays it.</p>" * (self["time"].size > 1)
        return f"<p><b>{escape(self._headline())}</b></p>{html_table(self._rows())}{notes}{plays}"

    def summary(self) -> str:
        """How it ended and every metric, as an aligned table of text."""
        metrics = text_table(self._rows(), right=[1])
        notes = [f"  note: {notice}" for notice in self.notices]
        return "\n".join(filter(None, [self._headline(), metrics, self._largest_snaps(), *notes]))

    def _largest_snaps(self) -> str:
        """When the largest snaps were."""
        largest = sorted(self.snaps.tolist(), key=lambda snap: -snap[1])[:_SHOWN_SNAPS]
        told = ", ".join(f"{peak:.4g} N at {time:.4g} s" for time, peak in largest)
        return f"  largest snaps: {told}" if told else ""

    def to_dict(self) -> dict[str, Any]:
        """How it ended, its metrics and what is to be known of it, as plain data."""
        return {
            "status": self.status.name,
            "reason": self.reason,
            "end_time": self.end_time,
            "scenario": self.scenario.name,
            "scenario_hash": self.scenario.hash,
            **({"controller": self.controller} if self.controller else {}),
            "metrics": self.metrics,
            **({"snaps": self.snaps.tolist()} if self.snaps.size else {}),
            "timing": dict(self.timing),
            "notices": self.notices,
            "assumed": self.scenario.assumed,
        }

    def _headline(self) -> str:
        status, when = f"{self.name}: {self.status.name}", "at t = "
        if self.reason.startswith(when):
            return f"{status} {self.reason}"
        end = f"{status} {when}{self.end_time:.6g} s"
        return f"{end}, {self.reason}" if self.reason else end

    def _rows(self) -> list[tuple[str, str, str, str]]:
        found = [(name, value, METRICS[name]) for name, value in self.metrics.items()]
        return [(name, f"{value:.6g}", shown_unit(word.unit), word.meaning) for name, value, word in found]

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Store everything but ``timing`` as NetCDF4; the same run gives the same bytes on the same versions.

        Args:
            path: the file, by custom ``*.nc``; it appears whole or not at all.
            force: replace an existing file.

        Raises:
            OutputError: the file exists, or its folder is missing, read-only or full.
        """
        return files.write(path, to_netcdf(self.data), force=force)

    def export(self, path: str | os.PathLike[str], to: str = "csv", *, force: bool = False) -> Path:
        """Store the run for other tools: ``csv`` (channels over time) or ``mat`` (every array, for MATLAB).

        Raises:
            OutputError: no such format, or as for :meth:`save`.
        """
        if to not in EXPORTS:
            raise OutputError(f"{path}: no format {to!r}; there are {', '.join(EXPORTS)}")
        return files.write(path, EXPORTS[to](self.data), force=force)


def assemble(
    scenario: Scenario,
    channels: Mapping[str, np.ndarray],
    *,
    time: np.ndarray,
    status: Status,
    reason: str,
    end_time: float,
    metrics: Mapping[str, float],
    timing: Mapping[str, float] | None = None,
    notices: Sequence[str] = (),
    sigma: np.ndarray | None = None,
    logged: Mapping[str, np.ndarray] | None = None,
    snaps: np.ndarray | None = None,
) -> Run:
    """Put names, units and the scenario to the arrays of a simulation.

    Args:
        scenario: what was simulated.
        channels: arrays by name, over what :func:`~umbilical.coordinates.dimensions` says; the names, their units and
            meanings are those of :data:`umbilical.quantities.CHANNELS`.
        time: instants of the samples, s, shape (time,).
        status: how it ended.
        reason: why, in words; may be empty.
        end_time: the instant it ended at, s.
        metrics: single numbers by name, from :data:`umbilical.quantities.METRICS`.
        timing: seconds spent, by part; kept in memory only.
        notices: what the user should know.
        sigma: positions of the nodes, x/l, where they are not evenly spaced.
        logged: what a user's controller logged, by its names, shape (time,).
        snaps: as :attr:`Run.snaps`; None where there can be none.

    Raises:
        KeyError: a channel or metric has no words in :mod:`umbilical.quantities`.
        ValueError: an array's shape does not fit its dimensions.
    """
    variables = {name: _channel(name, values) for name, values in channels.items()}
    variables |= {_LOGGED + name: (("time",), values, _of_controller(name)) for name, values in (logged or {}).items()}
    variables |= {METRIC + name: ((), float(value), attributes(METRICS[name])) for name, value in metrics.items()}
    ending = {
        "status": status.name,
        "reason": reason,
        "end_time": float(end_time),
        "notices": json.dumps(list(notices), ensure_ascii=False),
    }
    if snaps is not None:
        ending[SNAPS] = json.dumps(snaps.tolist())
    arrays = Arrays(variables, coordinates(channels, time, sigma), _identity(scenario) | ending)
    return Run(arrays, scenario, timing)


def _channel(name: str, values: np.ndarray) -> tuple[tuple[str, ...], np.ndarray, dict[str, str]]:
    return dimensions(name), np.asarray(values, dtype=float), attributes(CHANNELS[name])


def _of_controller(name: str) -> dict[str, str]:
    """Words for what a controller logs; it says no unit, so a picture of it shows none."""
    return {"long_name": f"{name}, logged by the controller", "symbol": ""}


def _identity(scenario: Scenario) -> dict[str, str | int]:
    """Where the numbers come from: scenario, seed, versions. No clock and no host, so that equal runs stay equal."""
    return {
        "title": f"Umbilical run of {scenario.name}",
        "result_schema": RESULT_SCHEMA,
        "convention": CONVENTION,
        "scenario": scenario.to_toml(),
        "scenario_hash": scenario.hash,
        "seed": scenario.seed,
        **versions(),
    }
