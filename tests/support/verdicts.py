"""Cases of the verification as tests: one test for each, all misses at once."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

from umbilical.verify.cases import Case

PAGE = (Path(__file__).parents[2] / "docs" / "validation.md").read_text(encoding="utf-8")


def checks_on_the_page() -> dict[str, int]:
    """How many checks docs/validation.md says that each case has."""
    return {name: int(count) for name, count in re.findall(r"^\| (.*?) \| (\d+) \|", PAGE, flags=re.MULTILINE)}


def each(cases: Iterable[Case]) -> Any:
    """One test for each case; those that ``--quick`` leaves out are slow."""
    found = [pytest.param(case, id=case.name, marks=[] if case.quick else [pytest.mark.slow]) for case in cases]
    return pytest.mark.parametrize("case", found)


def assert_holds(case: Case) -> None:
    """Every check of the case, or a skip where it lacks a package."""
    result = case.judge()
    if result.skipped:
        pytest.skip(result.skipped)
    assert result.checks
    misses = [
        f"{c.quantity}: {c.ours:.10g} for {c.expected:.10g}, off {c.error:.3g} > {c.tolerance:.3g}"
        for c in result.checks
        if not c.holds
    ]
    assert not misses, "\n".join([case.name, *misses])
    assert checks_on_the_page()[case.name] == len(result.checks), "run tools/make_validation.py"
