"""What a study found, as text and as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.analysis.paired import Estimate, compare, exceedance, quantile
from umbilical.cli.speech import shown_unit, table
from umbilical.quantities import METRICS
from umbilical.studies.rows import STATUSES
from umbilical.studies.sweep import worst

if TYPE_CHECKING:
    from umbilical.studies.results import StudyResult
    from umbilical.studies.study import Study

USUAL = ("tip_peak", "tip_rms", "mid_rms", "effort_rms")
"""Metrics that are shown where none is named."""
_WORST = 3


def report(result: StudyResult, metrics: tuple[str, ...] = (), against: str | None = None) -> str:
    """Endings, distributions, comparisons with an arm (the first), limits and the worst members of each arm."""
    study = result.study
    size = result.data.sizes["member"]
    parts = [f"{study.name}: {size} members in {len(result.arms)} arms, {study.hash[:12]}", study.description]
    parts.append(_endings(result))
    for metric in metrics or _usual(result):
        parts.append(_distribution(result, metric, against or result.arms[0]))
    parts += [_exceedances(result)] if study.limits else []
    parts.append(_worst(result, (metrics or _usual(result))[0]))
    return "\n\n".join(filter(None, parts))


def _usual(result: StudyResult) -> tuple[str, ...]:
    return tuple(name for name in USUAL if name in result.metrics)


def endings(result: StudyResult) -> dict[str, dict[str, int]]:
    """How many members ended how, by arm."""
    status = result["status"].values
    return {
        arm: {name: int(np.count_nonzero(status[:, k] == code)) for code, name in enumerate(STATUSES)}
        for k, arm in enumerate(result.arms)
    }


def _endings(result: StudyResult) -> str:
    rows = [("how they ended", *STATUSES)]
    rows += [(arm, *(str(count) for count in found.values())) for arm, found in endings(result).items()]
    return table(rows, right=range(1, len(STATUSES) + 1))


def _distribution(result: StudyResult, metric: str, first: str) -> str:
    """Median, 95 % quantile, and the comparison with one arm."""
    word = METRICS[metric]
    head = (f"{metric} [{shown_unit(word.unit) or '1'}]", "median", "95 %", "ratio", "(interval)", "better in")
    rows: list[tuple[str, ...]] = [head]
    for arm in result.arms:
        values = result.values(metric, arm)
        found = [f"{quantile(values, share).value:.4g}" for share in (0.5, 0.95)]
        rows.append((arm, *found, *(_against(result, metric, arm, first) if arm != first else ("", "", ""))))
    note = f"  {word.meaning}; ratio and better: against '{first}' on the same draws" if len(result.arms) > 1 else ""
    return "\n".join(filter(None, [table(rows, right=range(1, 6)), note]))


def _against(result: StudyResult, metric: str, arm: str, other: str) -> tuple[str, str, str]:
    found = compare(result.values(metric, arm), result.values(metric, other))
    return f"{found.ratio.value:.4g}", f"({found.ratio.low:.4g} to {found.ratio.high:.4g})", _percent(found.better)


def _exceedances(result: StudyResult) -> str:
    rows = [("probability of", *(f"{name} > {limit:g}" for name, limit in result.study.limits.items()))]
    for arm in result.arms:
        found = [exceedance(result.values(name, arm), limit) for name, limit in _limits(result)]
        rows.append((arm, *(_percent(estimate) for estimate in found)))
    return table(rows, right=range(1, len(rows[0])))


def _limits(result: StudyResult) -> list[tuple[str, float]]:
    return [(name, limit) for name, limit in result.study.limits.items() if name in result.metrics]


def _percent(estimate: Estimate) -> str:
    low, high = 100 * estimate.low, 100 * estimate.high
    return f"{100 * estimate.value:.3g} % ({low:.3g} to {high:.3g})"


def _worst(result: StudyResult, metric: str) -> str:
    rows = [("worst members", *(f"{metric}, {k}." for k in range(1, _WORST + 1)))]
    for arm in result.arms:
        values = result.values(metric, arm)
        found = [f"#{number}: {values[number - 1]:.4g}" for number in worst(result, metric, arm, _WORST)]
        rows.append((arm, *found, *[""] * (_WORST - len(found))))
    return table(rows, right=range(1, _WORST + 1))


def sensitivity_text(result: StudyResult, metric: str) -> str:
    """Which draws matter, in each arm.

    Raises:
        MissingPartnerError: SALib is not installed.
    """
    from umbilical.studies.sensitivity import rank

    parts = []
    for arm in result.arms:
        try:
            found = rank(result, metric, arm)
        except ValueError as error:
            parts.append(f"{arm}: {error}")
            continue
        rows = [(f"{metric}, {arm}", "first", "+-", "total or deviation")]
        rows += [(i.name, f"{i.first:.3g}", f"{i.first_error:.2g}", _or_dash(i.total)) for i in found]
        parts.append(table(rows, right=(1, 2, 3)))
    return "\n\n".join(parts)


def _or_dash(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.3g}"


def study_document(
    result: StudyResult, files: dict[str, str] | None = None, against: str | None = None
) -> dict[str, Any]:
    """A study's result as ``--json`` prints it; comparisons are with an arm, the first if none is named."""
    first = against or result.arms[0]
    return {
        "study": result.study.name,
        "study_hash": result.study.hash,
        "members": result.data.sizes["member"],
        "endings": endings(result),
        "metrics": {
            metric: {arm: _numbers(result, metric, arm, first) for arm in result.arms} for metric in result.metrics
        },
        "against": first,
        "limits": {
            name: {arm: exceedance(result.values(name, arm), limit)._asdict() for arm in result.arms}
            for name, limit in _limits(result)
        },
        "files": dict(files or {}),
    }


def _numbers(result: StudyResult, metric: str, arm: str, first: str) -> dict[str, Any]:
    values = result.values(metric, arm)
    found: dict[str, Any] = {name: quantile(values, s)._asdict() for name, s in (("median", 0.5), ("q95", 0.95))}
    found["worst"] = worst(result, metric, arm, _WORST)
    if arm != first:
        against = compare(values, result.values(metric, first))
        found["compared"] = {"ratio": against.ratio._asdict(), "better": against.better._asdict()}
    return found


def describe(study: Study) -> str:
    """A study before it is run: what varies, what is compared."""
    from umbilical.studies.members import Draws

    draws = Draws(study)
    middle = [draws.values(draws.member(number)) for number in range(1, min(len(draws), 2) + 1)]
    rows: list[tuple[str, ...]] = [("drawn", "how", *(f"#{k}" for k in range(1, len(middle) + 1)))]
    rows += [(v.name, v.distribution.kind, *(_short(m[v.name]) for m in middle)) for v in draws.variables]
    arms = [("arm", "changes")] + [(a.name, ", ".join(a.changes) or "none") for a in study.arms]
    head = f"{study.name}: {len(draws)} members ({study.design}) in {len(study.arms)} arms of '{study.scenario.name}'"
    parts = [head, study.description, table(rows), table(arms)]
    if study.assumed:
        parts += ["assumed, because no source gives them:", table(list(study.assumed.items()))]
    return "\n\n".join(filter(None, parts))


def _short(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
