"""``umbilical design``: what is refused before the search."""

from __future__ import annotations

import pytest


@pytest.mark.parametrize("words", ["0", "-0.001", "fast", "0.001,", "inf"])
def test_periods_are_times(umbilical, words: str) -> None:
    done = umbilical("design", "ringdown", f"--periods={words}")
    assert done.code == 2
    assert "periods" in done.err


def test_a_period_that_does_not_fit_is_refused_with_everything_that_does_not(umbilical) -> None:
    done = umbilical("design", "ringdown", "--periods=0.05")
    assert done.code == 2
    assert "control.motor_loop.speed_gain" in done.err
    assert "control.motor_loop.observer_gain" in done.err
