"""Write docs/validation.md and docs/convergence.svg: `.venv/bin/python tools/make_validation.py`, some minutes.

It runs the whole of `umbilical verify`. The page shows of each case the check that comes nearest to its tolerance.
Its numbers are not compared with anything afterwards, for the last digits differ between machines; that its cases are
those of the command, each with as many checks, and that all hold is (tests/contract/test_validation.py, and the test of
every case).
"""

from __future__ import annotations

import sys
from pathlib import Path

from umbilical.cli.progress import bar
from umbilical.faces.verification import shown_numbers
from umbilical.plots import plot_convergence, save_figure
from umbilical.tables import markdown
from umbilical.verify import Verification, verify_all, water
from umbilical.verify.cases import Check, Result, worst_ratio

DOCS = Path(__file__).resolve().parents[1] / "docs"
TEXT = Path(__file__).with_suffix(".md")
PICTURE = "convergence.svg"
HEAD = ("case", "checks", "against", "nearest to its tolerance", "ours", "reference", "error", "allowed, and why")


def text(found: Verification) -> str:
    """The page: what stands in make_validation.md, with headline and tables in their places."""
    note = "<!-- Written by tools/make_validation.py; edit its text in tools/make_validation.md. -->"
    body = TEXT.read_text(encoding="utf-8").replace("{headline}", found.headline).replace("{picture}", PICTURE)
    body = body.replace("{drag}", water.answers_table())
    body = body.replace("{beside}", beside(found))
    title, _, rest = body.replace("{tables}", tables(found)).partition("\n")
    return f"{title}\n\n{note}\n{rest}"


def tables(found: Verification) -> str:
    """One table for each family."""
    parts = []
    for family, results in found.families.items():
        parts.append(f"### {family}\n\n" + markdown([HEAD, *map(row, results)]))
    return "\n\n".join(parts)


def beside(found: Verification) -> str:
    """All numbers of the presets of the string on the rope."""
    cases = [result for result in found.families["Rope"] if result.case.name.startswith("rope beside")]
    pairs = [pair for result in cases for pair in zip(result.checks[::2], result.checks[1::2], strict=True)]
    rows = [(tip.quantity.partition(",")[0], f"{tip.error:.1e}", f"{middle.error:.1e}") for tip, middle in pairs]
    return markdown([("preset", "tip", "midpoint"), *rows])


def row(result: Result) -> tuple[str, ...]:
    """A case, by the check that comes nearest to its tolerance."""
    against = f"`{result.case.reference}`, {result.case.source}"
    if result.skipped:
        return result.case.name, "0", against, f"**skipped**: {result.skipped}", "", "", "", ""
    check = max(result.checks, key=nearness)
    verdict = "" if result.holds else " **FAILS**"
    ours, expected, error, tolerance = shown_numbers(check)
    name, count = result.case.name, str(len(result.checks))
    return name, count, against, check.quantity, ours, expected, error + verdict, f"{tolerance}: {check.why}"


def nearness(check: Check) -> float:
    """Error over tolerance."""
    return worst_ratio([check])


def main() -> int:
    """Verify, write both files, and say what fails."""
    with bar("verifying") as advance:
        found = verify_all(progress=advance)
    (DOCS / "validation.md").write_text(text(found), encoding="utf-8")
    save_figure(plot_convergence(found.curves), DOCS / PICTURE, force=True)
    print(found.headline)
    return 0 if found.holds else 1


if __name__ == "__main__":
    sys.exit(main())
