"""The moving cable of a scenario, sampled over its whole run: what its checks look at."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from umbilical.plant import winch as laws
from umbilical.plant.checks import seas
from umbilical.plant.checks.timeline import refuses, signals_of_the_environment, tables_of_the_winch
from umbilical.plant.seaway import heaving
from umbilical.plant.stretching import Stretching, stretching
from umbilical.plant.top import Top, top_on_both_sides
from umbilical.relations.tension import (
    Hanging,
    across,
    axial_drag_of,
    hanging_of,
    largest_tension,
    sinking,
    smallest_tension,
    stretched,
)
from umbilical.relations.water import in_water
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.signals import Bell, Pulse, Sine, Step, Waves
from umbilical.scenario.winch import Cosine, Winch

SHORTEST, LONGEST = 1.0, 2e4
"""Lengths, m, between which a cable is a cable."""
_EVEN_SAMPLES, _SAMPLES_PER_PIECE, _SAMPLES_PER_TURN, _MOST_SAMPLES = 4001, 17, 64, 400_001


class MovingCable(NamedTuple):
    """Sections that say how a cable hangs and moves; a check that reads all of them has a parameter ``moving``."""

    winch: Winch
    environment: Environment
    duration: float
    cable: Cable
    payload: Payload

    @classmethod
    def of(cls, scenario: Scenario) -> MovingCable:
        """The sections of a scenario."""
        return cls(*(getattr(scenario, name) for name in cls._fields))

    def sampled(self) -> tuple[np.ndarray, Top] | None:
        """As :func:`sampled_top`."""
        return sampled_top(*self)

    def sunk(self, motion: Top) -> Hanging:
        """What hangs on the cable at each instant while it sinks as the top end says."""
        sections = self.cable, self.payload, self.environment
        carried = sinking(hanging_of(*sections), axial_drag_of(*sections), motion.sink_speed)
        return stretched(carried, motion.elastic_tension, motion.elastic_gradient)

    def tension_range(self, motion: Top) -> tuple[np.ndarray, np.ndarray]:
        """Smallest and largest tension along the cable at each instant, N."""
        state = motion.length, motion.net_gravity(self.environment.gravity), self.sunk(motion)
        return smallest_tension(*state), largest_tension(*state)


def sampled_winch(winch: Winch, duration: float) -> tuple[np.ndarray, Top] | None:
    """Instants, s, and motion at them, dense and on both sides of every jump; None if the law is no function yet.

    The winch alone: whoever asks for the tension asks :func:`sampled_top`.
    """
    return _sampled_top(_hashed(winch), None, duration)


def sampled_top(
    winch: Winch, environment: Environment, duration: float, cable: Cable | None = None, payload: Payload | None = None
) -> tuple[np.ndarray, Top] | None:
    """The same with the heave of the sheave; None also where that is no smooth function yet.

    With ``cable`` and ``payload`` also with what the cable's stretch makes of the tension.
    """
    if not seas.sound(environment):
        return None
    if not heaving(environment):
        return _sampled_top(_hashed(winch), None, duration)
    if not sampled_winch(winch, duration):
        return None
    rough = any(isinstance(term, Step | Pulse | Bell) for term in heaving(environment))
    if rough or refuses(signals_of_the_environment(environment, duration)):
        return None
    elastic = stretching(winch, environment, cable, payload, duration) if cable and payload else None
    return _sampled_top(_hashed(winch), _hashed(environment), duration, elastic)


def _hashed(record: Any) -> Any:
    """Frozen records have a hash, which type checkers cannot see."""
    return record


@lru_cache(maxsize=16)
def _sampled_top(
    winch: Winch, environment: Environment | None, duration: float, elastic: Stretching | None = None
) -> tuple[np.ndarray, Top] | None:
    if refuses(tables_of_the_winch(winch, duration)):
        return None
    marks = [0.0, duration, *laws.jumps(winch)]
    if isinstance(winch, Cosine):
        marks += list(np.arange(5) * np.pi / (2.0 * winch.frequency))  # all its extremes, however fast it is
    pieces = np.unique(np.clip(marks, 0.0, duration))
    within = np.linspace(pieces[:-1], pieces[1:], _SAMPLES_PER_PIECE).ravel()
    t = np.unique(np.concatenate([np.linspace(0.0, duration, _samples(environment, duration)), within]))
    return np.tile(t, 2), top_on_both_sides(winch, t, environment, elastic)


def _samples(environment: Environment | None, duration: float) -> int:
    """Even samples of a run: enough for each turn of the heave."""
    terms = heaving(environment) if environment else ()
    regular = [max(term.frequencies) for term in terms if isinstance(term, Waves)]
    fastest = max([term.frequency for term in terms if isinstance(term, Sine)] + regular, default=0.0)
    turns = fastest * duration / (2.0 * np.pi)
    return int(max(_EVEN_SAMPLES, min(_SAMPLES_PER_TURN * turns, _MOST_SAMPLES)))


class CableWaves(NamedTuple):
    """Waves at each instant: slowest and fastest speed on the cable, and of what carries them at body and vessel."""

    slowest: np.ndarray
    fastest: np.ndarray
    at_payload: np.ndarray
    at_vessel: np.ndarray


def wave_terms(moving: MovingCable, motion: Top) -> CableWaves:
    """``sqrt(Tt/M)`` and the two ends of the transport tau = vb - v sigma, m/s, by the motion of the top end."""
    added, density = in_water(moving.cable, moving.payload, moving.environment).added, moving.cable.line_density
    inertia = density + added
    net, hung = motion.net_gravity(moving.environment.gravity), moving.sunk(motion)
    pulls = across(hung, density * added / inertia, motion.sink_speed)
    length, slip = possible(motion.length), added * motion.sink_speed / inertia
    slowest, fastest = smallest_tension(length, net, pulls), largest_tension(length, net, pulls)
    lowest, highest = (np.sqrt(np.maximum(pull, 0.0) / inertia) for pull in (slowest, fastest))
    return CableWaves(lowest, highest, -slip, motion.speed - slip)


def possible(length: np.ndarray) -> np.ndarray:
    """Lengths within their own bounds: one beyond them has its own problem."""
    return np.clip(length, SHORTEST, LONGEST)
