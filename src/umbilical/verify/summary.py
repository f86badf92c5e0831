"""A verification as a verdict and a text and data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion
from umbilical.faces.text import table

if TYPE_CHECKING:
    from umbilical.verify import Verification
    from umbilical.verify.cases import Check


def conclusion(found: Verification) -> Conclusion:
    """Whether every check holds; without a check there is nothing to say."""
    if not any(result.checks for result in found.results):
        return Conclusion("UNRESOLVED", f"UNRESOLVED, nothing was checked: {found.headline}")
    return Conclusion("HOLDS" if found.holds else "DOES_NOT_HOLD", found.headline)


def text(found: Verification) -> str:
    """The table, family by family, a case in a line of its own and its checks below."""
    parts = []
    for family, results in found.families.items():
        lines = [family]
        for result in results:
            lines.append(f"  {result.case.name}: {result.case.reference} ({result.case.source})")
            lines += [f"    skipped: {result.skipped}"] if result.skipped else []
            lines.append(table([_row(check) for check in result.checks], right=(2, 3, 4, 5)))
        parts.append("\n".join(filter(None, lines)))
    return "\n" + "\n\n".join([*parts, found.headline])


def _row(check: Check) -> tuple[str, ...]:
    from umbilical.verify.page import numbers

    ours, expected, error, tolerance = numbers(check)
    verdict = "holds" if check.holds else "FAILS"
    return verdict, check.quantity, ours, expected, f"error {error}", f"<= {tolerance}", check.why


def document(found: Verification) -> dict[str, Any]:
    """A verification as ``--json`` prints it."""
    from umbilical.verify.verification import rows_of

    rows = [
        {"family": family} | row
        for family, results in found.families.items()
        for result in results
        for row in rows_of(result)
    ]
    return {"holds": found.holds, "headline": found.headline, "checks": rows}
