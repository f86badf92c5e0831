"""The top end of the cable: what winch and vessel do there at an instant. Everyone who samples either asks here.

Today both are *prescribed*: functions of time alone, which the scenario gives. A winch that is driven would fill the
same records from its own state. The vessel does not heave yet; its heave would enter :class:`Top`, and with it the
tension everywhere, for net gravity and its relative jerk are made here.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from umbilical.plant import signals, winch
from umbilical.plant.signals import Array, Side
from umbilical.relations import tension
from umbilical.scenario.environment import Environment
from umbilical.scenario.winch import Winch


class Top(winch.WinchMotion):
    """How cable leaves the sheave: the winch's motion, and what follows from it for the tension."""

    __slots__ = ()

    def net_gravity(self, gravity: float) -> Array:
        """g less the acceleration at which the cable sinks, m/s2."""
        return tension.net_gravity(gravity, self.acceleration)

    def relative_jerk(self, gravity: float) -> Array:
        """Rate of that acceleration over net gravity, 1/s."""
        return tension.relative_jerk(self.jerk, self.net_gravity(gravity))


def top_at(law: Winch, t: ArrayLike, side: Side = "right") -> Top:
    """The top end at instants, s, of any shape; ``side`` is the limit to take exactly at a jump.

    >>> from umbilical.scenario.winch import ConstantSpeed
    >>> top = top_at(ConstantSpeed(law="speed", start_length=450.0, speed=-2.0), [0.0, 10.0])
    >>> top.length.tolist(), top.net_gravity(10.0).tolist()
    ([450.0, 430.0], [10.0, 10.0])
    """
    return Top(*winch.evaluate(law, t, side))


def top_on_both_sides(law: Winch, t: Array) -> Top:
    """All limits from the left, then all from the right, shape (2 n,) for n instants."""
    sides = top_at(law, t, "left"), top_at(law, t, "right")
    return Top(*(np.concatenate(pair) for pair in zip(*sides, strict=True)))


def top_within(law: Winch, t: Array) -> Top:
    """Rows of instants between jumps, shape (rows, n): limits at both ends of a row are those from inside it."""
    last = np.arange(t.shape[1]) == t.shape[1] - 1
    pairs = zip(top_at(law, t, "right"), top_at(law, t, "left"), strict=True)
    return Top(*(np.where(last, left, right) for right, left in pairs))


def vessel_at(environment: Environment, t: ArrayLike, side: Side = "right") -> Any:
    """e and e' of the vessel, m and m/s, each of the shape of the instants."""
    return signals.vessel(environment, t, side)
