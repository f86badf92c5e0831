"""docs/validation.md shows every case of the verification, and all of them hold."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from umbilical.verify import FAMILIES, verify_all

PAGE = (Path(__file__).parents[2] / "docs" / "validation.md").read_text(encoding="utf-8")


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


@pytest.mark.slow
def test_the_headline_is_of_today() -> None:
    """If this fails: .venv/bin/python tools/make_validation.py"""
    assert f"**{verify_all().headline}**" in PAGE


def test_all_of_them_hold() -> None:
    assert "FAILS" not in PAGE
    assert "skipped" not in PAGE


def test_names_of_cases_are_unique() -> None:
    names = [case.name for cases in FAMILIES.values() for case in cases]
    assert len(set(names)) == len(names)
