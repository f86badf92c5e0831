"""A search over gains as a verdict, a text and data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.tables import text_table

if TYPE_CHECKING:
    from umbilical.studies.tune import Tuned

_SHOWN = 12


def _conclusion(found: Tuned) -> Conclusion:
    """Whether some gains keep every condition."""
    kept = sum(trial.verdict.broken == 0.0 for trial in found.trials)
    headline = f"{found.study.name}: {len(found.trials)} trials, {kept} of which keep every condition"
    if not found.front:
        return Conclusion("DOES_NOT_HOLD", f"{headline}: none is left to choose")
    return Conclusion("HOLDS", headline)


def _text(found: Tuned) -> str:
    """What broke, and the gains that are left, as people read it."""
    head = ("", *found.gains, *found.objectives)
    rows = [
        (str(k), *(f"{g:.5g}" for g in t.gains.values()), *(f"{v:.5g}" for v in t.verdict.values))
        for k, t in enumerate(found.front, start=1)
    ]
    text = "broken by: " + ", ".join(f"{name} {count}" for name, count in found.broken.items())
    if not rows:
        return text
    what = "no other trial beats these" if len(found.objectives) > 1 else "the best"
    more = f"\n  ... and {len(rows) - _SHOWN} more in tuning.json" if len(rows) > _SHOWN else ""
    return f"{text}\n{what}:\n\n{text_table([head, *rows[:_SHOWN]], range(len(head)))}{more}"


def _document(found: Tuned) -> dict[str, Any]:
    """A search as ``--json`` prints it."""
    return found.document()


FACE = Face(_conclusion, _text, _document)
