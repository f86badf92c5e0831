"""A design as a verdict, a text and data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces import margins
from umbilical.faces.conclusion import Conclusion, Face
from umbilical.tables import attributes, text_table

if TYPE_CHECKING:
    from umbilical.synthesis.design import Design
    from umbilical.synthesis.iterate import Evaluation

NOT_ASKED = "the engine's grids; `umbilical margins` of these gains asks them, and may leave the margins unresolved"


def _conclusion(found: Design) -> Conclusion:
    """Whether the gains keep every margin and limit."""
    state = "all margins (of the exact cable) and limits are kept" if found.met else "NOT everything is kept"
    headline = f"{found.after.scenario.name}: designed for {found.objective}; {state}"
    return Conclusion("HOLDS" if found.met else "DOES_NOT_HOLD", headline)


def _document(found: Design) -> dict[str, Any]:
    """A design as ``--json`` prints it."""
    return {
        **attributes(found, "objective met missing limited_by values"),
        "not_asked": NOT_ASKED,
        "patch": found.patch(),
        "before": _side(found.before),
        "after": _side(found.after),
    }


def _side(side: Evaluation) -> dict[str, Any]:
    return {
        "margins_met": side.meets,
        "margins_met_at_any_length": side.kept,
        "reflection_of_first_modes": side.score.reflection,
        "compliance": side.score.compliance,
        "status": side.trial.run.status.name,
        **attributes(side.trial, "late_mid_peak tip_peak voltage_peak speed_peak chatter"),
        "noise": side.noise,
        "margins": margins.FACE.document(side.report),
    }


def _text(found: Design) -> str:
    """What the verdict rests on, as people read it."""
    lines = [f"  missing: {words}" for words in found.missing]
    lines += [f"  limit: {words}" for words in found.limited_by]
    lines += [text_table(_comparison(found), right=(1, 2)), "", found.patch().rstrip(), ""]
    for side, words in ((found.before, "before"), (found.after, "after")):
        lines += [f"  margins {words}", text_table(margins.rows(side.report), right=range(7))]
    lines.append(f"  not asked: {NOT_ASKED}")
    return "\n".join(lines)


def _comparison(found: Design) -> list[tuple[str, str, str]]:
    named = {
        "reflection of the first modes": lambda s: f"{s.score.reflection:.4g}",
        "ROV per force, first modes": lambda s: f"{s.score.compliance:.3g} m/N",
        "demanded margins, at these lengths": lambda s: "kept" if s.meets else "missed",
        "... at any length from the shortest on": lambda s: "kept" if s.kept else "missed",
        "simulation": lambda s: s.trial.run.status.name.lower(),
        "midpoint, peak in the last third": lambda s: f"{s.trial.late_mid_peak:.4g} m",
        "ROV, peak": lambda s: f"{s.trial.tip_peak:.4g} m",
        "voltage, peak": lambda s: f"{s.trial.voltage_peak:.4g} V",
        "motor speed, peak": lambda s: f"{s.trial.speed_peak:.4g} rad/s",
        "voltage above 10 Hz, RMS in the last third": lambda s: f"{s.trial.chatter:.3g} V",
        "... that sensors' noise explains, where it is worst": lambda s: f"{s.noise.rms:.3g} V",
    }
    rows = [("", "before", "after")]
    return rows + [(words, show(found.before), show(found.after)) for words, show in named.items()]


FACE = Face(_conclusion, _text, _document)
