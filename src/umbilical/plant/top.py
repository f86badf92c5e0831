"""The top end of the cable: what winch and vessel do there at an instant. Everyone who samples either asks here.

Today both are *prescribed*: functions of time alone, which the scenario gives. A winch that is driven would fill the
same records from its own state. Heave of the sheave enters :class:`Top`, and with it the tension everywhere: net
gravity and its relative jerk are made here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from umbilical.plant import seaway, signals, winch
from umbilical.plant.signals import Array, Side
from umbilical.relations import tension
from umbilical.scenario.environment import Environment
from umbilical.scenario.winch import Winch

if TYPE_CHECKING:
    from umbilical.plant.stretching import Stretching


class Top(NamedTuple):
    """How cable leaves the sheave, each an array of the shape of the instants.

    Attributes:
        length: cable paid out l, m.
        speed, acceleration, jerk: of the winch, positive paying out: v, m/s, a, m/s2, and a', m/s3.
        heave: of the sheave, m, up.
        sink_speed, sink_acceleration, sink_jerk: of the cable through the water: those of the winch less the heave's.
        elastic_tension, elastic_gradient: what stretch adds to the tension at the ROV, N, and per metre, N/m.
        elastic_tension_rate, elastic_gradient_rate: their rates.
    """

    length: Array
    speed: Array
    acceleration: Array
    jerk: Array
    heave: Array
    sink_speed: Array
    sink_acceleration: Array
    sink_jerk: Array
    elastic_tension: Array
    elastic_gradient: Array
    elastic_tension_rate: Array
    elastic_gradient_rate: Array

    def net_gravity(self, gravity: float) -> Array:
        """g less the acceleration at which the cable sinks, m/s2."""
        return tension.net_gravity(gravity, self.sink_acceleration)

    def relative_jerk(self, gravity: float) -> Array:
        """Rate of that acceleration over net gravity, 1/s."""
        return tension.relative_jerk(self.sink_jerk, self.net_gravity(gravity))


def top_at(
    law: Winch,
    t: ArrayLike,
    side: Side = "right",
    environment: Environment | None = None,
    stretching: Stretching | None = None,
) -> Top:
    """The top end at instants, s, of any shape; ``side`` is the limit to take exactly at a jump.

    Without an ``environment`` the sheave does not heave: ask so for the winch's motion alone. ``stretching`` is what
    heave makes of a cable that stretches.

    >>> from umbilical.scenario.winch import ConstantSpeed
    >>> top = top_at(ConstantSpeed(law="speed", start_length=450.0, speed=-2.0), [0.0, 10.0])
    >>> top.length.tolist(), top.net_gravity(10.0).tolist()
    ([450.0, 430.0], [10.0, 10.0])
    """
    motion = winch.evaluate(law, t, side)
    if environment is None or not seaway.heaving(environment):
        none = np.zeros_like(motion.length)
        return Top(*motion, none, motion.speed, motion.acceleration, motion.jerk, none, none, none, none)
    heave = signals.heave(environment, t, side)
    speed = np.array(motion[1:])
    sinks = speed - np.array(heave[1:])
    elastic = stretching.at(np.asarray(t), speed[:2], sinks[:2], side) if stretching else np.zeros((4, *np.shape(t)))
    return Top(*motion, heave[0], *sinks, *elastic)


def top_on_both_sides(
    law: Winch, t: Array, environment: Environment | None = None, stretching: Stretching | None = None
) -> Top:
    """All limits from the left, then all from the right, shape (2 n,) for n instants."""
    sides = (top_at(law, t, side, environment, stretching) for side in ("left", "right"))
    return Top._make(np.concatenate(pair) for pair in zip(*sides, strict=True))


def top_within(law: Winch, t: Array) -> Top:
    """Rows of instants between jumps, shape (rows, n): limits at both ends of a row are those from inside it."""
    last = np.arange(t.shape[1]) == t.shape[1] - 1
    pairs = zip(top_at(law, t, "right"), top_at(law, t, "left"), strict=True)
    return Top._make(np.where(last, left, right) for right, left in pairs)


def vessel_at(environment: Environment, t: ArrayLike, side: Side = "right") -> Any:
    """e and e' of the vessel, m and m/s, each of the shape of the instants."""
    return signals.vessel(environment, t, side)
