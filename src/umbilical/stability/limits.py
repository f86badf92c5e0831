"""How much the loop survives: gain, phase and delay at the thrusters, each searched outward until a pole leaves.

A search by crossings of L would have to resolve resonances a hundred times narrower than their distance;
Nyquist's count does not, so the limits are found by counting: outward in small steps, then by bisection.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from umbilical.stability.nyquist import Factor, Sweep, stability

HALVINGS = 14
"""Halvings of the last step."""
GAIN_STEP = 1.08
"""Step of the search in gain: an island of instability narrower than it is stepped over."""
LARGEST_GAIN = 100.0
PHASE_STEP = np.deg2rad(3.0)
LARGEST_PHASE = np.deg2rad(90.0)
FIRST_DELAY = 1e-2
"""In outer periods, as is the next."""
LARGEST_DELAY = 1000.0


@dataclass(frozen=True)
class Limit:
    """Where a margin is used up.

    Attributes:
        size: of the change that makes the loop unstable; 0 or infinite where none was found.
        frequency: of the motion that then grows, rad/s; NaN if it is not an echo.
    """

    size: float
    frequency: float


@dataclass(frozen=True)
class Margins:
    """What the loop survives, opened at the thrusters.

    Attributes:
        gain_low, gain_high: range of the thrusters' effectiveness around 1.
        phase: extra lag or lead, the same at all frequencies, rad; infinite above 90 degrees.
        delay: extra delay, s.
    """

    gain_low: Limit
    gain_high: Limit
    phase: Limit
    delay: Limit

    def meets(self, gain: float, phase: float, delay: float) -> bool:
        """Whether gain (a factor, both ways), phase (rad) and delay (s) are survived."""
        gains = self.gain_low.size <= 1.0 / gain and self.gain_high.size >= gain
        return gains and self.phase.size >= phase and self.delay.size >= delay


def find_limits(s: Sweep) -> Margins:
    """The limits of a loop that is stable."""
    period = s.loop.outer_period
    gains = np.append(np.arange(1.0, np.log(LARGEST_GAIN) / np.log(GAIN_STEP)), 0.0)
    growing = GAIN_STEP ** np.sort(gains)
    phases = np.arange(0.0, LARGEST_PHASE + PHASE_STEP, PHASE_STEP)
    delays = np.append(0.0, np.geomspace(FIRST_DELAY, LARGEST_DELAY, 52) * period)
    lag, lead = (_limit(s, lambda x, sign=sign: phase_factor(sign * x), phases, np.inf) for sign in (1.0, -1.0))
    return Margins(
        gain_low=_limit(s, gain_factor, 1.0 / growing, 0.0),
        gain_high=_limit(s, gain_factor, growing, np.inf),
        phase=min(lag, lead, key=lambda limit: limit.size),
        delay=_limit(s, delay_factor, delays, np.inf),
    )


def gain_factor(gain: float) -> Factor:
    """A thruster that delivers a share of what is commanded."""
    return lambda p: np.full(p.shape, gain, dtype=complex)


def phase_factor(phase: float) -> Factor:
    """The same lag at every frequency, rad; none on the real axis."""
    return lambda p: np.exp(-1j * phase * np.angle(p) / (0.5 * np.pi))


def delay_factor(delay: float) -> Factor:
    """A delay, s."""
    return lambda p: np.exp(-p * delay)


def _limit(s: Sweep, change: Callable[[float], Factor], sizes: Iterable[float], otherwise: float) -> Limit:
    """The first size at which a pole leaves the unit circle."""
    steps = [float(size) for size in sizes]
    for inside, outside in pairwise(steps):
        if stability(s, change(outside)).unstable > 0:
            return _halved(s, change, inside, outside)
    return Limit(otherwise, np.nan)


def _halved(s: Sweep, change: Callable[[float], Factor], inside: float, outside: float) -> Limit:
    for _ in range(HALVINGS):
        middle = 0.5 * (inside + outside)
        if stability(s, change(middle)).unstable > 0:
            outside = middle
        else:
            inside = middle
    worst = stability(s, change(outside)).worst
    return Limit(outside, worst.frequency if worst else np.nan)
