"""When things happen: control instants, plant steps between them, and the published jumps steps must end on."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from umbilical.plant.exogenous import Steps
from umbilical.relations.instants import count_up, nearest_count

SNAP = 1e-9
"""A jump this close to a step's end, as a share of the step, is taken to be at it."""
SHARED = 20000
"""Steps of the longest stretch worth keeping for the next run: a few megabytes."""


STEPS_AT_ONCE = 5000
"""Plant steps between two looks at the outside world, at progress and at Ctrl-C: so many that what was sampled
fits into a processor's cache, and the looks cost nothing. No result depends on it."""


class Stretch(NamedTuple):
    """Some control periods of a run: their plant steps, and the first step of each period (one more at the end)."""

    steps: Steps
    first: np.ndarray


class Clock(NamedTuple):
    """Timing of a run: ``periods`` control periods of ``period`` s, ``substeps`` plant steps in each."""

    period: float
    periods: int
    substeps: int
    jumps: np.ndarray


def make_clock(duration: float, period: float, largest_step: float, jumps: tuple[float, ...]) -> Clock:
    """Clock of a run whose duration is a whole number of periods.

    >>> make_clock(1.0, 0.1, 0.04, ()).substeps
    3
    """
    substeps = max(1, count_up(period, largest_step))
    return Clock(period, nearest_count(duration, period), substeps, np.array(jumps))


def end_of_stretch(clock: Clock, begin: int) -> int:
    """Update before which a stretch that begins at an update ends."""
    return min(begin + max(1, STEPS_AT_ONCE // clock.substeps), clock.periods)


def stretch(clock: Clock, begin: int, end: int) -> Stretch:
    """Plant steps of the control periods ``begin`` to ``end`` (exclusive).

    Steps are counted from the start of the run, so that it does not matter where stretches are cut. Equal stretches of
    different runs are one object, by which what was sampled at them is known (:mod:`umbilical.plant.exogenous`).
    """
    step = clock.period / clock.substeps
    first, last = begin * clock.substeps * step - SNAP * step, end * clock.substeps * step + SNAP * step
    inside = clock.jumps[(clock.jumps >= first) & (clock.jumps <= last)]
    shared = (end - begin) * clock.substeps <= SHARED
    make = _stretch if shared else _stretch.__wrapped__
    return make(clock.period, clock.substeps, begin, end, tuple(inside.tolist()), shared)


@lru_cache(maxsize=64)
def _stretch(period: float, substeps: int, begin: int, end: int, jumps: tuple[float, ...], shared: bool) -> Stretch:
    step = period / substeps
    knots = np.arange(begin * substeps, end * substeps + 1) * step
    starts = np.arange(0, knots.size, substeps)
    inside = np.array(jumps, dtype=float)
    nearest = np.rint(inside / step).astype(np.int64) - begin * substeps
    on_knot = np.abs(knots[np.clip(nearest, 0, knots.size - 1)] - inside) <= SNAP * step
    # The knot takes the jump's own number: which side of it a step is on must not hang on round-off.
    knots[nearest[on_knot]] = inside[on_knot]
    between = inside[~on_knot]
    places = np.searchsorted(knots, between)
    first = starts + np.searchsorted(between, knots[starts])
    knots = np.insert(knots, places, between)
    return Stretch(Steps(knots[:-1], knots[1:], inside, shared), first.astype(np.int64))
