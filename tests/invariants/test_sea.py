"""Waves, vessels and the limits that follow from them: against references, and what two runs in waves must share."""

from __future__ import annotations

from tests.support.verdicts import assert_holds, each
from umbilical.verify import sea, water_pairs
from umbilical.verify.cases import Case


@each((*sea.CASES, *water_pairs.SEA_CASES))
def test_case(case: Case) -> None:
    assert_holds(case)
