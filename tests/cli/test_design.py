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


@pytest.mark.parametrize(("met", "code", "words"), [(True, 0, "limits are kept"), (False, 7, "NOT everything is kept")])
def test_one_verdict_decides_first_line_and_exit_code(met: bool, code: int, words: str) -> None:
    from types import SimpleNamespace
    from typing import Any

    from umbilical.faces.design import FACE

    scenario = SimpleNamespace(name="mine")
    found: Any = SimpleNamespace(met=met, objective="both", after=SimpleNamespace(scenario=scenario))
    assert (FACE.conclusion(found).exit_code, words in FACE.conclusion(found).headline) == (code, True)


def test_a_limit_has_one_of_four_names(umbilical) -> None:
    done = umbilical("design", "ringdown", "--limits", "noise=3,loudness=3")
    assert done.code == 2
    assert "loudness=3" in done.err
