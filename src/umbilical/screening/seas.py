"""Sea states of a place: scatter tables and hindcasts, from CSV, NetCDF or spectra that wavespectra reads."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from umbilical import files
from umbilical.columns import Wanted, lists_of, read_columns
from umbilical.columns.reading import Columns
from umbilical.errors import Problem, ScenarioError
from umbilical.screening.spectra import read_spectra
from umbilical.sea.spectrum import period_ratio

_HEIGHTS = ("hs", "hm0", "swh", "vhm0", "significant height", "significant wave height")
_PERIODS: dict[Any, tuple[str, ...]] = {
    "peak": ("tp", "peak period", "vtpk"),
    "zero_crossing": ("tz", "tm02", "zero crossing period", "vtm02"),
    "mean": ("t1", "tm01", "mean period"),
}
_WEIGHTS = ("count", "counts", "occurrence", "occurrences", "probability", "share", "number", "n")
_TIMES = ("time", "date", "datetime", "t")


class Seas(NamedTuple):
    """Sea states, each of the arrays of the shape (seas,).

    Attributes:
        height: Hs, m.
        period: Tp, s.
        weight: how often each occurs; they add to 1.
        time: s from the first, increasing; None for a scatter table.
    """

    height: np.ndarray
    period: np.ndarray
    weight: np.ndarray
    time: np.ndarray | None


def read_seas(path: str | Path, peakedness: float = 3.3) -> Seas:
    """Read a scatter table (a column of counts or shares) or a hindcast (a column of times).

    Args:
        path: CSV or NetCDF with the columns Hs and one of Tp, Tz, T1 under usual names; or wave spectra of one site, as
            :func:`umbilical.screening.spectra.read_spectra` has them, which needs wavespectra.
        peakedness: gamma, which turns Tz or T1 into Tp.

    Raises:
        FileError: it cannot be read.
        ScenarioError: columns are missing, without a unit, or hold what no sea is.
        MissingPartnerError: spectra, and wavespectra is not installed.
    """
    origin = Path(path)
    content = files.read(origin)
    if (spectra := read_spectra(content, origin)) is not None:
        height, period, time = spectra
        return _checked(height, period, None, time, key=str(path))
    columns = read_columns(origin, content)
    lists, kind, problems = _lists(columns, str(path))
    if problems:
        raise ScenarioError(problems, str(path))
    period = lists["period"] / period_ratio(kind, peakedness)
    return _checked(lists["height"], period, lists.get("weight"), lists.get("time"), key=str(path))


def _lists(columns: Columns, key: str) -> tuple[dict[str, np.ndarray], Any, list[Problem]]:
    names = {_plain(name) for name in columns.names}
    kinds: list[Any] = [kind for kind, known in _PERIODS.items() if names & set(known)]
    kind: Any = kinds[0] if kinds else "peak"  # of several the peak period, which needs no shape
    wanted = [Wanted("height", _HEIGHTS, "m"), Wanted("period", _PERIODS[kind], "s")]
    weighted = [name for name in _WEIGHTS if name in names]
    timed = [name for name in _TIMES if name in names] or [_plain(name) for name in sorted(columns.dates)]
    counts = next((name for name in columns.names if weighted and _plain(name) == weighted[0]), "")
    wanted += [Wanted("weight", (weighted[0],), "1")] if counts and columns.units[counts] else []
    wanted += [Wanted("time", (timed[0],), "s")] if timed and not weighted else []
    lists, problems = lists_of(columns, wanted, key)
    if counts and "weight" not in lists:  # counts have no unit
        lists["weight"] = columns.values[counts]
    if not weighted and not timed:
        reason = "a scatter table says how often each sea occurs, a hindcast when"
        bound = f"one of {', '.join(_WEIGHTS)}, or {', '.join(_TIMES)}, or a column of dates"
        problems.append(Problem(f"{key}.count", "missing", bound, reason, "name that column so"))
    return lists, kind, problems


def _plain(name: str) -> str:
    return name.lower().replace("_", " ").strip()


def _checked(
    height: np.ndarray, period: np.ndarray, weight: np.ndarray | None, time: np.ndarray | None, *, key: str
) -> Seas:  # fmt: skip
    """Seas that can be: heights and periods of seas, weights of 0 or more, times that increase."""
    problems = []
    shares = np.ones_like(height) if weight is None else weight
    bad = ~((height >= 0.0) & (height <= 25.0) & np.isfinite(period) & (period > 0.0) & (period <= 40.0))
    bad &= ~((height == 0.0) & ~np.isfinite(period))  # a calm has no period
    if bad.any():
        k = int(np.argmax(bad))
        problems.append(Problem(
            key, f"{int(bad.sum())} rows such as Hs {height[k]:g} m, T {period[k]:g} s", "Hs to 25 m, periods to 40 s",
            "no sea; 99 or 999 are marks of a missing value", "leave such rows out",
        ))  # fmt: skip
    if not np.isfinite(shares).all() or (shares < 0.0).any() or shares.sum() <= 0.0:
        problems.append(Problem(key, "counts", "0 or more, not all 0", "they say how often", "correct them"))
    if time is not None and not (np.diff(time) > 0.0).all():
        problems.append(Problem(key, "times", "increasing", "a hindcast runs forward", "sort the rows, none twice"))
    if problems:
        raise ScenarioError(problems, key)
    period = np.where(np.isfinite(period), period, 10.0)
    return Seas(height, period, shares / shares.sum(), None if time is None else time - time[0])
