"""Observers and the adaptive law in their discrete forms, against exact responses of their equations."""

from __future__ import annotations

import pytest

from tests.support.verdicts import assert_holds, each
from umbilical.verify import adaptation, observers
from umbilical.verify.cases import Case


@pytest.mark.nojit
@each(observers.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)


@each(adaptation.CASES)
def test_adaptive_law(case: Case) -> None:
    assert_holds(case)
