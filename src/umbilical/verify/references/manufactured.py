"""A manufactured solution of the full problem, eqs. (6)-(8): every term at work, the length growing or shrinking.

Chosen is ``y = p(t) sin(k sigma) + q(t) cos(k sigma)`` with sigma = x/l(t), which starts from rest. With ``A = 1 -
sigma`` and ``b = v/l`` the material derivative is ``D/Dt = d/dt + b A d/dsigma``, so what must drive it, from

    f = rho D2y/Dt2 - (T y_x)_x + c Dy/Dt         d = m D2y/Dt2 + T y_x + c_tip Dy/Dt  at the ROV
    T = W + w (l - x) - (m + rho (l - x)) a       weights in water, masses with all they are

is a sum of six profiles, ``{1, A, A^2} x {sin, cos}``, each with a history of its own, and ``e = q``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

Array = np.ndarray
WAVENUMBER = 2.3 * np.pi


class Histories(NamedTuple):
    """A history with its two time derivatives."""

    value: Array
    first: Array
    second: Array


class Problem(NamedTuple):
    """Cable and ROV with their weights, N/m and N, and ``l = l0 + s (1 - cos w t)``.

    The cable grows or shrinks with the sign of s until pi/w. With ``steady`` the winch turns at the constant speed s w
    instead, which leaves at rest only a cable that hangs straight: p then starts from 0.
    """

    swing: float
    line_density: float = 2.0
    cable_weight: float = 20.0
    mass: float = 50.0
    weight: float = 500.0
    gravity: float = 10.0
    damping: float = 0.3
    tip_damping: float = 5.0
    start_length: float = 60.0
    frequency: float = 1.0
    vessel: float = 0.25
    steady: bool = False

    @property
    def speed(self) -> float:
        """Largest winch speed, m/s."""
        return self.swing * self.frequency

    @property
    def start(self) -> float:
        """p(0), m."""
        return 0.0 if self.steady else 4.0 / 3.0

    def winch(self, t: Array) -> tuple[Array, Array, Array]:
        """Length, speed, acceleration."""
        if self.steady:
            return self.start_length + self.speed * t, self.speed + 0.0 * t, 0.0 * t
        w, s = self.frequency, self.swing
        length = self.start_length + s * (1.0 - np.cos(w * t))
        return length, s * w * np.sin(w * t), s * w * w * np.cos(w * t)

    def tension_at_the_tip(self, t: Array) -> Array:
        """T(l) = W - m a, N."""
        return self.weight - self.mass * self.winch(t)[2]

    def sine_part(self, t: Array) -> Histories:
        """p(t) = p(0) - (1 - cos(2 t))/3."""
        value = self.start - (1.0 - np.cos(2.0 * t)) / 3.0
        return Histories(value, -2.0 / 3.0 * np.sin(2.0 * t), -4.0 / 3.0 * np.cos(2.0 * t))

    def cosine_part(self, t: Array) -> Histories:
        """q(t) = q0 (1 - cos(1.3 t)): also the vessel's motion."""
        w, q0 = 1.3, self.vessel
        return Histories(q0 * (1.0 - np.cos(w * t)), q0 * w * np.sin(w * t), q0 * w * w * np.cos(w * t))


def displacement(problem: Problem, sigma: Array, t: Array | float) -> Array:
    """y, m."""
    angle, now = WAVENUMBER * sigma, np.asarray(t)
    return problem.sine_part(now).value * np.sin(angle) + problem.cosine_part(now).value * np.cos(angle)


def velocity(problem: Problem, sigma: Array, t: Array | float) -> Array:
    """Dy/Dt, m/s."""
    now = np.asarray(t)
    p, q = problem.sine_part(now), problem.cosine_part(now)
    length, speed, _ = problem.winch(now)
    angle, slide = WAVENUMBER * sigma, WAVENUMBER * speed / length * (1.0 - sigma)
    return (p.first - slide * q.value) * np.sin(angle) + (q.first + slide * p.value) * np.cos(angle)


def tip_slope_rate(problem: Problem, t: Array) -> Array:
    """D(y_x)/Dt at the ROV, 1/s: there A = 0, so it is the plain time derivative of the slope."""
    p, q = problem.sine_part(t), problem.cosine_part(t)
    length, speed, _ = problem.winch(t)
    s, c = np.sin(WAVENUMBER), np.cos(WAVENUMBER)
    value, rate = p.value * c - q.value * s, p.first * c - q.first * s
    return WAVENUMBER / length * (rate - speed / length * value)


def profiles(sigma: Array) -> Array:
    """The six profiles along the cable, shape (6, sigma): ``{1, A, A^2} x {sin, cos}``, sines first."""
    above = 1.0 - sigma
    waves = (np.sin(WAVENUMBER * sigma), np.cos(WAVENUMBER * sigma))
    return np.array([above**power * wave for wave in waves for power in range(3)])


def load(problem: Problem, t: Array) -> Array:
    """Histories of the six profiles in f, N/m, shape (6, t)."""
    k, rho, c = WAVENUMBER, problem.line_density, problem.damping
    length, speed, acceleration = problem.winch(t)
    foot, gain = problem.tension_at_the_tip(t), problem.cable_weight - rho * acceleration
    b = speed / length
    db = acceleration / length - b * b
    p, q = problem.sine_part(t), problem.cosine_part(t)
    rows = []
    # D2/Dt2 (g S) = g'' S + (2 g' b + g b') A S' + g b^2 (A^2 S'' - A S'), and S' of a sine is k times a cosine.
    for g, h, sign in ((p, q, -1.0), (q, p, 1.0)):
        inertia = (
            g.second,
            sign * k * (2.0 * h.first * b + h.value * db - h.value * b * b),
            -k * k * g.value * b * b,
        )
        # T = T_l + (w - rho a) l A, so (T y_x)_x = [T g S'' - (w - rho a) l g S']/l^2.
        slope = sign * k * h.value
        pull = (
            (-foot * k * k * g.value - gain * length * slope) / length**2,
            -gain / length * k * k * g.value,
            0.0 * t,
        )
        drag = (g.first, sign * k * b * h.value, 0.0 * t)
        rows += [rho * inertia[n] - pull[n] + c * drag[n] for n in range(3)]
    return np.array(rows)


def force(problem: Problem, t: Array) -> Array:
    """d(t), N: at the ROV A = 0, so D/Dt is the plain time derivative of p and q."""
    p, q = problem.sine_part(t), problem.cosine_part(t)
    length = problem.winch(t)[0]
    s, c = np.sin(WAVENUMBER), np.cos(WAVENUMBER)
    slope = WAVENUMBER / length * (p.value * c - q.value * s)
    return (
        problem.mass * (p.second * s + q.second * c)
        + problem.tension_at_the_tip(t) * slope
        + problem.tip_damping * (p.first * s + q.first * c)
    )


def wave_amplitude(problem: Problem, t: float) -> float:
    """Largest ``|Dy/Dt +- c y_x|``, m/s: the waves that run up and down, of which y is the sum."""
    sigma = np.linspace(0.0, 1.0, 201)
    length, _, acceleration = problem.winch(np.asarray(t))
    gain = problem.cable_weight - problem.line_density * acceleration
    tension = problem.tension_at_the_tip(np.asarray(t)) + gain * length * (1.0 - sigma)
    slope = np.gradient(displacement(problem, sigma, t), sigma) / length
    running = np.sqrt(tension / problem.line_density) * slope
    w = velocity(problem, sigma, t)
    return float(max(np.abs(w + running).max(), np.abs(w - running).max()))
