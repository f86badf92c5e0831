"""Closed forms of the string in water: a sheave that returns waves, statics and where the boundary law rests."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

Array = np.ndarray


class Sliding(NamedTuple):
    """A cable of constant tension that leaves the sheave at a constant speed, with added mass that stays behind.

    At a fixed depth the waves of ``rho (d_t + v d_x)^2 y + rho_a y_tt = T y_xx`` run at ``(rho v +- S)/M``, with
    M = rho + rho_a and ``S = sqrt(M T - rho rho_a v^2)``; y = 0 at the sheave turns one into the other.

    Attributes:
        tension: T, N.
        line_density, added: rho and rho_a, kg/m.
        speed: v, m/s.
        center, width: of the bump ``exp(-((x - center)/width)^2)`` m that is there at the start, m.
    """

    tension: float
    line_density: float
    added: float
    speed: float
    center: float = 250.0
    width: float = 25.0

    @property
    def speeds(self) -> tuple[float, float]:
        """Of the waves down and up, m/s."""
        inertia, carried = self.line_density + self.added, self.line_density * self.speed
        root = np.sqrt(inertia * self.tension - self.line_density * self.added * self.speed**2)
        return float((root + carried) / inertia), float((root - carried) / inertia)

    @property
    def reflection(self) -> float:
        """Slope that the sheave returns over the slope that comes up: (S - rho v)/(S + rho v)."""
        down, up = self.speeds
        return up / down

    def parts(self, x: Array, t: float) -> list[tuple[Array, Array, Array]]:
        """y, y_x and y_t of what went down, went up and has been returned, each with the shape of ``x``.

        The start, ``y_t = -(rho v/M) y_x``, halves the bump.
        """
        down, up = self.speeds
        waves = ((x - down * t, 1.0, -down, 0.5), (x + up * t, 1.0, up, 0.5))
        returned = ((x - down * t) * -up / down, -up / down, up, -0.5)
        return [self._bump(*wave) for wave in (*waves, returned)]

    def _bump(self, place: Array, along: float, over: float, share: float) -> tuple[Array, Array, Array]:
        off = (place - self.center) / self.width
        value = share * np.exp(-(off**2))
        steep = -2.0 * off / self.width * value
        return value, along * steep, over * steep


class Hung(NamedTuple):
    """What hangs in a uniform current: N/m and N of weight, N/m and N of drag, m of cable."""

    line_weight: float
    weight: float
    load: float
    force: float
    length: float

    def offset(self) -> float:
        """Where the body hangs under ``T y_x = F + q (l - x)``, m."""
        w, q = self.line_weight, self.load
        share = np.log(1.0 + w * self.length / self.weight)
        return float(self.force / w * share + q * self.length / w - q * self.weight / w**2 * share)

    def holding(self) -> float:
        """The force on the body that holds it under the sheave, N."""
        return float(-self.offset() * self.line_weight / np.log(1.0 + self.line_weight * self.length / self.weight))
