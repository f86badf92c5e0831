"""The risk of lowering through the resonance depths as a verdict, a text and data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.faces.operability import remarks, thinned
from umbilical.tables import text_table

if TYPE_CHECKING:
    from umbilical.screening import Lowering


def _conclusion(found: Lowering, risk: float | None = None) -> Conclusion:
    """Whether the best speed keeps the accepted risk, if one was given."""
    if risk is None:
        return Conclusion("NOT_ASKED", found.summary())
    holds = bool(found.risk[found.best] <= risk)
    headline = f"{found.summary()}; {'within' if holds else 'ABOVE'} the accepted {risk:g}"
    return Conclusion("HOLDS" if holds else "DOES_NOT_HOLD", headline)


def _text(found: Lowering, _risk: float | None = None) -> str:
    rows = [("speed", "probability of slack", "duration", "least mean tension")]
    rows += [
        (
            f"{found.speed[k]:.3g} m/s",
            f"{found.risk[k]:.2g}",
            f"{(found.depth[-1] - found.depth[0]) / found.speed[k] / 60.0:.3g} min",
            f"{found.mean_tension[k].min():.4g} N",
        )
        for k in thinned(found.speed.size)
    ]
    waiting = f"  where to wait: {found.waiting_depth:.4g} m, outside the resonance"
    return "\n".join([text_table(rows, right=[1, 2, 3]), waiting, *remarks(found.notices(), found.operation)])


def _document(found: Lowering, risk: float | None = None) -> dict[str, Any]:
    return {**found.to_dict(), "accepted_risk": risk}


FACE = Face(_conclusion, _text, _document)
