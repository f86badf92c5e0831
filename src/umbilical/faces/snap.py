"""How likely a rope goes slack and how hard it snaps, as text and as data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.studies.statistics import interval_text
from umbilical.tables import attributes

if TYPE_CHECKING:
    from umbilical.studies.snap import SnapStudy


def _conclusion(found: SnapStudy, risk: float | None = None) -> Conclusion:
    """Whether slack is as unlikely as was asked, if it was."""
    if not found.completed.all():
        return Conclusion("UNRESOLVED", f"UNRESOLVED, not every seed completed: {_told(found)}")
    if risk is None:
        return Conclusion("NOT_ASKED", _told(found))
    if found.slack.low <= risk < found.slack.high:
        return Conclusion("UNRESOLVED", f"UNRESOLVED, more seeds are needed for {risk:g}: {_told(found)}")
    within = found.slack.high <= risk
    told = f"{_told(found)}; {'within' if within else 'ABOVE'} the accepted {risk:g}"
    return Conclusion("HOLDS" if within else "DOES_NOT_HOLD", told)


def _told(found: SnapStudy) -> str:
    """Probability of slack and largest snap."""
    ran, good = found.seeds.size, int(found.completed.sum())
    runs = f"{ran} seeds of {found.scenario.duration:g} s" + ("" if good == ran else f", {good} completed")
    if not good:
        return runs
    chance = f"probability {found.slack.low:.2g} to {found.slack.high:.2g}"
    slack = f"slack in {round(found.slack.value * good)} of {good} ({chance})"
    largest = float(found.largest_snap[found.completed].max())
    return f"{runs}: {slack}; " + (f"largest snap {largest:.4g} N" if largest else "no snap")


def _text(found: SnapStudy, risk: float | None = None) -> str:
    """What the runs came to, the rule of thumb beside it, and the distribution of the largest tensions."""
    lines = [f"  did not complete: {reason}" for reason in found.reasons]
    if found.completed.any():
        largest = found.largest_tension[found.completed].max()
        lines += [
            f"  snaps in all runs: {int(found.snaps[found.completed].sum())}",
            f"  largest tension: {largest:.4g} N; static at the vessel {found.static_tension:.4g} N",
            f"  rule of thumb, static + v sqrt(K M): {found.rule_of_thumb:.4g} N at the largest speed of the body "
            f"against the sheave, {found.impact_speed.max():.3g} m/s; waves along the cable can double v sqrt(K M)",
            f"  {_fitted(found)}",
        ]
    return "\n".join([*lines, f"  assumed: {', '.join(found.scenario.assumed) or 'nothing'}"])


def _fitted(found: SnapStudy) -> str:
    if (fit := found.extreme) is None:
        return "no distribution of the largest tensions: fewer than five runs completed"
    law = f"Gumbel of the largest tensions: location {fit.location:.4g} N, scale {fit.scale:.4g} N"
    return f"{law}; one run in a hundred exceeds {interval_text(fit.exceeded, unit=' N')}"


def _document(found: SnapStudy, risk: float | None = None) -> dict[str, Any]:
    """As plain data."""
    fit = found.extreme
    return {
        "scenario": found.scenario.name,
        "scenario_hash": found.scenario.hash,
        **attributes(found, "seeds completed reasons largest_tension snaps largest_snap impact_speed static_tension"),
        **attributes(found, "rule_of_thumb slack"),
        "gumbel": fit and attributes(fit, "location scale") | {"exceeded_by_1_in_100": fit.exceeded},
        "accepted_risk": risk,
    }


FACE = Face(_conclusion, _text, _document)
