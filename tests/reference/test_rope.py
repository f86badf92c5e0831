"""The rope against closed forms, shooting, characteristics and masses on springs."""

from __future__ import annotations

from tests.support.verdicts import assert_holds, each
from umbilical.verify import rope, rope_waves
from umbilical.verify.cases import Case


@each((*rope.CASES, *rope_waves.CASES))
def test_case(case: Case) -> None:
    assert_holds(case)
