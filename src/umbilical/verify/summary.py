"""A verification as a verdict, a text, data, and a page of Markdown."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.tables import finite_only, markdown, text_table

if TYPE_CHECKING:
    from umbilical.verify import Verification
    from umbilical.verify.cases import Check, Result

HEAD = ("quantity", "ours", "reference", "error", "tolerance", "why this tolerance", "verdict")


def _conclusion(found: Verification) -> Conclusion:
    """Whether every check holds; without a check there is nothing to say."""
    if not any(result.checks for result in found.results):
        return Conclusion("UNRESOLVED", f"UNRESOLVED, nothing was checked: {found.headline}")
    return Conclusion("HOLDS" if found.holds else "DOES_NOT_HOLD", found.headline)


def _text(found: Verification) -> str:
    """The table, family by family, a case in a line of its own and its checks below."""
    parts = []
    for family, results in found.families.items():
        lines = [family]
        for result in results:
            lines.append(f"  {result.case.name}: {result.case.reference} ({result.case.source})")
            lines += [f"    skipped: {result.skipped}"] if result.skipped else []
            lines.append(text_table([_line(check) for check in result.checks], right=(2, 3, 4, 5)))
        parts.append("\n".join(filter(None, lines)))
    return "\n" + "\n\n".join([*parts, found.headline])


def _line(check: Check) -> tuple[str, ...]:
    ours, expected, error, tolerance = shown_numbers(check)
    return check.verdict, check.quantity, ours, expected, f"error {error}", f"<= {tolerance}", check.why


def _document(found: Verification) -> dict[str, Any]:
    """A verification as ``--json`` prints it."""
    rows = [
        {"family": family} | row
        for family, results in found.families.items()
        for result in results
        for row in _rows(result)
    ]
    return {"holds": found.holds, "headline": found.headline, "checks": rows}


def _rows(result: Result) -> list[dict[str, Any]]:
    """A row for each check, or one that says why there is none."""
    common = {"case": result.case.name, "reference": result.case.reference, "source": result.case.source}
    if result.skipped:
        return [common | {"verdict": f"skipped: {result.skipped}"}]
    return [common | _row(check) for check in result.checks]


def _row(check: Check) -> dict[str, Any]:
    numbers = {name: getattr(check, name) for name in ("quantity", "ours", "expected", "error", "tolerance", "why")}
    curve = {"sizes": list(check.curve.sizes), "errors": list(check.curve.errors)} if check.curve else {}
    return numbers | {"verdict": check.verdict} | curve


def data(found: Verification) -> str:
    """JSON text; what is not finite becomes null."""
    return json.dumps(finite_only(_document(found)), indent=2, allow_nan=False) + "\n"


def markdown_page(found: Verification, picture: str) -> str:
    """A page of its own: every table and the picture."""
    tables = (part for family, results in found.families.items() for part in _family(family, results))
    parts = ["# Verification", f"{found.headline}.", *tables, f"![errors over grids]({picture})"]
    return "\n\n".join(parts) + "\n"


def _family(family: str, results: tuple[Result, ...]) -> Iterator[str]:
    yield f"### {family}"
    for result in results:
        case = result.case
        yield f"**{case.name}**, against {case.reference}. Source: {case.source}."
        cells = ((c.quantity, *shown_numbers(c), c.why, c.verdict.replace("FAILS", "**FAILS**")) for c in result.checks)
        yield f"Skipped: {result.skipped}." if result.skipped else markdown([HEAD, *cells])


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
