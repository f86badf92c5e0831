"""Statistics of a study's result: what its samples say, and how sure that is."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from umbilical.analysis import paired
from umbilical.analysis.paired import Comparison, Estimate
from umbilical.studies.rows import STATUSES

if TYPE_CHECKING:
    from umbilical.studies.results import StudyResult
    from umbilical.studies.study import Method

NO_SAMPLE = ("grid", "saltelli", "morris")
"""Designs whose members are chosen, not drawn: an interval would speak of draws that nobody made."""
TIE = 1e-4
"""Relative difference below which two metrics are equal: what the plant's own discretisation moves them by."""
_NUMBER = re.compile(r"-?\d+(\.\d+)?(e[+-]?\d+)?")


class Reason(NamedTuple):
    """Why members did not complete: how many, how they ended, and the first of their texts."""

    count: int
    status: str
    example: str


def at(result: StudyResult, metric: str, arm: str, share: float) -> Estimate:
    """A quantile of a metric over the members."""
    return _as_sure_as_it_is(result, paired.quantile(result.values(metric, arm), share))


def beyond(result: StudyResult, metric: str, arm: str, limit: float) -> Estimate:
    """Share of the members in which a metric exceeds a limit."""
    return _as_sure_as_it_is(result, paired.exceedance_probability(result.values(metric, arm), limit))


def against(result: StudyResult, metric: str, arm: str, other: str) -> Comparison:
    """One arm against another on the same draws; values that differ by less than :data:`TIE` are equal."""
    values, reference = result.values(metric, arm), result.values(metric, other)
    tied = np.isclose(values, reference, rtol=TIE, atol=0.0)
    members, *found = paired.compare(np.where(tied, reference, values), reference)
    return Comparison(members, *(_as_sure_as_it_is(result, estimate) for estimate in found))


def ratios(result: StudyResult, metric: str, arm: str, other: str) -> np.ndarray:
    """One arm's values over another's, member by member; 1 where both are equal or both infinite."""
    values, reference = result.values(metric, arm), result.values(metric, other)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(values == reference, 1.0, values / reference)


def caveat(design: Method) -> str:
    """What the intervals of a design are worth; empty where they are what they say."""
    if design in NO_SAMPLE:
        return f"no intervals: the members of a {design} design are chosen, not drawn"
    if design in ("latin", "sobol"):
        return f"intervals assume independent draws; a {design} design is more even, so they are usually too wide"
    return ""


def reasons(result: StudyResult, arm: str) -> list[Reason]:
    """Why members of an arm did not complete, the commonest first; texts that differ in numbers only are one."""
    chosen = result.data[["status", "reason"]].sel(arm=arm)
    texts = [(STATUSES[s], str(r)) for s, r in zip(chosen["status"].values, chosen["reason"].values, strict=True) if s]
    first: dict[tuple[str, str], str] = {}
    for status, text in texts:
        first.setdefault((status, _NUMBER.sub("#", text)), text)
    counts = Counter((status, _NUMBER.sub("#", text)) for status, text in texts)
    return [Reason(count, kind[0], first[kind]) for kind, count in counts.most_common()]


def interval_text(found: Estimate, digits: int = 4, unit: str = "") -> str:
    """An estimate in words; without its interval where it has none, a dash where it is nothing.

    >>> nan = float("nan")
    >>> interval_text(Estimate(0.5, 0.25, float("inf"))), interval_text(Estimate(50.0, nan, nan), unit=" %")
    ('0.5 (0.25 to open)', '50 %')
    """
    if np.isnan(found.value):
        return "-"
    low = "open" if found.low == -np.inf else f"{found.low:.{digits}g}"
    high = "open" if found.high == np.inf else f"{found.high:.{digits}g}"
    interval = "" if np.isnan(found.low) else f" ({low} to {high})"
    return f"{found.value:.{digits}g}{unit}{interval}"


def percentage(found: Estimate) -> str:
    """A share in percent, with its interval."""
    return interval_text(Estimate(*(100.0 * value for value in found)), 3, " %")


def _as_sure_as_it_is(result: StudyResult, found: Estimate) -> Estimate:
    return Estimate(found.value, float("nan"), float("nan")) if result.study.design in NO_SAMPLE else found
