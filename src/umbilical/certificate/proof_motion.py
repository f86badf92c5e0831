"""Winch laws over intervals of time: written a second time, so that a slip in ``plant/winch.py`` is noticed.

The result holds l, v, a and the jerk at every instant inside the interval, which no jump of the law may part.
"""

from __future__ import annotations

from functools import singledispatch
from typing import Any

import numpy as np

from umbilical.plant.signals import spline
from umbilical.scenario.winch import ConstantLength, ConstantSpeed, Cosine, Quintic, TabulatedLength, Trapezoid, Winch

Interval = Any
Motion = tuple[Interval, Interval, Interval, Interval]


def motion_over(ctx: Any, winch: Winch, begin: float, end: float, middle: float | None = None) -> Motion:
    """Intervals of length, m, speed, m/s, acceleration, m/s2, and jerk, m/s3, from ``begin`` to ``end``, s.

    ``middle``, an instant beside a jump, says which side of it is meant where the interval is that one instant.
    """
    return _motion(winch, ctx, ctx.mpf([begin, end]), 0.5 * (begin + end) if middle is None else middle)


@singledispatch
def _motion(winch: Winch, ctx: Any, t: Interval, middle: float) -> Motion:
    raise TypeError(f"not a winch law: {winch!r}")


@_motion.register
def _(winch: ConstantLength, ctx: Any, t: Interval, middle: float) -> Motion:
    return ctx.mpf(winch.length), ctx.mpf(0), ctx.mpf(0), ctx.mpf(0)


@_motion.register
def _(winch: ConstantSpeed, ctx: Any, t: Interval, middle: float) -> Motion:
    speed = ctx.mpf(winch.speed)
    return winch.start_length + speed * t, speed, ctx.mpf(0), ctx.mpf(0)


@_motion.register
def _(winch: Quintic, ctx: Any, t: Interval, middle: float) -> Motion:
    if not winch.start < middle < winch.start + winch.duration:
        still = winch.start_length if middle <= winch.start else winch.end_length
        return ctx.mpf(still), ctx.mpf(0), ctx.mpf(0), ctx.mpf(0)
    way, time = ctx.mpf(winch.end_length) - winch.start_length, ctx.mpf(winch.duration)
    q = _clipped(ctx, (t - winch.start) / time)
    p = 1 - q  # the law is odd about its middle; written from the nearer end, intervals stay narrow at both
    first = middle < winch.start + 0.5 * winch.duration
    from_start = winch.start_length + way * q**3 * (1 + 3 * p + 6 * p**2)
    length = from_start if first else winch.end_length - way * p**3 * (1 + 3 * q + 6 * q**2)
    return (
        length,
        way / time * 30 * q**2 * p**2,
        way / time**2 * 60 * q * p * (p - q),
        way / time**3 * 60 * (1 - 6 * q * p),
    )


def _clipped(ctx: Any, q: Interval) -> Interval:
    """The part inside [0, 1]: a slab's ends are rounded, and beyond the law's own ends the winch stands."""
    return ctx.mpf([max(q.a, ctx.mpf(0).a), min(q.b, ctx.mpf(1).b)])


def _not_negative(ctx: Any, t: Interval) -> Interval:
    """The part above 0, for the same reason."""
    return ctx.mpf([max(t.a, ctx.mpf(0).a), max(t.b, ctx.mpf(0).b)])


@_motion.register
def _(winch: Trapezoid, ctx: Any, t: Interval, middle: float) -> Motion:
    way, hard = abs(ctx.mpf(winch.end_length) - winch.start_length), ctx.mpf(winch.acceleration)
    sign = 1 if winch.end_length >= winch.start_length else -1
    is_triangle = winch.top_speed**2 / winch.acceleration >= abs(winch.end_length - winch.start_length)
    ramp = ctx.sqrt(way / hard) if is_triangle else winch.top_speed / hard
    cruise = ctx.mpf(0) if is_triangle else way / winch.top_speed - ramp
    finish = winch.start + 2 * ramp + cruise
    if middle <= winch.start or middle >= float(finish.mid):
        still = winch.start_length if middle <= winch.start else winch.end_length
        return ctx.mpf(still), ctx.mpf(0), ctx.mpf(0), ctx.mpf(0)
    if middle < float((winch.start + ramp).mid):
        since = _not_negative(ctx, t - winch.start)
        return winch.start_length + sign * hard * since**2 / 2, sign * hard * since, sign * hard, ctx.mpf(0)
    if middle < float((winch.start + ramp + cruise).mid):
        swept = hard * ramp**2 / 2 + hard * ramp * (t - winch.start - ramp)
        return winch.start_length + sign * swept, sign * hard * ramp, ctx.mpf(0), ctx.mpf(0)
    left = _not_negative(ctx, finish - t)
    return winch.end_length - sign * hard * left**2 / 2, sign * hard * left, -sign * hard, ctx.mpf(0)


@_motion.register
def _(winch: Cosine, ctx: Any, t: Interval, middle: float) -> Motion:
    amplitude, frequency = ctx.mpf(winch.amplitude), ctx.mpf(winch.frequency)
    cosine, sine = amplitude * ctx.cos(frequency * t), amplitude * ctx.sin(frequency * t)
    length = winch.start_length + amplitude - cosine
    return length, frequency * sine, frequency**2 * cosine, -(frequency**3) * sine


@_motion.register
def _(winch: TabulatedLength, ctx: Any, t: Interval, middle: float) -> Motion:
    curve = spline(winch.times, winch.lengths)
    piece = int(np.clip(np.searchsorted(winch.times, middle) - 1, 0, len(winch.times) - 2))
    cubic, square, slope, value = (ctx.mpf(float(c)) for c in curve.c[:, piece])
    since = t - winch.times[piece]
    return (
        value + since * (slope + since * (square + since * cubic)),
        slope + since * (2 * square + since * 3 * cubic),
        2 * square + 6 * cubic * since,
        6 * cubic,
    )
