"""Compile every kernel ahead of the first run."""

from __future__ import annotations

from umbilical.control.contract import Command
from umbilical.engine.episode import Episode
from umbilical.engine.linear import linearise_plant
from umbilical.engine.simulate import simulate
from umbilical.library import load


def compile_part(part: str) -> None:
    """Compile the kernels of one of :data:`PARTS`, or load them from disk if they are there.

    >>> compile_part("the built-in controller")
    """
    PARTS[part]()


def _run(preset: str) -> None:
    simulate(load(preset, {"duration": 0.1}))


def _hold(preset: str) -> None:
    Episode(load(preset, {"duration": 0.1}), 0.05).step(Command(thrust=0.0))


def _rope() -> None:
    _run("observation-300m")
    _hold("observation-300m")


PARTS = {
    "the built-in controller": lambda: _run("paper"),
    "the same in water": lambda: _run("work-class-1000m-current"),
    "controllers in Python": lambda: _hold("paper"),
    "linearised models": lambda: linearise_plant(load("paper")),
    "the rope in space": _rope,
}
"""What there is to compile, and how."""
