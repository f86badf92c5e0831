"""Runs that are taken in turns sample what acts from outside once, and give what each gives alone."""

from __future__ import annotations

import pytest

from umbilical.engine.simulate import Common, in_turns, measure, measuring
from umbilical.errors import ScenarioError
from umbilical.library import load

SHORT = {"duration": 6.0, "grid.elements": 8}  # more than one stretch


def test_runs_in_turns_share_the_outside_world() -> None:
    """PD and the paper's law in one sea, a third run in another, a fourth with shorter periods and the first's sea."""
    scenarios = [
        load("paper", SHORT),
        load("paper-pd", SHORT),
        load("paper", SHORT | {"environment.payload_force.1.value": 50.0}),
        load("paper", SHORT | {"control.period": 0.0005}),
    ]
    common = Common()
    together = in_turns([measuring(scenario, common=common) for scenario in scenarios])
    assert together == [measure(scenario) for scenario in scenarios]
    assert len(common.samplers) == 2


def test_a_run_in_turns_is_checked_where_it_differs() -> None:
    """After a sound scenario the bad section of another is found, alone and beside what stayed the same."""
    sound, common = load("paper", SHORT), Common()
    bad = sound.replace({"control.slope_observer.time_constant": 1e-4}), sound.replace({"payload.mass": 1e-3})
    for scenario in bad:
        with pytest.raises(ScenarioError) as alone:
            measure(scenario)
        with pytest.raises(ScenarioError) as beside:
            in_turns([measuring(sound, common=common), measuring(scenario, common=common)])
        assert beside.value.problems == alone.value.problems
