"""Reference solver: the cable of constant tension on a moving domain, by the method of characteristics.

At distance s from the ROV the cable is ``y = F(t - s/c) + H(t + s/c)``, whatever the winch does. The vessel
end returns ``H(t + l(t)/c) = e(t) - F(t - l(t)/c)``; the ROV turns H and the impulse I of a force P on it into its
own motion Y0, ``m Y0' + (Z + k)(Y0 - Y0(0)) = 2 Z (H - H(0)) + I`` (start at rest), and sends ``F = Y0 - H``.
Each stretch shorter than the way up and down is a linear equation with a known right-hand side, solved by
Chebyshev collocation, so the only error is the polynomial one: below 1e-10.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import chebyshev as cheb

Curve = Callable[[np.ndarray], np.ndarray]


class MovingEnd:
    """Response of cable and ROV to a start, a force on the ROV and a motion of the vessel.

    Args:
        tension: N, constant.
        density: kg/m.
        mass: of the ROV, kg.
        damping: at the ROV, N s/m.
        length: cable length, m, over arrays of time.
        start: displacement at rest, m, over arrays of the distance from the ROV; it vanishes at both ends.
        until: last instant wanted, s.
        impulse: ``I = integral of P``, N s, over arrays of time; smooth, and 0 at 0.
        vessel: e(t), m, likewise.
        pieces: stretches per second.
        degree: of the polynomial on each stretch.
    """

    def __init__(
        self, tension: float, density: float, mass: float, damping: float, length: Curve, start: Curve, until: float,
        impulse: Curve = np.zeros_like, vessel: Curve = np.zeros_like, pieces: int = 4, degree: int = 40,
    ) -> None:  # fmt: skip
        self._length, self._start, self._vessel, self._pieces = length, start, vessel, pieces
        self._speed, impedance = float(np.sqrt(tension / density)), float(np.sqrt(tension * density))
        origin, reach = (float(curve(np.zeros(1))[0]) for curve in (start, length))
        self._reach = reach / self._speed
        self._tip = np.zeros((int(np.ceil(until * pieces)), degree + 1))
        decay, drive, value = (impedance + damping) / mass, 2.0 * impedance / mass, origin
        nodes = cheb.chebpts2(degree + 1)
        values = cheb.chebvander(nodes, degree)
        matrix = cheb.chebvander(nodes, degree - 1) @ cheb.chebder(np.eye(degree + 1)) * 2.0 * pieces + decay * values
        matrix[0] = values[0]
        for k in range(len(self._tip)):  # Y0' = drive (H - H(0)) + I/m - decay (Y0 - Y0(0))
            instants = (k + 0.5 * (nodes + 1.0)) / pieces
            right = drive * (self._incoming(instants) - 0.5 * origin) + decay * origin + impulse(instants) / mass
            right[0] = value
            self._tip[k] = np.linalg.solve(matrix, right)
            value = float(self._tip[k].sum())

    def __call__(self, distance: np.ndarray, t: float) -> np.ndarray:
        """Displacement, m, at distances from the ROV, m."""
        lag = distance / self._speed
        return self._outgoing(t - lag) + self._incoming(t + lag)

    def tip(self, t: np.ndarray) -> np.ndarray:
        """Displacement of the ROV, m."""
        place = np.minimum((t * self._pieces).astype(int), len(self._tip) - 1)
        inside = 2.0 * (t * self._pieces - place) - 1.0
        return (cheb.chebvander(inside, self._tip.shape[1] - 1) * self._tip[place]).sum(axis=-1)

    def _incoming(self, u: np.ndarray) -> np.ndarray:
        """H at arguments up to the furthest that has left the vessel."""
        out = np.empty_like(u)
        early = u <= self._reach
        out[early] = 0.5 * self._start(np.abs(u[early]) * self._speed)
        if not early.all():
            left = self._departure(u[~early])
            out[~early] = self._vessel(left) - self._outgoing(left - self._length(left) / self._speed)
        return out

    def _outgoing(self, u: np.ndarray) -> np.ndarray:
        """F: half of the start before 0, what the ROV has sent after it."""
        out = np.empty_like(u)
        early = u <= 0.0
        out[early] = 0.5 * self._start(-u[early] * self._speed)
        out[~early] = self.tip(u[~early]) - self._incoming(u[~early])
        return out

    def _departure(self, arrival: np.ndarray) -> np.ndarray:
        """When waves left the vessel that reach the ROV at ``arrival``: tau + l(tau)/c = arrival."""
        left = arrival
        for _ in range(60):  # contracts by |v|/c each time
            left = arrival - self._length(left) / self._speed
        return left


class HeldEnd:
    """Free response of a cable whose lower end is held while the upper one moves steadily, in closed form.

    ``y = H(t + s/c) - H(t - s/c)`` with H odd in what the start gives, and repeated where the phase
    ``R(t) = 2 ln(1 + b c t/l0)/ln((1 + b)/(1 - b))``, b = v/c, has grown by 2 (Moore; Balazs).

    Args:
        wave_speed: c, m/s.
        length: at the start, m.
        speed: v of the upper end, m/s, not 0.
        start: displacement at rest, m, over arrays of the distance from the held end.
    """

    def __init__(self, wave_speed: float, length: float, speed: float, start: Curve) -> None:
        self._c, self._l0, self._v, self._start = wave_speed, length, speed, start
        self._stretch = (wave_speed + speed) / (wave_speed - speed)

    def __call__(self, distance: np.ndarray, t: float) -> np.ndarray:
        """Displacement, m, at distances from the held end, m."""
        lag = distance / self._c
        return self._half(t + lag) - self._half(t - lag)

    def _half(self, u: np.ndarray) -> np.ndarray:
        """H: taken back, period of the phase by period, to where the start gives it."""
        scaled = 1.0 + self._v * u / self._l0  # R grows by 2 where this is multiplied by the stretch
        phase = np.log(scaled) / np.log(self._stretch)
        periods = np.round(phase - np.log1p(-self._v / self._c) / np.log(self._stretch) - 0.5)
        first = (scaled * self._stretch**-periods - 1.0) * self._l0 / self._v * self._c
        return 0.5 * np.sign(first) * self._start(np.abs(first))
