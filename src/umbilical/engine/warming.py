"""Compile every kernel ahead of the first run."""

from __future__ import annotations

from umbilical.control.contract import Command
from umbilical.engine.episode import Episode
from umbilical.engine.linear import linearise_plant
from umbilical.engine.simulate import simulate
from umbilical.library import load

PARTS = ("the built-in controller", "the same in water", "controllers in Python", "linearised models")


def warm_up(part: str) -> None:
    """Compile the kernels of one of :data:`PARTS`, or load them from disk if they are there.

    >>> warm_up("the built-in controller")
    """
    scenario = load("paper", {"duration": 0.1})
    match PARTS.index(part):
        case 0:
            simulate(scenario)
        case 1:
            simulate(load("work-class-1000m-current", {"duration": 0.1}))
        case 2:
            episode = Episode(scenario, 0.05)
            episode.step(Command(thrust=0.0))
        case _:
            linearise_plant(scenario)
