"""A verification as a verdict, a text, data, and a page of Markdown."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.tables import markdown, plain, text_table

if TYPE_CHECKING:
    from umbilical.verify import Verification
    from umbilical.verify.cases import Check, Result

_HEAD = ("quantity", "ours", "reference", "error", "tolerance", "why this tolerance", "verdict")


def _conclusion(found: Verification) -> Conclusion:
    """Whether every check holds; without a check there is nothing to say."""
    if not any(result.checks for result in found.results):
        return Conclusion("UNRESOLVED", f"UNRESOLVED, nothing was checked: {found.headline}")
    return Conclusion("HOLDS" if found.holds else "DOES_NOT_HOLD", found.headline)


def _text(found: Verification) -> str:
    """The table, family by family, a case in a line of its own and its checks below."""
    families = ["\n".join([family, *map(_lines, results)]) for family, results in found.families.items()]
    return "\n" + "\n\n".join([*families, found.headline])


def _lines(result: Result) -> str:
    case, rows = result.case, []
    for check in result.checks:
        ours, expected, error, tolerance = shown_numbers(check)
        rows.append((check.verdict, check.quantity, ours, expected, f"error {error}", f"<= {tolerance}", check.why))
    below = f"    skipped: {result.skipped}" if result.skipped else text_table(rows, right=(2, 3, 4, 5))
    return f"  {case.name}: {case.reference} ({case.source})\n{below}"


def _document(found: Verification) -> dict[str, Any]:
    """A verification as ``--json`` prints it: a row for each check, or one that says why a case has none."""
    rows = []
    for family, results in found.families.items():
        for case, checks, skipped in results:
            common = {"family": family, "case": case.name, "reference": case.reference, "source": case.source}
            rows += [common | {"verdict": f"skipped: {skipped}"}] if skipped else [common | _row(c) for c in checks]
    return {"holds": found.holds, "headline": found.headline, "checks": rows}


def _row(check: Check) -> dict[str, Any]:
    *numbers, _ = check._asdict().items()
    lists = {name: list(getattr(check.curve, name)) for name in ("sizes", "errors")} if check.curve else {}
    return dict(numbers) | {"verdict": check.verdict} | lists


def data(found: Verification) -> str:
    """JSON text; what is not finite becomes null."""
    return json.dumps(plain(_document(found), finite=True), indent=2, allow_nan=False) + "\n"


def markdown_page(found: Verification, picture: str) -> str:
    """A page of its own: every table and the picture."""
    parts = ["# Verification", f"{found.headline}."]
    for family, results in found.families.items():
        parts.append(f"### {family}")
        for case, checks, skipped in results:
            parts.append(f"**{case.name}**, against {case.reference}. Source: {case.source}.")
            rows = [(c.quantity, *shown_numbers(c), c.why, c.verdict.replace("FAILS", "**FAILS**")) for c in checks]
            parts.append(f"Skipped: {skipped}." if skipped else markdown([_HEAD, *rows]))
    return "\n\n".join([*parts, f"![errors over grids]({picture})"]) + "\n"


def shown_numbers(check: Check) -> tuple[str, str, str, str]:
    """Ours, the reference, error and tolerance as they are printed everywhere.

    Errors with one digit: more would change from machine to machine.
    """
    return f"{check.ours:.7g}", f"{check.expected:.7g}", one_digit(check.error), f"{check.tolerance:.2g}"


def one_digit(error: float) -> str:
    """An error as it is printed: below 1e-12 it is round-off, below 0 more than was asked for."""
    if error <= 0.0:
        return "none"
    return "round-off" if error < 1e-12 else f"{error:.0e}"


FACE = Face(_conclusion, _text, _document)
