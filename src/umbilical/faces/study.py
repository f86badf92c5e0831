"""What a study found, as text and as JSON."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.analysis.paired import Estimate
from umbilical.faces.conclusion import Conclusion, Face
from umbilical.quantities import METRICS
from umbilical.studies import statistics
from umbilical.studies.members import Draws
from umbilical.studies.rows import STATUSES
from umbilical.studies.sensitivity import influences
from umbilical.studies.statistics import interval_text, percentage
from umbilical.studies.sweep import worst
from umbilical.tables import text_table, wrapped

if TYPE_CHECKING:
    from umbilical.studies.results import StudyResult
    from umbilical.studies.study import Study

USUAL = ("tip_peak", "tip_rms", "mid_rms", "effort_rms")
"""Metrics that are shown where none is named."""
NONE_COMPLETED = "no member completed in any arm: there is nothing to tell"
_SHARES = (0.5, 0.95)
_WORST = 3
_REASONS = 3


def _text(
    result: StudyResult, metrics: tuple[str, ...] = (), against: str | None = None, sensitivity: str | None = None
) -> str:
    """What stands below the headline: endings, distributions, comparisons with an arm (the first), the worst, and where
    a metric is named which draws matter for it.
    """
    study, chosen = result.study, metrics or tuple(name for name in USUAL if name in result.metrics)
    parts = [wrapped(study.description)]
    parts += [_endings(result), _reasons(result)]
    for metric in chosen:
        parts += [_distribution(result, metric), _comparison(result, metric, against or result.arms[0])]
    parts += [_exceedances(result)] if study.limits else []
    parts += [_worst(result, chosen[0]), statistics.caveat(study.design)] if chosen else [NONE_COMPLETED]
    parts += [_sensitivity_text(result, sensitivity)] if sensitivity else []
    return "\n" + "\n\n".join(filter(None, parts))


def _conclusion(result: StudyResult, *_: object) -> Conclusion:
    """Whether every arm has a member that completed: what did not complete is no measurement."""
    size, arms, lost = result.data.sizes["member"], len(result.arms), result.lost
    least = min(found["COMPLETED"] for found in endings(result).values())
    verdict = "all completed" if least == size else f"{least} completed{' in the worst of them' * (arms > 1)}"
    if lost:
        verdict = f"NOT ONE COMPLETED in {'any arm' if len(lost) == arms else ', '.join(lost)}"
    headline = f"{result.study.name}: {size} members in {arms} arms, {verdict}; {result.study.hash[:12]}"
    return Conclusion("DOES_NOT_HOLD" if lost else "HOLDS", headline)


def endings(result: StudyResult) -> dict[str, dict[str, int]]:
    """How many members ended how, by arm."""
    return {
        arm: {status: int(np.count_nonzero(result.ended(arm, status))) for status in STATUSES} for arm in result.arms
    }


def _table(
    arms: Sequence[str], head: Sequence[str], cells: Callable[[str], Iterable[str]], *, right: bool = True
) -> str:
    """A line for each arm below a head; nothing where there is no arm."""
    rows = [head, *((arm, *cells(arm)) for arm in arms)]
    return text_table(rows, range(1, len(head)) if right else ()) if arms else ""


def _endings(result: StudyResult) -> str:
    found = endings(result)
    return _table(result.arms, ("how they ended", *STATUSES), lambda arm: map(str, found[arm].values()))


def _reasons(result: StudyResult) -> str:
    """The commonest reasons of what did not complete."""
    rows = [
        (arm, f"{reason.count} {reason.status}", f"e.g. {reason.example}")
        for arm in result.arms
        for reason in statistics.reasons(result, arm)[:_REASONS]
    ]
    return text_table([("why not all completed", "", ""), *rows]) if rows else ""


def _distribution(result: StudyResult, metric: str) -> str:
    """Median and 95 % quantile of each arm."""
    word = METRICS[metric]
    head = (f"{metric} [{word.unit}]", "median", "95 % quantile")

    def cells(arm: str) -> Iterable[str]:
        return (interval_text(statistics.at(result, metric, arm, share)) for share in _SHARES)

    return f"{_table(result.arms, head, cells, right=False)}\n  {word.meaning}"


def _comparison(result: StudyResult, metric: str, first: str) -> str:
    """Every other arm against one, on the same draws."""
    head = (f"against '{first}', draw by draw", "ratio", f"difference [{METRICS[metric].unit}]", "smaller in")

    def cells(arm: str) -> Iterable[str]:
        found = statistics.against(result, metric, arm, first)
        return interval_text(found.ratio), interval_text(found.difference), percentage(found.better)

    return _table([arm for arm in result.arms if arm != first], head, cells, right=False)


def _exceedances(result: StudyResult) -> str:
    limits = result.study.limits.items()

    def cells(arm: str) -> Iterable[str]:
        return (percentage(statistics.beyond(result, name, arm, limit)) for name, limit in limits)

    return _table(result.arms, ("probability of", *(f"{name} > {limit:g}" for name, limit in limits)), cells)


def _worst(result: StudyResult, metric: str) -> str:
    def cells(arm: str) -> Iterable[str]:
        values = result.values(metric, arm)
        found = [f"#{number}: {values[number - 1]:.4g}" for number in worst(result, metric, arm, _WORST)]
        return [*found, *[""] * (_WORST - len(found))]

    return _table(result.arms, ("worst members", *(f"{metric}, {k}." for k in range(1, _WORST + 1))), cells)


def _sensitivity_text(result: StudyResult, metric: str) -> str:
    """Which draws matter, in each arm.

    Raises:
        MissingPartnerError: SALib is not installed.
    """
    parts = []
    for arm, found in influences(result, metric, result.arms).items():
        if isinstance(found, str):
            parts.append(f"{arm}: {found}")
            continue
        rows = [(f"{metric}, {arm}", "first", "+-", "total or deviation")]
        rows += [(i.name, *("-" if np.isnan(value) else f"{value:.3g}" for value in i[1:])) for i in found]
        parts.append(text_table(rows, right=(1, 2, 3)))
    return "\n\n".join(parts)


def _document(
    result: StudyResult, metrics: tuple[str, ...] = (), against: str | None = None, sensitivity: str | None = None
) -> dict[str, Any]:
    """A study's result as ``--json`` prints it; comparisons are with an arm, the first if none is named."""
    first, limits = against or result.arms[0], result.study.limits.items()
    document: dict[str, Any] = {
        "study": result.study.name,
        "study_hash": result.study.hash,
        "members": result.data.sizes["member"],
        "endings": endings(result),
        "none_completed": list(result.lost),
        "reasons": {arm: [r._asdict() for r in statistics.reasons(result, arm)[:_REASONS]] for arm in result.arms},
        "metrics": {m: {a: _numbers(result, m, a, first) for a in result.arms} for m in metrics or result.metrics},
        "against": first,
        "limits": {
            name: {arm: _estimate(statistics.beyond(result, name, arm, limit)) for arm in result.arms}
            for name, limit in limits
        },
        "intervals": statistics.caveat(result.study.design),
    }
    if sensitivity:
        arms = {
            arm: {"reason": found} if isinstance(found, str) else {"draws": [each._asdict() for each in found]}
            for arm, found in influences(result, sensitivity, result.arms).items()
        }
        document["sensitivity"] = {"metric": sensitivity, "arms": arms}
    return document


def _numbers(result: StudyResult, metric: str, arm: str, first: str) -> dict[str, Any]:
    found: dict[str, Any] = {
        name: _estimate(statistics.at(result, metric, arm, share))
        for name, share in zip(("median", "q95"), _SHARES, strict=True)
    }
    found["worst"] = worst(result, metric, arm, _WORST)
    if arm != first:
        compared = statistics.against(result, metric, arm, first)._asdict()
        members = {"members": compared.pop("members")}
        found["compared"] = members | {name: _estimate(estimate) for name, estimate in compared.items()}
    return found


def _estimate(found: Estimate) -> dict[str, Any]:
    """An estimate as data; its status says what null stands for: larger than any number, or nothing at all."""
    status = "none" if np.isnan(found.value) else "infinite" if np.isinf(found.value) else "finite"
    return {**found._asdict(), "status": status}


def describe(study: Study) -> str:
    """A study before it is run: what varies, what is compared."""
    draws = Draws(study)
    middle = [draws.values(draws.member(number)) for number in range(1, min(len(draws), 2) + 1)]
    rows: list[tuple[str, ...]] = [("drawn", "how", *(f"#{k}" for k in range(1, len(middle) + 1)))]
    rows += [(v.name, v.distribution.kind, *(_short(m[v.name]) for m in middle)) for v in draws.variables]
    arms = [("arm", "changes")] + [(a.name, ", ".join(a.changes) or "none") for a in study.arms]
    head = f"{study.name}: {len(draws)} members ({study.design}) in {len(study.arms)} arms of '{study.scenario.name}'"
    parts = [head, wrapped(study.description), text_table(rows), text_table(arms)]
    if study.assumed:
        parts += ["assumed, because no source gives them:", text_table(list(study.assumed.items()))]
    return "\n\n".join(filter(None, parts))


def _short(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


FACE = Face(_conclusion, _text, _document)
