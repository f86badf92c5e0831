"""docs/validation.md shows every case of the verification, and all of them hold."""

from __future__ import annotations

import re

from tests.support.verdicts import PAGE, checks_on_the_page
from umbilical.verify import FAMILIES


def rows(page: str) -> dict[str, list[str]]:
    """Names of the cases in each table of the page, by its heading."""
    found: dict[str, list[str]] = {}
    for part in page.split("\n### ")[1:]:
        heading, _, table = part.partition("\n")
        names = re.findall(r"^\| (.*?) \|", table, flags=re.MULTILINE)
        found[heading] = [name for name in names if name not in ("case", "---")]
    return found


def test_every_case_is_on_the_page() -> None:
    """If this fails: .venv/bin/python tools/make_validation.py"""
    assert rows(PAGE) == {family: [case.name for case in cases] for family, cases in FAMILIES.items()}


def test_the_headline_counts_what_is_in_the_tables() -> None:
    """How many checks a case has is compared by its own test."""
    counts = checks_on_the_page().values()
    assert f"**{sum(counts)} checks in {len(counts)} cases: {sum(counts)} hold**" in PAGE


def test_all_of_them_hold() -> None:
    assert "FAILS" not in PAGE
    assert "skipped" not in PAGE


def test_names_of_cases_are_unique() -> None:
    names = [case.name for cases in FAMILIES.values() for case in cases]
    assert len(set(names)) == len(names)
