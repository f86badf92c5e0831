"""The control laws at random states, and observers and the adaptive law in their discrete forms, against the paper's
equations written a second time and exact responses."""

from __future__ import annotations

import pytest

from tests.support.verdicts import assert_holds, each
from umbilical.verify import control
from umbilical.verify.cases import Case


@pytest.mark.nojit
@each(case for case in control.CASES if "observer" in case.name)
def test_case(case: Case) -> None:
    assert_holds(case)


@each(case for case in control.CASES if "law" in case.name)
def test_law(case: Case) -> None:
    assert_holds(case)
