"""Checks and cases: what holds, what fails, what is skipped, and how it is shown."""

from __future__ import annotations

import json
from collections.abc import Iterator

import numpy as np
import pytest

from umbilical.analysis.convergence import Curve
from umbilical.errors import ScenarioError
from umbilical.faces.verification import data, markdown_page, one_digit
from umbilical.verify.cases import (
    UNFINISHED,
    Case,
    CaseError,
    Check,
    Result,
    close,
    order_reached,
    same_history,
    small,
    worst_ratio,
)
from umbilical.verify.verification import Verification

NAN = float("nan")


def test_an_error_within_the_tolerance_holds_and_nan_never_does() -> None:
    assert close("q", 1.001, 1.0, 2e-3, "").holds
    assert not close("q", 1.003, 1.0, 2e-3, "").holds
    assert not close("q", NAN, 1.0, 1e9, "").holds
    assert not same_history("q", [0.0, NAN], [1.0, 1.0], 1e9, "").holds
    assert small("q", -1e-3, 1e-3, "").holds


def test_of_several_numbers_the_worst_is_shown() -> None:
    check = close("q", [1.0, 2.2, 3.0], [1.0, 2.0, 3.1], 0.2, "")
    assert (check.ours, check.expected, check.error) == (2.2, 2.0, pytest.approx(0.1))
    field = same_history("q", [[0.0, 1.0], [5.5, 2.0]], [[0.0, 1.0], [5.0, 10.0]], 0.2, "")
    assert (field.ours, field.expected, field.error) == (2.0, 10.0, 0.8)
    pole = close("s", np.array([1.0 + 2.0j]), np.array([1.0 + 3.0j]), 1.0, "")
    assert (pole.ours, pole.expected) == (2.0, 3.0)


def test_an_order_is_missed_from_below_only() -> None:
    def curve(order: float) -> Curve:
        return Curve("e", "h, m", (2.0, 1.0), (2.0**order, 1.0), 4.0)

    assert [order_reached(curve(order), "").holds for order in (3.8, 3.95, 4.0, 6.0)] == [False, True, True, True]


def test_the_worst_ratio_of_nan_is_infinite() -> None:
    assert worst_ratio([close("q", 1.01, 1.0, 1e-3, "")]) == pytest.approx(10.0)
    assert worst_ratio([close("q", NAN, 1.0, 1e-3, "")]) == np.inf


def test_where_nothing_is_tolerated_only_an_error_counts() -> None:
    assert worst_ratio([small("q", 0.0, 0.0, "")]) == 0.0
    assert worst_ratio([small("q", 1e-300, 0.0, "")]) == np.inf


def test_histories_that_agree_to_the_last_bit_are_shown_at_their_peak() -> None:
    assert same_history("q", [0.0, -2.0, 1.0], [0.0, -2.0, 1.0], 0.0, "").expected == -2.0


def _raising(error: Exception) -> Case:
    def find() -> Iterator[Check]:
        yield close("before it", 1.0, 1.0, 1.0, "")
        raise error

    return Case("case", "reference", "source", find)


@pytest.mark.parametrize("error", [CaseError("DIVERGED"), ScenarioError([]), ZeroDivisionError("DIVERGED")])
def test_a_case_that_cannot_be_carried_through_fails(error: Exception) -> None:
    result = _raising(error).judge()
    assert not result.holds
    before, last = result.checks
    assert before.holds, "what was found before it is kept"
    assert last.quantity == UNFINISHED
    assert "could not be carried through" in last.why


def _verification(*checks: Check, skipped: str = "") -> Verification:
    case = Case("a case", "a|b", "a source", lambda: checks)
    return Verification({"Family": (Result(case, checks, skipped),)})


def test_the_page_shows_what_fails_and_what_was_skipped() -> None:
    failing = markdown_page(_verification(small("speed, m/s", 0.25, 0.1, "because")), "plot.svg")
    assert "1 check in 1 case: 0 hold, 1 FAIL" in failing
    assert "| speed, m/s | 0.25 | 0 | 2e-01 | 0.1 | because | **FAILS** |" in failing
    assert "Skipped: needs x" in markdown_page(_verification(skipped="needs x"), "plot.svg")
    assert "![errors over grids](plot.svg)" in failing


def test_data_is_json_without_nan() -> None:
    rows = json.loads(data(_verification(small("q", NAN, 0.1, ""))))["checks"]
    assert rows[0]["ours"] is None
    assert rows[0]["verdict"] == "FAILS"


def test_curves_carry_the_name_of_their_case() -> None:
    curve = Curve("y", "h, m", (2.0, 1.0), (4.0, 1.0), 2.0)
    assert _verification(order_reached(curve, "")).curves[0].name == "a case: y"


def test_errors_are_rounded_to_one_digit() -> None:
    assert [one_digit(e) for e in (1.94e-7, 3e-14, 0.0, -0.2, NAN)] == ["2e-07", "round-off", "none", "none", "nan"]
