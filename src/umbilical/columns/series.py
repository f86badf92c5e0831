"""Two columns of a file as a curve: chosen, checked, converted to SI units, its drift removed.

Everything that is wrong is found at once; nothing is guessed and nothing is mended without being asked for.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from umbilical.columns.reading import Columns
from umbilical.columns.units import factor, known
from umbilical.errors import Problem

DRIFT = re.compile(r"keep|mean|highpass\((?P<period>[0-9.]+(e[0-9]+)?)\)")
WIDEST_GAP = 0.5
"""s; a longer one is not filled, nor one of more than three samples."""
_EPOCH = 3e8
"""s; a record that starts later counts from 1970, as no run does."""
_REGULAR, _FEWEST = 0.9, 20
_KNOTS, _WEIGHTS = 5, (-9.0, 14.0)
_NINES = re.compile(r"-?9{2,}(\.9*|\.0*)?")


class ColumnChoice(NamedTuple):
    """What to take of a file.

    Attributes:
        across, value: names of the columns; None for the first, and for the only other one.
        across_unit, unit: their units where the header gives none.
        wanted_across, wanted: SI units that they become.
        fill: numbers that stand for a missing value.
        blanks: whether rows with a blank cell are left out, too.
        drift: keep, mean or highpass(T).
        noise: standard deviation of what a smoothing spline takes off, in the wanted unit.
        start: what is subtracted from the first column; None: its first value if those are dates, else 0.
        jumps: whether a point may stand twice.
    """

    across: str | None = None
    value: str | None = None
    across_unit: str | None = None
    unit: str | None = None
    wanted_across: str = "s"
    wanted: str = "m"
    fill: tuple[float, ...] = ()
    blanks: bool = False
    drift: str = "keep"
    noise: float | None = None
    start: float | None = None
    jumps: bool = False


class Series(NamedTuple):
    """A curve: points and values, each of the shape (rows,), in SI units; what was subtracted from the points."""

    points: np.ndarray
    values: np.ndarray
    start: float


def series_of(columns: Columns, choice: ColumnChoice, key: str) -> Series | list[Problem]:
    """Take a curve from a file, or say everything that is wrong with it.

    Args:
        columns: what the file holds.
        choice: what to take.
        key: of the scenario, for problems.
    """
    names = _chosen(columns, choice, key)
    if isinstance(names, Problem):
        return [names]
    scales = [*_scales(columns, choice, names, key)]
    if problems := [scale for scale in scales if isinstance(scale, Problem)]:
        return problems
    kept = _present(columns, names, choice)
    points, values = (columns.values[name][kept] for name in names)
    if problems := [*_missing(columns, names, choice, key), *_order(columns, points, kept, choice.jumps, key)]:
        return problems
    points, values = (part * scale for part, scale in zip((points, values), scales, strict=True))
    timed = choice.wanted_across == "s"
    if timed and (problems := [*_gaps(points, columns.lines[kept], key), *_drift_problems(points, choice.drift, key)]):
        return problems
    dated = timed and (names[0] in columns.dates or points[0] > _EPOCH)
    start = choice.start if choice.start is not None else float(points[0]) if dated else 0.0
    if timed and choice.noise is not None:
        smooth = without_noise(points, values, choice.noise)
        if smooth is None:
            return [_too_noisy(values, choice, key)]
        values = smooth
    return Series(points - start, _without_drift(points, values, choice.drift) if timed else values, start)


def _chosen(columns: Columns, choice: ColumnChoice, key: str) -> tuple[str, str] | Problem:
    """Names of both columns."""
    across = choice.across or columns.names[0]
    others = [name for name in columns.names if name != across]
    value = choice.value or (others[0] if len(others) == 1 else None)
    for asked, name in (("across", across), ("value", value)):
        if name not in columns.names:
            there = ", ".join(columns.names)
            found = f'"{name}"' if name else "missing"
            reason = "the columns of a file are taken by name" if name else "the file has several columns"
            fitting = [other for other in others if factor(columns.units[other], choice.wanted) is not None]
            example = columns.names[0] if asked == "across" else (fitting or others or [across])[0]
            fix = f'e.g. file = {{ name = "{columns.origin}", {asked} = "{example}" }}'
            return Problem(f"{key}.{asked}", found, f"one of {there}", reason, fix)
    return across, str(value)


def _scales(columns: Columns, choice: ColumnChoice, names: tuple[str, str], key: str) -> Iterator[float | Problem]:
    """What both columns are multiplied by."""
    asked = (("across_unit", choice.across_unit, choice.wanted_across), ("unit", choice.unit, choice.wanted))
    for name, (option, given, wanted) in zip(names, asked, strict=True):
        unit = given if given is not None else columns.units[name]
        scale = factor(unit, wanted)
        units = ", ".join(known(wanted))
        if scale is None:
            found = f'"{unit}" of column {name}' if unit else f"none, for column {name}"
            fix = f'write it in the header, as in "{name} [{wanted}]", or {option} = "{wanted}"'
            yield Problem(f"{key}.{option}", found, f"one of {units}", "numbers without their unit are guesses", fix)
        else:
            yield scale


def _present(columns: Columns, names: tuple[str, str], choice: ColumnChoice) -> np.ndarray:
    """Which rows are taken."""
    points, values = (columns.values[name] for name in names)
    kept = ~np.isin(values, choice.fill)
    return kept & np.isfinite(points) & np.isfinite(values) if choice.blanks else kept


def _missing(columns: Columns, names: tuple[str, str], choice: ColumnChoice, key: str) -> Iterator[Problem]:
    """Blank cells, and numbers that look like a mark for one."""
    kept = _present(columns, names, choice)
    lines = columns.lines[kept]
    for name in names:
        values = columns.values[name][kept]
        if not np.isfinite(values).all():
            where = lines[int(np.argmin(np.isfinite(values)))]
            count = int((~np.isfinite(values)).sum())
            yield Problem(
                f"{key}.blanks", f"{name} is blank in {count} rows, first in line {where}", "a number in every row",
                "what is not there cannot be followed", "blanks = true leaves such rows out, where the gap is short",
            )  # fmt: skip
    values = columns.values[names[1]][kept]
    for number in np.unique(values[np.isfinite(values)]):
        if _NINES.fullmatch(f"{number:g}") and _stands_apart(values, float(number)):
            where = lines[int(np.argmax(values == number))]
            yield Problem(
                f"{key}.fill", f"{number:g} in {names[1]}, first in line {where}", "values that were measured",
                f"{number:g} stands apart from all others and looks like the mark of a missing value",
                f"fill = [{number:g}] leaves such rows out; correct it where it is a value",
            )  # fmt: skip


def _stands_apart(values: np.ndarray, number: float) -> bool:
    others = values[np.isfinite(values) & (values != number)]
    return others.size > 0 and bool(abs(number - np.median(others)) > 3.0 * max(float(np.ptp(others)), 1e-12))


def _order(columns: Columns, points: np.ndarray, kept: np.ndarray, jumps: bool, key: str) -> Iterator[Problem]:
    """Points that do not increase, and too few of them."""
    lines = columns.lines[kept]
    if points.size < 2:
        yield Problem(f"{key}.name", f"{points.size} rows", "two or more", "a curve needs points", "another file")
        return
    steps = np.diff(points)
    wrong = (steps < 0.0) if jumps else (steps <= 0.0)
    if not np.isfinite(steps).all() or not wrong.any():
        return
    where = int(np.argmax(wrong))
    twice = int((steps == 0.0).sum())
    what = "stands twice" if steps[where] == 0.0 else "follows a later one"
    yield Problem(
        f"{key}.name", f"line {lines[where + 1]}: {points[where + 1]:.9g} {what}", "increasing from row to row",
        f"the curve runs through increasing points ({twice} stand twice, {int((steps < 0.0).sum())} are out of order)",
        "sort the rows and leave out those that stand twice",
    )  # fmt: skip


def _gaps(points: np.ndarray, lines: np.ndarray, key: str) -> Iterator[Problem]:
    """Holes in a record with an even period; a record without one has none."""
    steps = np.diff(points)
    usual = float(np.median(steps))
    if points.size < _FEWEST or np.mean(abs(steps - usual) < 0.01 * usual) < _REGULAR:
        return
    limit = min(3.0 * usual, max(WIDEST_GAP, 1.5 * usual)) * (1.0 + 1e-6)
    if (wide := steps > limit).any():
        where = int(np.argmax(wide))
        yield Problem(
            f"{key}.name", f"{int(wide.sum())} gaps, the first of {steps[where]:.6g} s after line {lines[where]}",
            f"at most {limit:.3g} s in a record of one sample in {usual:.4g} s",
            "what happened in a longer gap is not known", "a part of the record without a gap, or a bridge of your own",
        )  # fmt: skip


def _drift_problems(points: np.ndarray, drift: str, key: str) -> Iterator[Problem]:
    """A filter that the record is too short for."""
    found = DRIFT.fullmatch(drift)
    period = float(found["period"]) if found and found["period"] else 0.0
    length = float(points[-1] - points[0])
    if found and found["period"] and not 4.0 * np.median(np.diff(points)) < period <= length / 4.0:
        yield Problem(
            f"{key}.drift", drift, f"a period from four samples to a quarter of the record, {length / 4.0:.4g} s",
            "a slower motion cannot be told from the record's ends", "a shorter period, or mean",
        )  # fmt: skip


def without_noise(points: np.ndarray, values: np.ndarray, noise: float) -> np.ndarray | None:
    """The smoothing spline, at the points, that is as far from the values as their noise is large.

    Of all curves with that root mean square distance it has the least int f''^2. Source: Reinsch, Numer. Math. 10
    (1967). None where a straight line is nearer, or there are fewer than five points.

    >>> t = np.linspace(0.0, 20.0, 201)
    >>> rough = np.sin(t) + 0.1 * np.random.default_rng(1).standard_normal(t.size)
    >>> smooth = without_noise(t, rough, 0.1)
    >>> bool(np.std(smooth - np.sin(t)) < 0.06)
    True
    >>> without_noise(t, rough, 1e-15) is rough
    True
    """
    from scipy.interpolate import make_smoothing_spline
    from scipy.optimize import brentq

    if points.size < _KNOTS or np.std(values - np.polynomial.Polynomial.fit(points, values, 1)(points)) <= noise:
        return None
    count = (points - points[0]) / np.median(np.diff(points))

    def smoothed(weight: float) -> np.ndarray:
        return make_smoothing_spline(count, values, lam=10.0**weight)(count)

    def excess(weight: float) -> float:
        return float(np.sqrt(np.mean((values - smoothed(weight)) ** 2))) - noise

    stiffest = _WEIGHTS[1]
    if excess(_WEIGHTS[0]) >= 0.0:  # noise within round-off of the values: nothing to take off
        return values
    weight: Any = brentq(excess, *_WEIGHTS, xtol=1e-2) if excess(stiffest) > 0.0 else stiffest
    return smoothed(float(weight))


def _too_noisy(values: np.ndarray, choice: ColumnChoice, key: str) -> Problem:
    return Problem(
        f"{key}.noise", f"{choice.noise:g} {choice.wanted}", "less than the values scatter about a straight line",
        f"the values have a standard deviation of {np.std(values):.4g} {choice.wanted}: nothing would be left of them",
        "the noise alone, in SI units",
    )  # fmt: skip


def _without_drift(points: np.ndarray, values: np.ndarray, drift: str) -> np.ndarray:
    """Values less their mean, or less what is slower than a period: no shift of phase, faded at both ends."""
    found = DRIFT.fullmatch(drift)
    if drift == "mean":
        return values - np.trapezoid(values, points) / (points[-1] - points[0])
    if found is None or not found["period"]:
        return values
    from scipy.interpolate import CubicSpline
    from scipy.signal import butter, sosfiltfilt

    period = float(found["period"])
    even = np.linspace(points[0], points[-1], points.size)
    step = even[1] - even[0]
    slow = butter(2, 1.0 / period, "low", fs=1.0 / step, output="sos")
    pad = min(int(period / step), points.size - 1)
    trend = sosfiltfilt(slow, CubicSpline(points, values)(even), padlen=pad)
    edge = np.clip(np.minimum(points - points[0], points[-1] - points) / (period / 2.0), 0.0, 1.0)
    fade = edge**3 * (10.0 - 15.0 * edge + 6.0 * edge**2)
    return (values - np.interp(points, even, trend)) * fade
