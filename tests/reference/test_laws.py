"""The control laws at random states, against the paper's equations written a second time."""

from __future__ import annotations

from tests.support.verdicts import assert_holds, each
from umbilical.verify import laws
from umbilical.verify.cases import Case


@each(laws.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)
