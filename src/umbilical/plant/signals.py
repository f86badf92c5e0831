"""Values of the scenario's signals over arrays of time: loads, disturbances and the vessel's motion.

A jump is taken at its published instant; ``side`` says which limit is wanted there. Instants that differ by round-off
are the same (:mod:`umbilical.relations.instants`).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise
from math import comb
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from umbilical.plant import regular, seaway
from umbilical.relations.instants import slack
from umbilical.scenario.environment import Environment
from umbilical.scenario.signals import Bell, Constant, Pulse, Signal, Sine, Step, Table, Term, Waves

Array = NDArray[np.float64]
Side = Literal["left", "right"]
_Part = NDArray[np.floating[Any]] | float


def evaluate(signal: Signal, t: ArrayLike, side: Side = "right") -> Array:
    """Sum of the signal's terms.

    Args:
        signal: terms of a scenario's signal; none at all is zero.
        t: instants, s, any shape.
        side: the limit to take exactly at a jump.

    Returns:
        Values in the signal's own unit, shape of ``t``.

    >>> from umbilical.scenario.signals import Constant, Step
    >>> signal = (Constant(kind="constant", value=2.0), Step(kind="step", value=3.0, time=1.0))
    >>> evaluate(signal, [0.0, 1.0]).tolist(), evaluate(signal, 1.0, side="left").item()
    ([2.0, 5.0], 2.0)
    """
    return _sum(_value, signal, t, side)


def _sum(part: Callable[[Term, Array, Side], _Part], signal: Signal, t: ArrayLike, side: Side) -> Array:
    instants = np.asarray(t, dtype=np.float64)
    total = np.zeros(instants.shape)
    for term in signal:
        total += part(term, instants, side)
    return total


def derivative(signal: Signal, t: ArrayLike, side: Side = "right") -> Array:
    """Time derivative of the signal between its jumps.

    Args:
        signal: terms of a scenario's signal.
        t: instants, s, any shape.
        side: the limit to take exactly at a kink of a linear table.

    Returns:
        Derivatives in the signal's unit per second, shape of ``t``.

    >>> from umbilical.scenario.signals import Sine
    >>> derivative((Sine(kind="sine", amplitude=3.0, frequency=2.0),), 0.0).item()
    6.0
    """
    return _sum(_slope, signal, t, side)


def jumps(signal: Signal) -> tuple[float, ...]:
    """Published instants of a signal, increasing: jumps of steps and pulses, kinks of linear tables.

    >>> from umbilical.scenario.signals import Pulse
    >>> jumps((Pulse(kind="pulse", value=1.0, start=2.0, end=2.5),))
    (2.0, 2.5)
    """
    return tuple(sorted({instant for term in signal for instant in _instants(term)}))


def vessel(environment: Environment, t: ArrayLike, side: Side = "right") -> tuple[Array, Array]:
    """Displacement e(t), eq. (7), and velocity e'(t) of the vessel, faded in over ``vessel_ramp``.

    The fade is the quintic ``10 q^3 - 15 q^4 + 6 q^5``, twice differentiable, so a ramp above zero starts the
    vessel from e = e' = 0 whatever its motion is.

    Args:
        environment: holds the motion, m, and the ramp, s.
        t: instants, s, any shape.
        side: the limit to take exactly at a kink.

    Returns:
        Displacement, m, and velocity, m/s, each of the shape of ``t``.

    >>> from umbilical.scenario.environment import Environment
    >>> motion = ({"kind": "constant", "value": 2.0},)
    >>> sea = Environment(gravity=10.0, vessel_motion=motion, vessel_ramp=4.0)
    >>> [part.tolist() for part in vessel(sea, [0.0, 2.0, 9.0])]
    [[0.0, 1.0, 2.0], [0.0, 0.9375, 0.0]]
    """
    instants = np.asarray(t, dtype=np.float64)
    motion, ramp = seaway.along(environment), environment.vessel_ramp
    if not motion:
        return np.zeros(instants.shape), np.zeros(instants.shape)
    displacement, velocity = evaluate(motion, instants, side), derivative(motion, instants, side)
    if ramp == 0.0:
        return displacement, velocity
    q = np.clip(instants / ramp, 0.0, 1.0)
    square = q * q
    fade, fade_rate = q * square * (10.0 - 15.0 * q + 6.0 * square), 30.0 * square * (1.0 - q) ** 2 / ramp
    return fade * displacement, fade * velocity + fade_rate * displacement


def heave(environment: Environment, t: ArrayLike, side: Side = "right") -> tuple[Array, Array, Array, Array]:
    """Heave of the sheave, m, up, and its three derivatives, faded in as :func:`vessel` is; arguments as there.

    Only constants, sines, waves and smooth tables have three derivatives.

    >>> from umbilical.scenario.environment import Environment
    >>> motion = ({"kind": "sine", "amplitude": 2.0, "frequency": 0.5},)
    >>> sea = Environment(gravity=10.0, vessel_heave=motion)
    >>> [round(part.item(), 12) for part in heave(sea, 0.0)]
    [0.0, 1.0, 0.0, -0.25]
    """
    instants = np.asarray(t, dtype=np.float64)
    parts = np.zeros((4, *instants.shape))
    given = seaway.heaving(environment)
    for term in given:
        parts += [_higher(term, instants, order, side) for order in range(4)]
    if given and environment.vessel_ramp > 0.0:
        faded = fade(instants, environment.vessel_ramp, side)
        parts = np.array([sum(comb(k, j) * faded[j] * parts[k - j] for j in range(k + 1)) for k in range(4)])
    return parts[0], parts[1], parts[2], parts[3]


def fade(t: Array, ramp: float, side: Side) -> Array:
    """The fade of :func:`vessel` and its three derivatives, shape (4, ...)."""
    q = np.clip(t / ramp, 0.0, 1.0)
    runs = reached(t, 0.0, side) & ~reached(t, ramp, side)
    return np.array([
        q**3 * (10.0 - 15.0 * q + 6.0 * q * q),
        30.0 * q * q * (1.0 - q) ** 2 / ramp,
        60.0 * q * (1.0 - q) * (1.0 - 2.0 * q) / ramp**2,
        np.where(runs, (60.0 - 360.0 * q + 360.0 * q * q) / ramp**3, 0.0),
    ])  # fmt: skip


def _higher(term: Term, t: Array, order: int, side: Side) -> Array:
    """A derivative of a term that has three."""
    if isinstance(term, Sine):
        phase = term.phase + 0.5 * np.pi * order
        return term.amplitude * term.frequency**order * np.sin(term.frequency * t + phase)
    if isinstance(term, Waves):
        return regular.waves(term, t, order)
    if isinstance(term, Table):
        curve = spline(term.times, term.values)
        thirds = 6.0 * curve.c[0][np.clip(passed(term.times, t, side) - 1, 0, len(term.times) - 2)]
        return np.asarray(thirds if order == 3 else curve(t, order))
    return np.broadcast_to(_value(term, t, side) if order == 0 else 0.0, t.shape)


def reached(t: Array, instant: float, side: Side) -> NDArray[np.bool_]:
    """Whether what happens at ``instant`` has happened at ``t``; there, but for round-off, ``side`` decides."""
    same = slack(instant)
    return t >= instant - same if side == "right" else t > instant + same


def passed(instants: ArrayLike, t: Array, side: Side) -> NDArray[np.intp]:
    """How many of the increasing ``instants`` are reached at each ``t``, as :func:`reached` says."""
    marks = np.asarray(instants, dtype=np.float64)
    same = slack(marks)
    return np.searchsorted(marks - same if side == "right" else marks + same, t, side=side)


@lru_cache(maxsize=64)
def spline(times: tuple[float, ...], values: tuple[float, ...]) -> Any:
    """Cubic spline (not-a-knot) through a table; built once per table."""
    from scipy.interpolate import CubicSpline  # slow to import, and few scenarios have a table

    return CubicSpline(times, values)


def _value(term: Term, t: Array, side: Side) -> _Part:
    match term:
        case Constant():
            return term.value
        case Sine():
            return term.amplitude * np.sin(term.frequency * t + term.phase)
        case Bell():
            with np.errstate(over="ignore"):  # far from the centre the power overflows and the bell is 0
                return term.amplitude / (1.0 + _square(t, term) ** term.exponent)
        case Step():
            return term.value * reached(t, term.time, side)
        case Pulse():
            return term.value * (reached(t, term.start, side) & ~reached(t, term.end, side))
        case Table():
            return _linear(term, t, side) if term.interpolation == "linear" else curve_of(term)(t)
        case Waves():
            return regular.waves(term, t)


def _slope(term: Term, t: Array, side: Side) -> _Part:
    match term:
        case Sine():
            return term.amplitude * term.frequency * np.cos(term.frequency * t + term.phase)
        case Bell():
            # With u = |q|^(2b) the slope is -A u' / (1 + u)^2, u' = 2b u / (q width); at q = 0 and far away that is 0.
            with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
                u = _square(t, term) ** term.exponent
                slope = -2.0 * term.amplitude * term.exponent * u / ((t - term.center) * (1.0 + u) ** 2)
            return np.where(np.isfinite(slope), slope, 0.0)
        case Waves():
            return regular.waves(term, t, 1)
        case Table():
            return _linear_slope(term, t, side) if term.interpolation == "linear" else curve_of(term)(t, 1)
        case _:
            return 0.0  # constants, and steps and pulses between their jumps


def _square(t: Array, term: Bell) -> Array:
    q = (t - term.center) / term.width
    return q * q


def curve_of(term: Table) -> Any:
    """The smooth or monotone curve of a table."""
    return spline(term.times, term.values) if term.interpolation == "smooth" else _monotone(term.times, term.values)


@lru_cache(maxsize=64)
def _monotone(times: tuple[float, ...], values: tuple[float, ...]) -> Any:
    from scipy.interpolate import PchipInterpolator

    return PchipInterpolator(times, values)


def _linear(term: Table, t: Array, side: Side) -> Array:
    """Line from point to point; at an instant that stands twice, the side says which of both values counts."""
    found = np.interp(t, term.times, term.values)
    for k in np.flatnonzero(np.diff(term.times) == 0.0):
        there = abs(t - term.times[k]) <= slack(term.times[k])
        found = np.where(there, term.values[k + (side == "right")], found)
    return found


def _linear_slope(term: Table, t: Array, side: Side) -> Array:
    steps = np.diff(term.times)
    slopes = np.concatenate([[0.0], np.diff(term.values) / np.where(steps > 0.0, steps, 1.0), [0.0]])
    return slopes[passed(term.times, t, side)]


def _instants(term: Term) -> tuple[float, ...]:
    match term:
        case Step():
            return (term.time,)
        case Pulse():
            return term.start, term.end
        case Table(interpolation="linear"):
            return term.times
        case _:
            return ()


def table_jumps(signal: Signal) -> tuple[float, ...]:
    """Instants at which a linear table of the signal has two values."""
    terms = (term for term in signal if isinstance(term, Table))
    return tuple(a for term in terms for a, b in pairwise(term.times) if a == b)
