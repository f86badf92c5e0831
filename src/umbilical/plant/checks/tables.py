"""Checks of tables: their order, what they cover, and how far a smooth curve leaves the data it is drawn through."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from umbilical.errors import Problem
from umbilical.plant.signals import spline
from umbilical.relations.instants import ROUND_OFF, apart, reaches
from umbilical.scenario.findings import Finding, Notice

MOST_OVERSHOOT = 0.05
"""Share of the data's range that a smooth curve may leave it by."""
_TOLD_OVERSHOOT = 0.01
_FEWEST = 4


class TableOf(NamedTuple):
    """A table of a scenario: key of its section, names of its two lists, where it must be known (s or x/l), and
    whether a point may stand twice, for a jump."""

    key: str
    across: str
    values: str
    span: tuple[float, float]
    exact: bool = False
    jumps: bool = False


def problems_of_a_table(table: TableOf, points: Sequence[float], count: int) -> Iterator[Finding]:
    """Order, length, and whether the table covers (or exactly spans) its span."""
    if count != len(points):
        yield Problem(f"{table.key}.{table.values}", f"{count} entries",
                      f"{len(points)} entries, one for each of {table.key}.{table.across}",
                      "each point has one value", "make both lists equally long")  # fmt: skip
    for number, (a, b) in enumerate(pairwise(points), start=1):
        if b < a or (b == a and not (table.jumps and (number < 2 or points[number - 2] < a))):
            before, here = apart(a, b)
            twice = ", but for a jump: twice, no more" if table.jumps else ""
            yield Problem(f"{table.key}.{table.across}.{number + 1}", here, f"above the one before it, {before}",
                          "the curve runs through increasing points",
                          f"sort the table; no point twice{twice}")  # fmt: skip
            return
    yield from _coverage(table, points)


def _coverage(table: TableOf, points: Sequence[float]) -> Iterator[Finding]:
    (first, last), begin, end = table.span, points[0], points[-1]
    known = reaches(-begin, -first, last) and reaches(end, last, last)
    if known and not (table.exact and max(abs(begin - first), abs(end - last)) > ROUND_OFF * last):
        return
    lowest, highest, asked_low, asked_high = apart(begin, end, first, last)
    yield Problem(f"{table.key}.{table.across}", f"{lowest} to {highest}",
                  f"{'exactly' if table.exact else 'at least'} {asked_low} to {asked_high}",
                  "nothing is known outside the table", _extension(table, points))  # fmt: skip


def _extension(table: TableOf, points: Sequence[float]) -> str:
    """What makes a table cover its span, as far as the table itself can."""
    last, begin, length = table.span[1], points[0], points[-1] - points[0]
    if table.exact:
        return "start and end the table there"
    subtracted = f"subtract the first time, {begin!r} s, from all {table.across}"
    if begin > 0.0 and reaches(length, last, last):
        return f"{subtracted}: the run starts at 0"
    if begin > ROUND_OFF * last:
        return f"{subtracted}, and set duration to {length:.9g} s at most"
    return f"extend the table, or set duration to {points[-1]:.9g} s at most"


class Overshoot(NamedTuple):
    """How far a smooth curve leaves its data: as a share of their range, at which point, and its value there."""

    share: float
    point: float
    value: float


def overshoot(points: Sequence[float], values: Sequence[float], span: tuple[float, float]) -> Overshoot:
    """Largest excursion of the cubic spline beyond the least and greatest value, within a span of the points.

    >>> overshoot([0.0, 1.0, 2.0, 3.0], [0.0, 0.0, 1.0, 1.0], (0.0, 3.0)).share > 0.05
    True
    """
    curve = spline(tuple(points), tuple(values))
    turns = curve.derivative().roots(extrapolate=False)
    at = np.concatenate([np.clip(span, points[0], points[-1]), turns[(turns >= span[0]) & (turns <= span[1])]])
    found = curve(at)
    low, high = min(values), max(values)
    beyond = np.maximum(found - high, low - found)
    worst = int(np.argmax(beyond))
    share = float(beyond[worst]) / (high - low) if high > low else 0.0
    return Overshoot(max(share, 0.0), float(at[worst]), float(found[worst]))


def smoothness(table: TableOf, points: Sequence[float], values: Sequence[float], unit: str) -> Iterator[Finding]:
    """A sound table through which the smooth curve stays near the data."""
    if any(True for _ in problems_of_a_table(table, points, len(values))):
        return
    found, key = overshoot(points, values, table.span), f"{table.key}.{table.values}"
    at = f"{found.point:.6g} s" if table.across == "times" else f"x/l = {found.point:.6g}"
    what = f"the smooth curve reaches {found.value:.4g} {unit} at {at}"
    spread = f"data from {min(values):.4g} to {max(values):.4g} {unit}"
    if found.share > MOST_OVERSHOOT:
        yield Problem(key, f"{what}, {100.0 * found.share:.3g} % of the range beyond it",
                      f"{spread}, left by {100.0 * MOST_OVERSHOOT:g} % of their range at most",
                      "a cubic spline swings far between points that are too close, or too few, for what happens there",
                      _remedy(table, points, values, found.point))  # fmt: skip
    elif found.share > _TOLD_OVERSHOOT:
        yield Notice(key, f"{what}, beyond the {spread} by {100.0 * found.share:.2g} % of their range")


def _remedy(table: TableOf, points: Sequence[float], values: Sequence[float], worst: float) -> str:
    """What keeps the curve near the data: the point near the excursion to do without, if that was tried and helps."""
    place, tried = int(np.searchsorted(points, worst)), []
    for k in range(max(place - 2, 1), min(place + 2, len(points) - 1)):
        left = [*points[:k], *points[k + 1 :]], [*values[:k], *values[k + 1 :]]
        if len(points) > _FEWEST:
            tried.append((overshoot(*left, table.span).share, k))
    share, k = min(tried, default=(1.0, 0))
    parts = ["more points where the values change fast"]
    if share <= MOST_OVERSHOOT:
        beyond = f"the curve leaves the data by {100.0 * share:.2g} %"
        parts = [f"look at point {k + 1} ({points[k]!r}, {values[k]!r}): without it {beyond}"]
    if (table.across, table.values) == ("times", "values"):
        parts.append('or interpolation = "linear", which stays in the data')
    return ", ".join(parts)
