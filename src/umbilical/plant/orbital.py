"""Airy orbital motion of the waves in deep water, at the sheave's place: ``u = a w e^{-k z}`` and its rate in time.

Before the steps of a stretch it is tabulated every :data:`STEP` at :data:`LEVELS` depths, as velocity and rate; a
kernel joins instants by cubics and depths by lines, so that many waves cost as little as one. Where less than a per
cent of the motion is left, and above the ship's keel, the water is taken to be at rest. Nothing is stretched to the
instantaneous surface, and nothing claimed of the splash zone.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import kernel
from umbilical.plant import signals
from umbilical.plant.seaway import waves_of
from umbilical.scenario.environment import Environment
from umbilical.sea.rao import sheave_of
from umbilical.sea.waves import wave_number

STEP = 0.1
"""s; the cubics miss w^4 h^4/384 of a wave, 7e-5 at 4 rad/s."""
LEVELS = 32
VELOCITY, RATE = range(2)
_BLOCK, _KEPT = 512, 8
_LEFT, _CLOSER = 0.01, 10.0


class Levels(NamedTuple):
    """Depths of the table: level i is ``close i/(places - i)`` below the first, closer above than below.

    Attributes:
        above: of the sheave over the surface, m: depths are asked below the sheave's mean height.
        first: depth of the uppermost level below the surface, m; infinite where waves do not move the water.
        close: m; near the first, levels are ``close/places`` apart.
        places: which the levels fill :data:`LEVELS`.
        deepest: of them, m below the surface.
    """

    above: float
    first: float
    close: float
    places: float
    deepest: float


AT_REST = np.zeros((2, 2, 1, LEVELS))
"""Rows of water that no waves move."""
NONE = Levels(0.0, np.inf, 1.0, 2.0 * LEVELS, 0.0)


@kernel
def find_level(levels: Levels, depth: float) -> float:
    """Place among the levels of a depth below the sheave's mean height, m; negative where the water is at rest."""
    under = depth - levels.above
    if under < levels.first or under >= levels.deepest:
        return -1.0
    return min(levels.places * (under - levels.first) / (under - levels.first + levels.close), LEVELS - 1.000001)


@kernel
def look_at_waves(rows: np.ndarray, place: float, now: np.ndarray) -> None:
    """Velocity and rate, m/s and m/s2, of each direction at every level into ``now``, shape (2, directions, levels).

    ``rows`` are of a stretch, shape (instants, 2, directions, levels); ``place`` counts :data:`STEP` from the first.
    """
    k = int(place)
    q = place - k
    p = 1.0 - q
    value, slope = q * q * (3.0 - 2.0 * q), 6.0 * q * p / STEP
    left, right = STEP * q * p * p, -STEP * q * q * p
    left_rate, right_rate = p * (1.0 - 3.0 * q), q * (3.0 * q - 2.0)
    for d in range(now.shape[1]):
        u, v, a, b = rows[k, VELOCITY, d], rows[k + 1, VELOCITY, d], rows[k, RATE, d], rows[k + 1, RATE, d]
        speed, rate = now[VELOCITY, d], now[RATE, d]
        for j in range(now.shape[2]):
            step = v[j] - u[j]
            speed[j] = u[j] + value * step + left * a[j] + right * b[j]
            rate[j] = slope * step + left_rate * a[j] + right_rate * b[j]


@kernel
def at_level(row: np.ndarray, level: float) -> float:
    """A row of levels at a place that :func:`find_level` gave; 0 where the water is at rest."""
    if level < 0.0:
        return 0.0
    k = int(level)
    return row[k] + (level - k) * (row[k + 1] - row[k])


def moves_the_water(environment: Environment) -> bool:
    """Whether the waves of an environment move the water around the cable."""
    return environment.sea is not None and environment.sea.orbital_below is not None


def levels_of(environment: Environment) -> Levels:
    """Depths at which the waves of an environment move the water."""
    return orbits(environment, 1).levels if moves_the_water(environment) else NONE


def fastest(environment: Environment) -> float:
    """Four times the root mean square of the speed at the uppermost level, m/s; 0 where waves move no water."""
    return orbits(environment, 1).fastest if moves_the_water(environment) else 0.0


def orbits(environment: Environment, directions: int = 3) -> Orbits:
    """Tables of an environment whose waves move the water: in the plane alone, or in three ``directions``."""
    known: Any = environment  # frozen records have a hash, which type checkers cannot see
    return _orbits(known, directions)


@lru_cache(maxsize=4)
def _orbits(environment: Environment, directions: int) -> Orbits:
    return Orbits(environment, directions)


class Orbits:
    """Orbital motion of an environment's waves: its levels, and rows for stretches of time."""

    def __init__(self, environment: Environment, directions: int) -> None:
        sea: Any = environment.sea
        waves = [(heading, wave) for heading, wave in waves_of(sea)]
        self._ramp = environment.vessel_ramp
        self._omega = np.concatenate([np.zeros(0), *(wave.omega for _, wave in waves)])
        k = wave_number(self._omega, environment.gravity)
        heading = np.concatenate([np.zeros(0), *(np.full(wave.omega.size, angle) for angle, wave in waves)])
        forward, port, up = sheave_of(sea.vessel)
        phase = np.concatenate([np.zeros(0), *(wave.phase for _, wave in waves)])
        phase = phase - k * (forward * np.cos(heading) + port * np.sin(heading))
        size = np.concatenate([np.zeros(0), *(wave.amplitude for _, wave in waves)]) * self._omega
        self.levels = _levels(up, sea.orbital_below, k, size)
        self.fastest = 4.0 * float(np.sqrt(np.sum((size * np.exp(-k * sea.orbital_below)) ** 2) / 2.0))
        speed = size * np.exp(1j * phase)
        parts = (speed * np.cos(heading - sea.plane), speed * np.sin(heading - sea.plane), 1j * speed)
        decay = np.exp(-np.outer(k, depths_of(self.levels)))
        decay[:, -1] = 0.0
        self._amplitude = np.stack([part[:, None] * decay for part in parts[:directions]], axis=1)
        turns = np.outer(np.arange(_BLOCK) * STEP, self._omega)
        self._turns = np.concatenate([np.cos(turns), -np.sin(turns)], axis=1)
        self._block = lru_cache(_KEPT)(self._tabulate)

    def rows(self, begin: float, end: float) -> tuple[int, np.ndarray]:
        """First instant in steps of :data:`STEP`, and rows from there to beyond ``end``, s, for :func:`look_at_waves`.

        Returns:
            Its number, and an array of the shape (instants, 2, directions, levels), m/s and m/s2.
        """
        first, last = int(np.floor(begin / STEP)), int(np.floor(end / STEP)) + 2
        numbers = range(first // _BLOCK, (last - 1) // _BLOCK + 1)
        found = np.concatenate([self._block(number) for number in numbers])
        cut = first - numbers[0] * _BLOCK
        return first, found[cut : cut + last - first]

    def _tabulate(self, number: int) -> np.ndarray:
        """Rows of a block."""
        start = number * _BLOCK * STEP
        speed = self._amplitude * np.exp(1j * self._omega * start)[:, None, None]
        both = np.stack([speed, 1j * self._omega[:, None, None] * speed], axis=1)
        flat = both.reshape(self._omega.size, 2 * self._amplitude.shape[1] * LEVELS)
        found = self._turns @ np.concatenate([flat.real, flat.imag])
        found = found.reshape(_BLOCK, *both.shape[1:])
        if start < self._ramp:
            fade, rate = signals.fade(start + np.arange(float(_BLOCK)) * STEP, self._ramp, "right")[:2, :, None, None]
            found[:, RATE] = fade * found[:, RATE] + rate * found[:, VELOCITY]
            found[:, VELOCITY] *= fade
        return found


def _levels(above: float, first: float, k: np.ndarray, size: np.ndarray) -> Levels:
    """Levels from a depth down to where a per cent of the motion there is left."""
    if not size.any():
        return NONE
    depth = first + np.linspace(0.0, 6.0 / k.min(), 2001)
    left = np.sqrt(np.exp(-2.0 * np.outer(depth, k)) @ size**2)
    deepest = float(depth[np.argmax(left <= _LEFT * left[0])])
    close = (deepest - first) / _CLOSER
    return Levels(above, first, close, (LEVELS - 1) * (1.0 + 1.0 / _CLOSER), deepest)


def depths_of(levels: Levels) -> np.ndarray:
    """Depths of the levels below the surface, m, shape (levels,)."""
    place = np.arange(float(LEVELS))
    return levels.first + levels.close * place / (levels.places - place)
