"""The fixed-length cable under a moving vessel, ours and MoorDyn's, against the exact sum of modes."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.verdicts import assert_holds, each
from umbilical.verify import moordyn
from umbilical.verify.cases import Case, CaseError
from umbilical.verify.references import lumped_mass
from umbilical.verify.references.hanging_string import HangingString, carried_tip


@each(moordyn.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)


def test_the_sum_of_modes_has_converged() -> None:
    t = moordyn.sampled_instants()[::10]
    few, many = (carried_tip(moordyn.IN_AIR, lambda u: moordyn.faded_sine(u)[2], t, count) for count in (30, 60))
    assert np.abs(few - many).max() < 2e-6 * np.abs(many).max()


def test_without_moordyn_the_case_is_skipped_and_not_passed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("umbilical.verify.cases.find_spec", lambda name: None)
    result = next(case for case in moordyn.CASES if case.needs).judge()
    assert (result.checks, result.skipped) == ((), "needs moordyn")


def test_a_moordyn_that_fails_is_a_case_that_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lumped_mass, "_SCRIPT", "raise SystemExit('out of order')")
    with pytest.raises(CaseError, match="out of order"):
        lumped_mass.tip(HangingString(), 20, np.zeros(2), np.zeros(2))
