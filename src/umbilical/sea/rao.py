"""Vessels from tables of RAOs: from declared conventions to complex amplitudes at midship."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from umbilical.scenario.ship import MOTIONS, BoxShip, RaoShip, Ship
from umbilical.sea.vessel import BoxVessel, Motions, Vessel
from umbilical.sea.waves import wave_number

WIDEST_STEP = np.radians(46.0)
"""Between headings further apart nothing is interpolated."""
_SAME = 1e-6
_STARBOARD = np.array([1.0, -1.0, -1.0, 1.0, -1.0, -1.0])
"""Signs of the six motions from axes with y to starboard and z down."""
_MIRRORED = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
"""Signs of the six motions when port and starboard change places."""


@dataclass(frozen=True, eq=False)
class RaoVessel:
    """Complex amplitudes at midship on a grid of headings and frequencies.

    Between the points real and imaginary parts are linear, never amplitude and phase; outside the frequencies of the
    table nothing moves, or, by ``outside = "hold"``, what moves at its ends. Where the table has headings of one side
    only, the ship's sides are taken to be alike.

    Attributes:
        heading: increasing, rad, shape (h,).
        omega: increasing, rad/s, shape (w,).
        amplitudes: shape (6, h, w).
        outside: of the frequencies, as :class:`RaoShip` has it.
    """

    heading: np.ndarray
    omega: np.ndarray
    amplitudes: np.ndarray
    outside: str = "refuse"

    def motions(self, omega: np.ndarray, heading: float) -> Motions:
        """Motions at frequencies, rad/s, of any shape; see :class:`Vessel`."""
        low, high, share = self._between(heading)
        rows = (1.0 - share) * low + share * high
        asked = np.asarray(omega, dtype=float)
        ends: dict[str, Any] = {} if self.outside == "hold" else {"left": 0.0, "right": 0.0}
        return Motions(*(np.interp(asked, self.omega, row, **ends) for row in rows))

    def knows(self, heading: float) -> bool:
        """Whether a heading is in the table, or between two that are at most :data:`WIDEST_STEP` apart."""
        angles, _ = self._around
        near = abs(np.exp(1j * (angles - heading)) - 1.0).min() < 1e-6
        asked = np.mod(heading - angles[0], 2.0 * np.pi) + angles[0]
        right = min(int(np.searchsorted(angles, asked, side="right")), angles.size - 1)
        return bool(near or angles[right] - angles[right - 1] <= WIDEST_STEP)

    def _between(self, heading: float) -> tuple[np.ndarray, np.ndarray, float]:
        """Rows of the headings on both sides, shape (6, w), and where between them the heading is."""
        angles, rows = self._around
        asked = float(np.mod(heading - angles[0], 2.0 * np.pi) + angles[0])
        right = min(int(np.searchsorted(angles, asked, side="right")), angles.size - 1)
        left = right - 1
        share = (asked - angles[left]) / (angles[right] - angles[left])
        return rows[:, left], rows[:, right], share

    @property
    def _around(self) -> tuple[np.ndarray, np.ndarray]:
        """Headings all round, the last one a full turn after the first, and their rows."""
        angles, rows = self.heading, self.amplitudes
        port = (angles > _SAME) & (angles < np.pi - _SAME)
        starboard = (angles > np.pi + _SAME) & (angles < 2.0 * np.pi - _SAME)
        if port.any() != starboard.any():
            inner = np.flatnonzero(port | starboard)
            angles = np.concatenate([angles, 2.0 * np.pi - angles[inner]])
            rows = np.concatenate([rows, rows[:, inner] * _MIRRORED[:, None, None]], axis=1)
            order = np.argsort(angles)
            angles, rows = angles[order], rows[:, order]
        return np.append(angles, angles[0] + 2.0 * np.pi), np.concatenate([rows, rows[:, :1]], axis=1)


def vessel_of(ship: Ship, gravity: float) -> Vessel:
    """What answers waves with motions, of a record.

    Args:
        ship: closed form or table.
        gravity: m/s2.
    """
    if isinstance(ship, BoxShip):
        return BoxVessel(ship.length, ship.breadth, ship.draught, ship.block_coefficient, gravity)
    known: Any = ship
    return _of_table(known, gravity)


def sheave_of(ship: Ship) -> tuple[float, float, float]:
    """Where the sheave is: forward, port and up of midship, m."""
    return ship.sheave_forward, ship.sheave_port, ship.sheave_up


@lru_cache(maxsize=8)
def _of_table(ship: RaoShip, gravity: float) -> RaoVessel:
    headings, omega, place = grid_of(ship)
    k = wave_number(omega, gravity)
    raw = np.array([rows_of(ship, name)[place] for name in MOTIONS])
    if ship.rotations == "per_slope":
        raw[3:] *= k
    if ship.axes == "starboard_down":
        raw *= _STARBOARD[:, None, None]
    ahead, aside = ship.phase_origin
    shift = ahead * np.cos(headings) + aside * np.sin(headings)
    raw = raw * np.exp(-1j * k * shift[:, None])
    x, y, z = ship.motion_point
    roll, pitch, yaw = raw[3:]
    raw[:3] -= np.array([pitch * z - yaw * y, yaw * x - roll * z, roll * y - pitch * x])
    return RaoVessel(headings, omega, raw, ship.outside)


def grid_of(ship: RaoShip) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Headings (where the waves go to, towards port), frequencies, and the row of the table at each of both.

    Raises:
        ValueError: rows that stand twice or that are missing.
    """
    turned = np.array(ship.heading) + (np.pi if ship.waves == "from" else 0.0)
    turned = -turned if ship.axes == "starboard_down" else turned
    heading = np.round(np.mod(turned + 1e-9, 2.0 * np.pi) - 1e-9, 9) + 0.0
    omega = np.round(np.array(ship.frequency), 9)
    headings, omegas = np.unique(heading), np.unique(omega)
    place = np.full((headings.size, omegas.size), -1)
    rows = np.searchsorted(headings, heading), np.searchsorted(omegas, omega)
    place[rows] = np.arange(heading.size)
    if heading.size > place.size or np.unique(np.ravel_multi_index(rows, place.shape)).size < heading.size:
        raise ValueError("a row stands twice")
    if (place < 0).any():
        raise ValueError("a row is missing")
    return headings, omegas, place


def rows_of(ship: RaoShip, name: str) -> np.ndarray:
    """Complex amplitude of one motion in each row, as the table's axes have it; 0 where the table has none."""
    amplitude = np.array(getattr(ship, name))
    if amplitude.size == 0:
        return np.zeros(len(ship.heading), dtype=complex)
    turn = -1.0 if ship.phase == "lag" else 1.0
    return amplitude * np.exp(turn * 1j * np.array(getattr(ship, f"{name}_phase")))
