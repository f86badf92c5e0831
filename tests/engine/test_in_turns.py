"""Runs that are taken in turns sample what acts from outside once, and give what each gives alone."""

from __future__ import annotations

from typing import Any

from umbilical.engine.simulate import in_turns, measure, measuring
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
    samplers: list[Any] = []
    together = in_turns([measuring(scenario, samplers=samplers) for scenario in scenarios])
    assert together == [measure(scenario) for scenario in scenarios]
    assert len(samplers) == 2
