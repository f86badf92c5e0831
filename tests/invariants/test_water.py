"""The string in water: what two runs must share, and closed forms without waves."""

from __future__ import annotations

from tests.support.verdicts import assert_holds, each
from umbilical.verify import manufactured, water, water_pairs
from umbilical.verify.cases import Case


@each((*manufactured.AT_SEA_CASES, *water.CASES, *water_pairs.CASES, *water.SHAKEN))
def test_case(case: Case) -> None:
    assert_holds(case)
