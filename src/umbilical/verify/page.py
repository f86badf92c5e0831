"""What a verification found, as a page for people and as data."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence
from typing import Any

from umbilical.verify.cases import Check, Result
from umbilical.verify.summary import document
from umbilical.verify.verification import Verification

HEAD = ("quantity", "ours", "reference", "error", "tolerance", "why this tolerance", "verdict")


def page(found: Verification, picture: str) -> str:
    """A page of its own: every table and the picture."""
    return (
        "\n\n".join(["# Verification", f"{found.headline}.", tables(found), f"![errors over grids]({picture})"]) + "\n"
    )


def tables(found: Verification) -> str:
    """Every check, by family and case."""
    return "\n\n".join(part for family, results in found.families.items() for part in _family(family, results))


def data(found: Verification) -> str:
    """JSON text; what is not finite becomes null."""
    return json.dumps(_finite(document(found)), indent=2, allow_nan=False) + "\n"


def _family(family: str, results: Sequence[Result]) -> Iterable[str]:
    yield f"### {family}"
    for result in results:
        case = result.case
        yield f"**{case.name}**, against {case.reference}. Source: {case.source}."
        yield f"Skipped: {result.skipped}." if result.skipped else _table(result.checks)


def _table(checks: Sequence[Check]) -> str:
    rows = [HEAD, ("---",) * len(HEAD), *map(_row, checks)]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows)


def _row(check: Check) -> tuple[str, ...]:
    return (check.quantity, *numbers(check), check.why, "holds" if check.holds else "**FAILS**")


def numbers(check: Check) -> tuple[str, str, str, str]:
    """Ours, the reference, error and tolerance as they are printed everywhere.

    Errors with one digit: more would change from machine to machine.
    """
    return f"{check.ours:.7g}", f"{check.expected:.7g}", rounded(check.error), f"{check.tolerance:.2g}"


def rounded(error: float) -> str:
    """An error as it is printed: below 1e-12 it is round-off, below 0 more than was asked for."""
    if error <= 0.0:
        return "none"
    return "round-off" if error < 1e-12 else f"{error:.0e}"


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
