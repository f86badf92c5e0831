"""Stability of the sampled loop by Nyquist's count, without a grid along the cable.

With the coefficients of :class:`~umbilical.stability.sampled.LoopResponse` divided by ``up1``, and a factor f on
the thrust::

    1 - f L = (1 - f a2) (1 - trip) / (1 + echo b),   trip = echo R,   R = -(b - f b2)/(1 - f a2)

``1 - f a2`` is the loop on a cable without an end, ``trip`` what a wave is multiplied by in one round trip:
sent up, returned by the vessel, reflected by the controlled ROV. Both change smoothly with frequency, so a
sweep that resolves the phase of the echo misses no mode, however light its damping. ``1 + echo b`` is the
cable with a free ROV, which reflects no more than it receives and so turns no round.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from umbilical.stability.impedance import FixedLengthCable, waves_at_rov
from umbilical.stability.sampled import SampledLoop, loop_response

PER_DECADE = 300
"""Frequencies at which the smooth coefficients are computed; between them they are splines."""
PER_TURN = 32
"""Frequencies in one turn of the echo's phase."""
MOST = 1_000_000
"""Frequencies at most; where the echo turns faster the highest modes are left out."""
LOWEST = 1e-3
"""First frequency, in shares of pi over the round trip: below it nothing but the integrator of D^ acts."""
ARC = 64
"""Points of the quarter circle around z = 1, where the controller may have a pole."""

Factor = Callable[[np.ndarray], np.ndarray]
"""What multiplies the thrust, at complex frequencies p."""


class Opened(NamedTuple):
    """The opened loop at frequencies, every coefficient divided by ``up1``."""

    b: np.ndarray
    a2: np.ndarray
    b2: np.ndarray

    def endless(self, factor: np.ndarray) -> np.ndarray:
        """1 - f a2."""
        return 1.0 - factor * self.a2

    def loop(self, echo: np.ndarray) -> np.ndarray:
        """L."""
        return (self.a2 + echo * self.b2) / (1.0 + echo * self.b)

    def returned(self, factor: np.ndarray) -> np.ndarray:
        """R (1 - f a2)."""
        return -(self.b - factor * self.b2)

    def reflection(self, factor: np.ndarray) -> np.ndarray:
        """R."""
        return self.returned(factor) / self.endless(factor)


@dataclass(frozen=True)
class Sweep:
    """The opened loop over frequency.

    Attributes:
        cable, loop: what was swept.
        coarse: frequencies at which the smooth coefficients were computed, rad/s.
        opened: the loop there.
        w: frequencies dense enough for the echo, rad/s.
        echo: of the vessel there.
        arc, around: complex frequencies around z = 1, 1/s, with the loop and its echo there.
    """

    cable: FixedLengthCable
    loop: SampledLoop
    coarse: np.ndarray
    opened: Opened
    w: np.ndarray
    echo: np.ndarray
    arc: np.ndarray
    around: Opened
    arc_echo: np.ndarray

    @cached_property
    def dense(self) -> Opened:
        """The loop at the dense frequencies."""
        from scipy.interpolate import CubicSpline

        return Opened(*CubicSpline(np.log(self.coarse), np.stack(self.opened, axis=1))(np.log(self.w)).T)

    @cached_property
    def loudest(self) -> np.ndarray:
        """Largest size of the echo near each coarse frequency; it changes slowly."""
        return np.interp(self.coarse, self.w, np.abs(self.echo))

    def trip(self, factor: Factor) -> np.ndarray:
        """echo R at the dense frequencies."""
        return self.echo * self.dense.reflection(factor(1j * self.w))

    def trip_where(self, coarse: np.ndarray, factor: Factor) -> tuple[np.ndarray, np.ndarray]:
        """Dense frequencies from the first to the last of some coarse ones, and the round trip there."""
        first, last = np.flatnonzero(coarse)[[0, -1]]
        ends = self.coarse[[max(first - 1, 0), min(last + 1, coarse.size - 1)]]
        part = slice(*np.searchsorted(self.w, ends))
        w, opened = self.w[part], Opened(*(x[part] for x in self.dense))
        change = factor(1j * w)
        return resolved_ratio(w, self.echo[part] * opened.returned(change), opened.endless(change))

    def loud(self, factor: Factor) -> np.ndarray:
        """Whether a wave may come back larger than it was near each coarse frequency."""
        change = factor(1j * self.coarse)
        return self.loudest * np.abs(self.opened.returned(change)) >= _closest(self.opened.endless(change))

    def transfer(self) -> np.ndarray:
        """L at the dense frequencies."""
        return self.dense.loop(self.echo)

    def circles(self) -> tuple[np.ndarray, np.ndarray]:
        """Where L can be at the coarse frequencies, the echo in any phase: centre and radius of a circle.

        L is a fraction linear in the echo, so it takes a circle to a circle. Its largest value is that of a mode.
        """
        o = self.opened
        far = o.b2 / o.b
        share = np.abs(self.loudest * o.b) ** 2
        spread = (o.a2 - far) / (1.0 - share)
        return far + spread, np.abs(spread) * np.sqrt(share)


@dataclass(frozen=True)
class Growth:
    """A motion that grows: frequency, rad/s, and rate, 1/s; NaN where it is not an echo."""

    frequency: float
    rate: float


@dataclass(frozen=True)
class Stability:
    """Poles of the closed sampled loop outside the unit circle.

    Attributes:
        unstable: how many, by Nyquist's count.
        endless: how many the loop has on a cable without an end: observers, sampling and motors alone.
        worst: the echo that grows fastest, if one grows.
    """

    unstable: int
    endless: int
    worst: Growth | None


def unchanged(p: np.ndarray) -> np.ndarray:
    """The factor 1."""
    return np.ones_like(p)


def sweep_loop(cable: FixedLengthCable, loop: SampledLoop) -> Sweep:
    """The opened loop from far below the first mode to half the sampling frequency."""
    first, last = LOWEST * np.pi / cable.round_trip, np.pi / loop.outer_period
    coarse = np.geomspace(first, last, int(PER_DECADE * np.log10(last / first)))
    w = _dense(coarse, 2.0 * np.pi / (PER_TURN * cable.round_trip))
    arc = first * np.exp(0.5j * np.pi * np.linspace(0.0, 1.0, ARC))
    opened, around = (_opened(cable, loop, p) for p in (1j * coarse, arc))
    echo, arc_echo = (waves_at_rov(cable, p).echo for p in (1j * w, arc))
    return Sweep(cable, loop, coarse, opened, w, echo, arc, around, arc_echo)


def _opened(cable: FixedLengthCable, loop: SampledLoop, p: np.ndarray) -> Opened:
    r = loop_response(cable, loop, p)
    return Opened(r.down1 / r.up1, r.up2 / r.up1, r.down2 / r.up1)


def _dense(coarse: np.ndarray, step: float) -> np.ndarray:
    """The coarse frequencies, filled up where they are further apart than ``step``."""
    start = coarse[np.argmax(np.diff(coarse) > step)]
    even = np.arange(start, min(coarse[-1], start + MOST * step), step)
    return np.concatenate([coarse[coarse < start], even, coarse[coarse > even[-1]]])


def stability(s: Sweep, factor: Factor = unchanged) -> Stability:
    """Count the unstable poles of the closed loop, the thrust multiplied by a factor.

    The contour runs from z = 1 (around it, outside) along the unit circle to z = -1; the other half mirrors
    it. N = P - (change of the argument of 1 - f L)/pi, P the unstable poles of controller and motor loops.
    """
    own = s.loop.own_poles
    endless = _turned(s.around.endless(factor(s.arc))) + _turned(s.opened.endless(factor(1j * s.coarse)))
    echoes, worst = _growing_echoes(s, factor)
    ends = _echo_angle(s, factor)
    unstable = round(own - (endless + ends) / np.pi) + 2 * echoes
    return Stability(unstable, round(own - endless / np.pi), worst)


def _turned(curve: np.ndarray) -> float:
    """How far a smooth curve turns around 0, rad."""
    angle = np.unwrap(np.angle(curve))
    return float(angle[-1] - angle[0])


def _echo_angle(s: Sweep, factor: Factor) -> float:
    """Principal angle of (1 - trip)/(1 + echo b) at the end less that on the positive real axis, rad."""
    start = 1.0 - s.arc_echo * s.around.reflection(factor(s.arc))
    free = 1.0 + s.arc_echo * s.around.b
    begun = _turned(start / free)
    rim = Opened(*(x[[0, -1]] for x in s.dense))
    trip = s.echo[[0, -1]] * rim.reflection(factor(1j * s.w[[0, -1]]))
    last = (1.0 - trip) / (1.0 + s.echo[[0, -1]] * rim.b)
    return begun + float(np.angle(last[1]) - np.angle(last[0]))


def _growing_echoes(s: Sweep, factor: Factor) -> tuple[int, Growth | None]:
    """Round trips that return a wave in phase and larger: how many, less those passed the other way; the fastest."""
    loud = s.loud(factor)
    if not loud.any():
        return 0, None
    w, trip = s.trip_where(loud, factor)
    places, upward = crossings(np.imag(trip))
    # The modulus between two samples is a straight line; the chord of the circle would cut it short.
    left, right = np.abs(np.imag(trip)[places]), np.abs(np.imag(trip)[places + 1])
    size = (right * np.abs(trip[places]) + left * np.abs(trip[places + 1])) / (left + right)
    growing = (size > 1.0) & (np.real(trip)[places] > 0.0)
    if not growing.any():
        return 0, None
    rates = np.log(size[growing]) / _delay(w, trip, places[growing])
    fastest = Growth(float(w[places[growing][np.argmax(rates)]]), float(rates.max()))
    return int(np.where(upward, -1, 1)[growing].sum()), fastest


def _closest(curve: np.ndarray) -> np.ndarray:
    """Distance from 0 of a curve's straight pieces on either side of each of its points."""
    ends, step = curve[:-1], np.diff(curve)
    square = np.maximum(np.abs(step) ** 2, np.finfo(float).tiny)
    share = np.clip(-np.real(np.conj(step) * ends) / square, 0.0, 1.0)
    near = np.abs(ends + share * step)
    return np.minimum(np.append(near, np.inf), np.append(np.inf, near))


def resolved_ratio(w: np.ndarray, wave: np.ndarray, divisor: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """``wave/divisor`` over w, with more points where the divisor passes so close to 0 that it turns in one step.

    There, close to the limit of the loop on a cable without an end, the ratio has a peak that may lie between two
    points. Between them the divisor is a straight line, the wave turns and grows evenly.
    """
    step = 2.0 * np.pi / PER_TURN
    turn = np.angle(divisor[1:] / divisor[:-1])
    fast = np.flatnonzero(np.abs(turn) > step)
    counts = np.ceil(np.abs(turn[fast]) / step).astype(int)
    place = np.repeat(fast, counts - 1)
    number = np.arange(place.size) - np.repeat(np.cumsum(counts - 1) - (counts - 1), counts - 1) + 1
    way = np.exp(-1j * (np.angle(divisor[place]) + turn[place] * number / np.repeat(counts, counts - 1)))
    along = divisor[place + 1] - divisor[place]
    share = -np.imag(divisor[place] * way) / np.imag(along * way)
    more = wave[place] * (wave[place + 1] / wave[place]) ** share / (divisor[place] + share * along)
    at = w[place] + share * (w[place + 1] - w[place])
    return np.insert(w, place + 1, at), np.insert(wave / divisor, place + 1, more)


def crossings(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places after which a real curve changes its sign, and whether upward."""
    positive = values > 0.0
    places = np.flatnonzero(positive[1:] != positive[:-1])
    return places, positive[places + 1]


def _delay(w: np.ndarray, trip: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Time a round trip takes, -d(angle)/dw, s."""
    return -np.angle(trip[places + 1] / trip[places]) / (w[places + 1] - w[places])


def near_poles(s: Sweep, count: int) -> list[complex]:
    """First guesses of the closed loop's lowest modes, 1/s: where a round trip turns a wave by whole turns."""
    trip = s.trip(unchanged)
    places, _ = crossings(np.imag(trip))
    places = places[np.real(trip)[places] > 0.0][:count]
    rates = np.log(np.abs(trip[places])) / _delay(s.w, trip, places)
    return [complex(rate, w) for rate, w in zip(rates, s.w[places], strict=True)]
