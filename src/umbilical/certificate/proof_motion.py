"""Winch laws over intervals of time: written a second time, so that a slip in ``plant/winch.py`` is noticed.

The result holds l, v, a and the jerk at every instant inside the interval, which no jump of the law may part.
"""

from __future__ import annotations

from functools import singledispatch
from math import inf
from typing import Any

import numpy as np

from umbilical.plant.signals import spline
from umbilical.plant.winch import WinchMotion
from umbilical.scenario.winch import ConstantLength, ConstantSpeed, Cosine, Quintic, TabulatedLength, Trapezoid, Winch

Interval = Any
Parts = tuple[Interval, Interval, Interval, Interval]


def motion_over(ctx: Any, winch: Winch, begin: float, end: float, middle: float | None = None) -> Any:
    """The winch from ``begin`` to ``end``, s: a ``WinchMotion`` of intervals, in m, m/s, m/s2 and m/s3.

    ``middle``, an instant beside a jump, says which side of it is meant where the interval is that one instant.
    """
    found = _motion(winch, ctx, ctx.mpf([begin, end]), 0.5 * (begin + end) if middle is None else middle)
    return WinchMotion(*found)


@singledispatch
def _motion(winch: Winch, ctx: Any, t: Interval, middle: float) -> Parts:
    raise TypeError(f"not a winch law: {winch!r}")


@_motion.register
def _(winch: ConstantLength, ctx: Any, t: Interval, middle: float) -> Parts:
    return _still(ctx, winch.length)


def _still(ctx: Any, length: float) -> Parts:
    return ctx.mpf(length), ctx.mpf(0), ctx.mpf(0), ctx.mpf(0)


@_motion.register
def _(winch: ConstantSpeed, ctx: Any, t: Interval, middle: float) -> Parts:
    speed = ctx.mpf(winch.speed)
    return winch.start_length + speed * t, speed, ctx.mpf(0), ctx.mpf(0)


@_motion.register
def _(winch: Quintic, ctx: Any, t: Interval, middle: float) -> Parts:
    if not winch.start < middle < winch.start + winch.duration:
        return _still(ctx, winch.start_length if middle <= winch.start else winch.end_length)
    way, time = ctx.mpf(winch.end_length) - winch.start_length, ctx.mpf(winch.duration)
    q = _within(ctx, (t - winch.start) / time, 1.0)
    p = 1 - q  # the law is odd about its middle; written from the nearer end, intervals stay narrow at both
    first = middle < winch.start + 0.5 * winch.duration
    from_start = winch.start_length + way * q**3 * (1 + 3 * p + 6 * p**2)
    length = from_start if first else winch.end_length - way * p**3 * (1 + 3 * q + 6 * q**2)
    speed, acceleration = way / time * 30 * q**2 * p**2, way / time**2 * 60 * q * p * (p - q)
    return length, speed, acceleration, way / time**3 * 60 * (1 - 6 * q * p)


def _within(ctx: Any, q: Interval, high: float) -> Interval:
    """The part inside [0, high]: a slab's ends are rounded, and beyond the law's own ends the winch stands."""
    low, high = ctx.mpf(0).a, ctx.mpf(high).b
    return ctx.mpf([max(q.a, low), min(max(q.b, low), high)])


@_motion.register
def _(winch: Trapezoid, ctx: Any, t: Interval, middle: float) -> Parts:
    way, hard = abs(ctx.mpf(winch.end_length) - winch.start_length), ctx.mpf(winch.acceleration)
    sign = 1 if winch.end_length >= winch.start_length else -1
    is_triangle = winch.top_speed**2 / winch.acceleration >= abs(winch.end_length - winch.start_length)
    ramp = ctx.sqrt(way / hard) if is_triangle else winch.top_speed / hard
    cruise = ctx.mpf(0) if is_triangle else way / winch.top_speed - ramp
    finish = winch.start + 2 * ramp + cruise
    if middle <= winch.start or middle >= float(finish.mid):
        return _still(ctx, winch.start_length if middle <= winch.start else winch.end_length)
    if middle < float((winch.start + ramp).mid):
        since = _within(ctx, t - winch.start, inf)
        return winch.start_length + sign * hard * since**2 / 2, sign * hard * since, sign * hard, ctx.mpf(0)
    if middle < float((winch.start + ramp + cruise).mid):
        swept = hard * ramp**2 / 2 + hard * ramp * (t - winch.start - ramp)
        return winch.start_length + sign * swept, sign * hard * ramp, ctx.mpf(0), ctx.mpf(0)
    left = _within(ctx, finish - t, inf)
    return winch.end_length - sign * hard * left**2 / 2, sign * hard * left, -sign * hard, ctx.mpf(0)


@_motion.register
def _(winch: Cosine, ctx: Any, t: Interval, middle: float) -> Parts:
    amplitude, frequency = ctx.mpf(winch.amplitude), ctx.mpf(winch.frequency)
    cosine, sine = amplitude * ctx.cos(frequency * t), amplitude * ctx.sin(frequency * t)
    length = winch.start_length + amplitude - cosine
    return length, frequency * sine, frequency**2 * cosine, -(frequency**3) * sine


@_motion.register
def _(winch: TabulatedLength, ctx: Any, t: Interval, middle: float) -> Parts:
    curve = spline(winch.times, winch.lengths)
    piece = int(np.clip(np.searchsorted(winch.times, middle) - 1, 0, len(winch.times) - 2))
    cubic, square, slope, value = (ctx.mpf(float(c)) for c in curve.c[:, piece])
    since = t - winch.times[piece]
    length = value + since * (slope + since * (square + since * cubic))
    return length, slope + since * (2 * square + since * 3 * cubic), 2 * square + 6 * cubic * since, 6 * cubic
