"""Which of the draws matter: sensitivity indices by SALib."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from umbilical.studies.designs import partner, salib_problem
from umbilical.studies.results import StudyResult
from umbilical.studies.statistics import NO_SAMPLE

_RESAMPLES = 200


class Influence(NamedTuple):
    """What one draw does to a metric.

    Attributes:
        name: what is drawn.
        first: share of the variance it explains alone (Sobol's first index); Morris: its elementary effects' mean size,
            in the metric's unit over the whole range of the draw.
        first_error: half of the 95 % confidence interval of that; not a number where it is exact.
        total: share of the variance it has a part in (Sobol's total index); Morris: deviation of its effects, which is
            large where it acts differently in company; not a number where the design does not tell.
    """

    name: str
    first: float
    first_error: float
    total: float


def rank(result: StudyResult, metric: str, arm: str) -> list[Influence]:
    """Influence of every draw on a metric, the strongest first.

    A study with the design ``saltelli`` gives Sobol's indices, first and total; one with ``morris`` elementary effects;
    a grid Sobol's first indices without any error, and needs no SALib; any other the first indices, estimated from the
    draws as they are (random balance designs). Runs that diverged or failed count as the largest value that one of
    those that did not has; members that were refused, being no possible systems, are left out.

    Raises:
        MissingPartnerError: SALib is not installed.
        ValueError: too few members, nothing varies, or members were refused of a design that needs them all.

    >>> from umbilical.studies.load import load_study
    >>> from umbilical.studies.sweep import sweep
    >>> small = load_study("fault-map").replace({"scenario.duration": 0.2, "changes": {"grid.elements": 8}})
    >>> found = rank(sweep(small), "tip_peak", "proposed")
    Traceback (most recent call last):
    ...
    ValueError: tip_peak does not vary in the arm 'proposed'
    """
    points, values = _possible(result, metric, arm)
    if np.ptp(values) == 0.0:
        raise ValueError(f"{metric} does not vary in the arm '{arm}'")
    columns = _of_a_grid(points, values) if result.study.design == "grid" else _by_salib(result, points, values)
    names = [str(name) for name in result["variable"].values]
    influences = [Influence(n, float(a), float(b), float(c)) for n, a, b, c in zip(names, *columns, strict=True)]
    return sorted(influences, key=lambda influence: -np.nan_to_num(influence.first, nan=-np.inf))


def influences(result: StudyResult, metric: str, arms: Iterable[str]) -> dict[str, list[Influence] | str]:
    """By arm what :func:`rank` gives, or why nobody can tell.

    Raises:
        MissingPartnerError: SALib is not installed.
    """
    found: dict[str, list[Influence] | str] = {}
    for arm in arms:
        try:
            found[arm] = rank(result, metric, arm)
        except ValueError as error:
            found[arm] = str(error)
    return found


def _of_a_grid(points: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, ...]:
    """Variance of the means over each value of a draw: on a full grid this is the index."""
    first = []
    for column in points.T:
        _, places = np.unique(column, return_inverse=True)
        means = np.bincount(places, values) / np.bincount(places)
        first.append(np.var(means[places]) / np.var(values))
    return np.array(first), *np.full((2, len(first)), np.nan)


def _by_salib(result: StudyResult, points: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, ...]:
    salib, seed = partner(), result.study.seed % 2**32
    problem = salib_problem(points.shape[1])
    common = {"num_resamples": _RESAMPLES, "seed": seed}
    if result.study.design == "saltelli":
        found = salib.analyze.sobol.analyze(problem, values, calc_second_order=False, **common)
        return found["S1"], found["S1_conf"], found["ST"]
    if result.study.design == "morris":
        found = salib.analyze.morris.analyze(problem, points, values, **common)
        return found["mu_star"], found["mu_star_conf"], found["sigma"]
    if values.size < 64:
        raise ValueError(f"{values.size} members are too few to tell influences apart; 64 at least")
    found = salib.analyze.rbd_fast.analyze(problem, points, values, **common)
    return found["S1"], found["S1_conf"], np.full(points.shape[1], np.nan)


def _possible(result: StudyResult, metric: str, arm: str) -> tuple[np.ndarray, np.ndarray]:
    """Points and values of the members that are possible systems."""
    points, values = result["point"].values, result.values(metric, arm)
    possible = ~np.isnan(values)
    if result.study.design in NO_SAMPLE and not possible.all():
        lost = np.count_nonzero(~possible)
        raise ValueError(f"{lost} members have no {metric}, and a {result.study.design} design needs them all")
    if not np.isfinite(values).any():
        raise ValueError(f"no member has a {metric} in the arm '{arm}'")
    values = np.where(np.isinf(values), values[np.isfinite(values)].max(), values)
    return points[possible], values[possible]
