"""What round-off does to instants changes nothing; what differs looks different."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from umbilical.relations.instants import apart, count_up, is_multiple, reaches, slack

COUNTS = st.integers(1, 10**6)
STEPS = st.floats(1e-6, 10.0)


@given(COUNTS, STEPS)
def test_sums_of_a_step_are_multiples_of_it(count: int, step: float) -> None:
    total = count * step
    for value in (total, np.nextafter(total, 0.0), np.nextafter(total, np.inf)):
        assert is_multiple(value, step)
        assert count_up(value, step) == count
        assert reaches(value, total, total)


@given(COUNTS, STEPS, st.floats(0.002, 0.998))
def test_what_lies_between_two_multiples_is_none(count: int, step: float, part: float) -> None:
    value = (count + part) * step
    assert not is_multiple(value, step)
    assert count_up(value, step) == count + 1


def test_nothing_is_no_multiple_and_no_reach() -> None:
    assert not is_multiple(1e-12, 0.1)
    assert not reaches(19.9999, 20.0, 20.0)
    assert slack(0.0) == slack(1.0) < slack(1e3)


@given(st.floats(-1e12, 1e12), st.floats(-1e12, 1e12))
def test_numbers_that_differ_look_different(a: float, b: float) -> None:
    first, second = apart(a, b)
    assert (first == second) == (a == b)


@pytest.mark.parametrize(("numbers", "texts"), [((20.0, 0.25), ("20", "0.25")), ((1.7e9, 1.7e9 + 60), None)])
def test_six_digits_where_they_suffice(numbers: tuple[float, float], texts: tuple[str, str] | None) -> None:
    assert apart(*numbers) == (texts or ("1.7e+09", "1.7000001e+09"))
