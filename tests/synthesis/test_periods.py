"""A design may choose the control period: what fits is searched at each, and what does not is refused at once."""

from __future__ import annotations

import pytest

import umbilical
from umbilical.errors import ScenarioError
from umbilical.synthesis.design import design
from umbilical.synthesis.iterate import design_within
from umbilical.synthesis.periods import pace, paced
from umbilical.synthesis.score import Demands
from umbilical.synthesis.search import DesignTask

RINGDOWN = umbilical.load("ringdown")
BASE = DesignTask(RINGDOWN, (), "ringdown", Demands(), 400.0, 50.0, present=RINGDOWN)
WAVE_SPEED = 50.0


def test_an_outer_period_stays_the_same_number_of_periods() -> None:
    two = RINGDOWN.replace({"control.outer_period": 2e-3})
    assert pace(two, 5e-4) == {"control.period": 5e-4, "control.outer_period": 1e-3}
    assert pace(RINGDOWN, 5e-4) == {"control.period": 5e-4}


def test_gains_that_are_kept_must_fit_and_those_that_are_chosen_need_room() -> None:
    with pytest.raises(ScenarioError) as kept:
        paced(BASE, pace(RINGDOWN, 0.05), WAVE_SPEED, inner=False)
    assert "control.motor_loop.speed_gain" in {problem.key for problem in kept.value.problems}
    with pytest.raises(ScenarioError) as cramped:
        paced(BASE, pace(RINGDOWN, 0.05), WAVE_SPEED, inner=True)
    assert {"the lower end below the upper"} <= {problem.bound for problem in cramped.value.problems}


def test_bounds_follow_the_period() -> None:
    ends = [
        {knob.key: (knob.low, knob.high) for knob in paced(BASE, pace(RINGDOWN, p), WAVE_SPEED, inner=True).knobs}
        for p in (1e-3, 5e-4)
    ]
    key = "control.motor_loop.filter_frequency"
    assert ends[1][key][1] == pytest.approx(2.0 * ends[0][key][1])


@pytest.mark.slow
def test_the_better_of_two_periods_is_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    """By a short search, the same one for both."""
    monkeypatch.setattr("umbilical.synthesis.iterate.GENERATIONS", 2)
    monkeypatch.setattr("umbilical.synthesis.iterate.RESERVES", (1.0,))
    monkeypatch.setattr("umbilical.synthesis.search.LOCAL_STEPS", 5)
    outcomes = []

    def searched(*arguments):
        outcomes.append(design_within(*arguments))
        return outcomes[-1]

    monkeypatch.setattr("umbilical.synthesis.design.design_within", searched)
    found = design(RINGDOWN, "ringdown", periods=[1e-3, 5e-4])
    best = min(outcomes, key=lambda outcome: (not outcome.side.kept, outcome.side.score.reflection))
    assert [outcome.side.scenario.control.period for outcome in outcomes] == [1e-3, 5e-4]
    assert found.values["control.period"] == best.side.scenario.control.period
    assert found.after is best.side
    assert found.before.scenario.control.period == RINGDOWN.control.period
    assert "period = " in found.patch()
    umbilical.load("ringdown", found.values)
