"""What runs of the rope say of a limit, as text and as data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.tables import text_table

if TYPE_CHECKING:
    from umbilical.studies.confirm import Confirmation


def _conclusion(found: Confirmation) -> Conclusion:
    """Whether the runs keep every criterion with their whole interval, or pass one, or do not say."""
    what = f"Hs {found.height:.3g} m"
    count, reached = f"{int(found.completed.sum())} of {found.seeds.size} seeds on the rope", found.reached[found.worst]
    if not found.completed.all():
        return Conclusion("UNRESOLVED", f"{what} is NOT CONFIRMED: only {count} completed")
    share = reached.share
    told = f"{share.value:.2f} ({share.low:.2f} to {share.high:.2f}) of {found.criteria[found.worst]} is used"
    if any(each.too_many or each.share.low > 1.0 for each in found.reached):
        return Conclusion("DOES_NOT_HOLD", f"{what} is NOT CONFIRMED by {count}: {told}{_instead(found)}")
    if all(each.share.high <= 1.0 for each in found.reached):
        return Conclusion("HOLDS", f"{what} is CONFIRMED by {count}: {told}")
    return Conclusion("UNRESOLVED", f"{what} is NOT YET CONFIRMED by {count}: {told}; more seeds{_instead(found)}")


def _instead(found: Confirmation) -> str:
    """A height to try; these runs do not confirm it."""
    return f"; --height {0.99 * found.confirmed_height:.2g} may be" if found.confirmed_height > 0.0 else ""


def _text(found: Confirmation) -> str:
    """What each criterion came to, and what the runs do not know."""
    rows = [("criterion", "share used", "95 % interval", "runs that exceed it")]
    for criterion, reached in zip(found.criteria, found.reached, strict=True):
        share = reached.share
        interval = f"{share.low:.3f} to {share.high:.3f}"
        rows.append((str(criterion), f"{share.value:.3f}", interval, f"{reached.exceeded} of {found.completed.sum()}"))
    return "\n".join([
        text_table(rows, right=[1, 2, 3]),
        "  share used: of the tension or heave that a criterion allows, what is exceeded with its probability within "
        "its time (above 1: it is not kept); Gumbel of the squares of the largest in ten minutes",
        *(f"  note: {notice}" for notice in notices(found)),
    ])  # fmt: skip


def notices(found: Confirmation) -> tuple[str, ...]:
    """What the runs assume and leave out."""
    return (
        "assumed on the rope: drag across and added mass of the cable (coefficients 1.2 and 1), drag and added mass of "
        "the body as in heave in all directions; no material damping (cable.loss_factor), no current, no control",
        "a confirmed sea is one depth, period and heading; elsewhere the limits are those of the frequency domain",
    )


def _document(found: Confirmation) -> dict[str, Any]:
    """As plain data."""
    sea = found.scenario.environment.sea
    return {
        "scenario": found.scenario.to_dict(),
        "scenario_hash": found.scenario.hash,
        "height": found.height,
        "heading": sea.systems[0].heading if sea else None,
        "seeds": found.seeds.tolist(),
        "completed": found.completed.tolist(),
        "criteria": [
            {"criterion": str(c), "used": r.share._asdict(), "exceeded": r.exceeded, "too_many": r.too_many}
            for c, r in zip(found.criteria, found.reached, strict=True)
        ],
        "largest_shares": found.shares.tolist(),
        "confirmed_height": found.confirmed_height,
        "notices": notices(found),
    }


FACE = Face(_conclusion, _text, _document)
