"""Cases of the verification as tests: one test for each, all misses at once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import pytest

from umbilical.verify.cases import Case


def each(cases: Iterable[Case], marks: Mapping[str, Any] | None = None) -> Any:
    """One test for each case; those that ``--quick`` leaves out are slow. ``marks`` are more of them, by name."""
    found = []
    for case in cases:
        own = [] if case.quick else [pytest.mark.slow]
        own += [marks[case.name]] if marks and case.name in marks else []
        found.append(pytest.param(case, id=case.name, marks=own))
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
