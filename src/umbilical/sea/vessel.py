"""What a vessel makes of waves: complex amplitudes of its motions per metre of wave amplitude.

The wave is ``eta = Re a e^{i (w t - k X)}`` with X along its direction from midship; a motion is ``Re a H e^{i w t}``.
x points forward, y to port, z up; a pitch is positive bow down, a roll positive starboard down.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np


class Motions(NamedTuple):
    """Complex amplitudes at midship, each of the shape of the frequencies: m/m, and rotations in rad/m."""

    surge: np.ndarray
    sway: np.ndarray
    heave: np.ndarray
    roll: np.ndarray
    pitch: np.ndarray
    yaw: np.ndarray


class Vessel(Protocol):
    """Anything that answers waves with motions."""

    def motions(self, omega: np.ndarray, heading: float) -> Motions:
        """Motions at angular frequencies, rad/s, for waves that go towards ``heading``, rad."""
        ...


def heave_of_point(vessel: Vessel, omega: np.ndarray, heading: float, forward: float, port: float) -> np.ndarray:
    """Complex heave of a point of the vessel per metre of wave amplitude.

    Args:
        vessel: what moves.
        omega: angular frequencies, rad/s.
        heading: direction the waves go to, rad; 0 following, pi head sea.
        forward, port: place of the point from midship, m.

    >>> ship = BoxVessel(93.0, 20.0, 6.6, 0.75)
    >>> long_waves = heave_of_point(ship, np.array([0.05]), np.pi, 10.0, 0.0)
    >>> float(np.round(abs(long_waves[0]), 2))
    1.0
    """
    return motion_of_point(vessel.motions(omega, heading), (forward, port, 0.0))[2]


def motion_of_point(motions: Motions, point: tuple[float, float, float]) -> np.ndarray:
    """Motion of a point of the vessel, forward, port and up, per metre of wave amplitude.

    Args:
        motions: at midship.
        point: forward, port and up of midship at the waterline, m.

    Returns:
        Complex amplitudes, shape (3, frequencies): translation and the rotations' levers are added as complex numbers.
    """
    x, y, z = point
    m = motions
    forward, port = m.surge + m.pitch * z - m.yaw * y, m.sway + m.yaw * x - m.roll * z
    return np.array([forward, port, m.heave - x * m.pitch + y * m.roll])


@dataclass(frozen=True)
class BoxVessel:
    """The closed form of Jensen, Mansour and Olsen for heave and pitch of a box at zero speed. It gives no roll or yaw.

    Source: Jensen, Mansour, Olsen, Estimation of ship motions using closed-form expressions, Ocean Eng. 31 (2004).
    It has no viscous damping: heave in beam seas near its resonance is too large (1.67 m/m at 8 s for the preset).
    In waves shorter than twice the breadth it tends to 0.5 in beam seas, where a ship hardly answers; there it is let
    fall with e^(-k T) (assumed). In bow and head seas that changes nothing that is seen.
    Surge and sway are those of the water the box displaces, averaged over it (assumed: a body free to drift follows the
    orbits of waves that are long against it).

    Attributes:
        length, breadth, draught: m.
        block_coefficient: displaced volume over length, breadth and draught.
        gravity: m/s2.
    """

    length: float
    breadth: float
    draught: float
    block_coefficient: float
    gravity: float = 9.81

    def motions(self, omega: np.ndarray, heading: float) -> Motions:
        """Heave and pitch in quadrature, surge and sway as the water; see :class:`Vessel`."""
        k = np.asarray(omega, dtype=float) ** 2 / self.gravity
        along = k * abs(np.cos(heading))
        half = np.maximum(along * self.length / 2.0, 1e-4)  # the limits of both quotients at 0 within 1e-8
        short = np.maximum(k - np.pi / self._wide, 0.0)
        force = self._damped_force(k) * np.exp(-(along + short) * self.draught) * _magnification(k, self)
        heave = force * np.sin(half) / half
        pitch = force * 6.0 / (self.length * half) * (np.sin(half) / half - np.cos(half))
        # The deck follows long waves: zeta(x) = e^{-i k x cos(heading)}, of which -x pitch is the linear part.
        turned = 1j * np.sign(np.cos(heading)) * np.where(along > 0.0, pitch, 0.0)
        drift, none = -1j * self._orbit(k, heading), np.zeros_like(heave) + 0j
        return Motions(drift * np.cos(heading), drift * np.sin(heading), heave + 0j, none, turned, none)

    def _orbit(self, k: np.ndarray, heading: float) -> np.ndarray:
        """Horizontal amplitude of the water's orbits, averaged over the box."""
        deep = np.maximum(k * self.draught, 1e-9)
        along, across = k * np.cos(heading) * self.length, k * np.sin(heading) * self.breadth
        return -np.expm1(-deep) / deep * np.sinc(along / (2.0 * np.pi)) * np.sinc(across / (2.0 * np.pi))

    def _damped_force(self, k: np.ndarray) -> np.ndarray:
        return np.hypot(1.0 - k * self.draught, _radiated(k, self) ** 2 / (k * self._wide))

    @property
    def _wide(self) -> float:
        """Breadth of the box that displaces what the ship does, m."""
        return self.block_coefficient * self.breadth


def _radiated(k: np.ndarray, ship: BoxVessel) -> np.ndarray:
    """Ratio of radiated wave to heave of a section."""
    return 2.0 * np.sin(k * ship._wide / 2.0) * np.exp(-k * ship.draught)


def _magnification(k: np.ndarray, ship: BoxVessel) -> np.ndarray:
    """Resonance of heave and pitch, which have one natural frequency here."""
    return 1.0 / np.hypot(1.0 - 2.0 * k * ship.draught, _radiated(k, ship) ** 2 / (k * ship._wide))
