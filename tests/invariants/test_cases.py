"""What must hold between two runs, whatever the answer is."""

from __future__ import annotations

from tests.support.verdicts import assert_holds, each
from umbilical.verify import invariance
from umbilical.verify.cases import Case


@each(invariance.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)
