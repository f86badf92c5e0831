"""The winch: length, speed, acceleration and jerk over arrays of time, for every law of the scenario."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from umbilical.plant.signals import Array, Side, passed, spline
from umbilical.scenario.winch import ConstantLength, ConstantSpeed, Cosine, Quintic, TabulatedLength, Trapezoid, Winch


class WinchMotion(NamedTuple):
    """Motion of the winch at the instants asked for, each an array of their shape.

    Attributes:
        length: cable paid out l, m.
        speed: v = dl/dt, m/s, positive paying out.
        acceleration: a = dv/dt, m/s2.
        jerk: da/dt, m/s3, between the published instants.
    """

    length: Array
    speed: Array
    acceleration: Array
    jerk: Array


def evaluate(winch: Winch, t: ArrayLike, side: Side = "right") -> WinchMotion:
    """Motion of the winch.

    Args:
        winch: law of the scenario.
        t: instants, s, any shape.
        side: the limit to take exactly where acceleration or jerk jumps.

    Returns:
        Length and its three derivatives, each of the shape of ``t``.

    >>> from umbilical.scenario.winch import Quintic
    >>> law = Quintic(law="quintic", start_length=450.0, end_length=500.0, duration=50.0)
    >>> motion = evaluate(law, [0.0, 25.0, 50.0])
    >>> motion.length.tolist(), motion.speed.tolist()
    ([450.0, 475.0, 500.0], [0.0, 1.875, 0.0])
    """
    return _motion(winch, np.asarray(t, dtype=np.float64), side)


def jumps(winch: Winch) -> tuple[float, ...]:
    """Published instants of a winch law, increasing: where its acceleration or its jerk jumps.

    >>> from umbilical.scenario.winch import ConstantLength
    >>> jumps(ConstantLength(law="constant", length=500.0))
    ()
    """
    return tuple(sorted(set(_instants(winch))))


def _motion(winch: Winch, t: Array, side: Side) -> WinchMotion:
    zero = np.zeros(t.shape)
    match winch:
        case ConstantLength():
            return WinchMotion(np.full(t.shape, winch.length), zero, zero, zero)
        case ConstantSpeed():
            return WinchMotion(winch.start_length + winch.speed * t, np.full(t.shape, winch.speed), zero, zero)
        case Quintic():
            return _quintic(winch, t, side)
        case Trapezoid():
            return _trapezoid(winch, t, side)
        case Cosine():
            amplitude, frequency = winch.amplitude, winch.frequency
            cosine, sine = amplitude * np.cos(frequency * t), amplitude * np.sin(frequency * t)
            length = winch.start_length + amplitude - cosine
            return WinchMotion(length, frequency * sine, frequency**2 * cosine, -(frequency**3) * sine)
        case TabulatedLength():
            curve = spline(winch.times, winch.lengths)
            thirds = 6.0 * curve.c[0]  # the third derivative is constant between knots
            piece = np.clip(passed(winch.times, t, side) - 1, 0, len(winch.times) - 2)
            return WinchMotion(curve(t), curve(t, 1), curve(t, 2), thirds[piece])


def _quintic(winch: Quintic, t: Array, side: Side) -> WinchMotion:
    # A numpy number: absurdly short, its powers give infinities that the checks refuse, not an exception.
    way, time = winch.end_length - winch.start_length, np.float64(winch.duration)
    q = np.clip((t - winch.start) / time, 0.0, 1.0)
    square = q * q
    # The jerk is the one derivative that does not vanish at both ends, so it needs to know when the winch runs.
    runs = passed(jumps(winch), t, side) == 1
    return WinchMotion(
        winch.start_length + way * q * square * (10.0 - 15.0 * q + 6.0 * square),
        way / time * 30.0 * square * (1.0 - q) ** 2,
        way / time**2 * 60.0 * q * (1.0 - q) * (1.0 - 2.0 * q),
        np.where(runs, way / time**3 * (60.0 - 360.0 * q + 360.0 * square), 0.0),
    )


def _trapezoid(winch: Trapezoid, t: Array, side: Side) -> WinchMotion:
    corners = np.array(_corners(winch))
    sign = np.sign(winch.end_length - winch.start_length)
    ramp, cruise, _ = np.diff(corners)
    top, acceleration = sign * winch.acceleration * ramp, sign * winch.acceleration
    swept = top * ramp / 2.0
    # One state per piece: before the start, speeding up, cruising, braking, after the end.
    since = corners[[0, 0, 1, 2, 3]]
    lengths = np.array([0.0, 0.0, swept, swept + top * cruise, 0.0]) + winch.start_length
    lengths[-1] = winch.end_length
    speeds = np.array([0.0, 0.0, top, top, 0.0])
    accelerations = np.array([0.0, acceleration, 0.0, -acceleration, 0.0])
    piece = passed(corners, t, side)
    v, a, dt = speeds[piece], accelerations[piece], t - since[piece]
    return WinchMotion(lengths[piece] + (v + a * dt / 2.0) * dt, v + a * dt, a, np.zeros(t.shape))


def _instants(winch: Winch) -> tuple[float, ...]:
    match winch:
        case Quintic():
            return winch.start, winch.start + winch.duration
        case Trapezoid():
            return _corners(winch)
        case TabulatedLength():
            return winch.times
        case _:
            return ()


def _corners(winch: Trapezoid) -> tuple[float, float, float, float]:
    """Start, end of speeding up, start of braking, end; a triangle when the top speed is not reached."""
    way = abs(winch.end_length - winch.start_length)
    ramp = min(winch.top_speed / winch.acceleration, float(np.sqrt(way / winch.acceleration)))
    cruise = max(way / (winch.acceleration * ramp) - ramp, 0.0) if ramp else 0.0
    begin = winch.start
    return begin, begin + ramp, begin + ramp + cruise, begin + 2.0 * ramp + cruise
