"""A manufactured solution of the full problem, eqs. (6)-(8): every term at work, the length growing or shrinking.

Chosen is ``y = p(t) sin(k sigma) + q(t) cos(k sigma)`` with sigma = x/l(t), which starts from rest. With ``A = 1 -
sigma`` and ``b = v/l`` the material derivative is ``D/Dt = d/dt + b A d/dsigma``, so what must drive it, from

    f = rho D2y/Dt2 - (T y_x)_x + c Dy/Dt         d = m D2y/Dt2 + T y_x + c_tip Dy/Dt  at the ROV
    T = W + w (l - x) - (m + rho (l - x)) a       weights in water, masses with all they are

is known in closed form, and ``e = q``. In a sea there are added mass, drag and current besides, and the sheave heaves::

    f = ... + rho_a (d/dt + zeta' d/dx)^2 y - f_n - (rho_w A_c + rho_a) u_t
    f_n = q_n |u_r| u_r - q_t |v_z| v_z y_x,      u_r = u - y_t - zeta' y_x,      v_z = v - zeta'
    d = ... + A_h V' - (D_l + D_q |u - V|) (u - V) - (A_h + W_FK) u_t
    T = ... - A_z a_z - (q_b + q_t (l - x)) |v_z| v_z,      a_z = a - zeta'' in place of a

The equation as it stands, over the place x and not over what a solver may make of it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

Array = np.ndarray
WAVENUMBER = 2.3 * np.pi
HEAVING, SURGING = 1.1, 1.7
"""Frequencies of the sheave's heave and of the current, rad/s."""


class Histories(NamedTuple):
    """A history with its two time derivatives."""

    value: Array
    first: Array
    second: Array


class Sea(NamedTuple):
    """Water around the cable; without numbers there is none.

    Attributes:
        displaced, added: of a metre of cable, kg/m.
        normal, tangential: drag of a metre over the square of the speed, N s2/m3.
        body_displaced, body_added, body_vertical: of the ROV, kg; body_axial: its drag along the cable, N s2/m2.
        body_linear, body_quadratic: its drag across, N s/m and N s2/m2.
        surface, shear: the current is ``surface + shear z``, m/s and 1/s, z the depth, times 1 + surge sin(1.7 t).
        surge: see there.
        heave: zeta = heave (1 - cos(1.1 t)), m.
    """

    displaced: float = 0.0
    added: float = 0.0
    normal: float = 0.0
    tangential: float = 0.0
    body_displaced: float = 0.0
    body_added: float = 0.0
    body_vertical: float = 0.0
    body_axial: float = 0.0
    body_linear: float = 0.0
    body_quadratic: float = 0.0
    surface: float = 0.0
    shear: float = 0.0
    surge: float = 0.0
    heave: float = 0.0

    def heaving(self, t: Array) -> tuple[Array, Array, Array]:
        """zeta, m, with its two derivatives."""
        w, size = HEAVING, self.heave
        return size * (1.0 - np.cos(w * t)), size * w * np.sin(w * t), size * w * w * np.cos(w * t)

    def water(self, depth: Array, t: Array) -> tuple[Array, Array]:
        """u and u_t at a fixed depth, m/s and m/s2."""
        still = self.surface + self.shear * depth
        return still * (1.0 + self.surge * np.sin(SURGING * t)), still * self.surge * SURGING * np.cos(SURGING * t)


class StringProblem(NamedTuple):
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
    sea: Sea = Sea()

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
        """T(l) = W - (m + A_z) a_z less the drag of the ROV as it sinks, N."""
        _, speed, acceleration = self.winch(t)
        _, zeta, zeta_rate = self.sea.heaving(t)
        sinks = speed - zeta
        moved = self.mass + self.sea.body_vertical
        return self.weight - moved * (acceleration - zeta_rate) - self.sea.body_axial * sinks * abs(sinks)

    def sine_part(self, t: Array) -> Histories:
        """p(t) = p(0) - (1 - cos(2 t))/3."""
        value = self.start - (1.0 - np.cos(2.0 * t)) / 3.0
        return Histories(value, -2.0 / 3.0 * np.sin(2.0 * t), -4.0 / 3.0 * np.cos(2.0 * t))

    def cosine_part(self, t: Array) -> Histories:
        """q(t) = q0 (1 - cos(1.3 t)): also the vessel's motion."""
        w, q0 = 1.3, self.vessel
        return Histories(q0 * (1.0 - np.cos(w * t)), q0 * w * np.sin(w * t), q0 * w * w * np.cos(w * t))


def displacement(problem: StringProblem, sigma: Array, t: Array | float) -> Array:
    """y, m."""
    angle, now = WAVENUMBER * sigma, np.asarray(t)
    return problem.sine_part(now).value * np.sin(angle) + problem.cosine_part(now).value * np.cos(angle)


def velocity(problem: StringProblem, sigma: Array, t: Array | float) -> Array:
    """Dy/Dt, m/s."""
    now = np.asarray(t)
    p, q = problem.sine_part(now), problem.cosine_part(now)
    length, speed, _ = problem.winch(now)
    angle, slide = WAVENUMBER * sigma, WAVENUMBER * speed / length * (1.0 - sigma)
    return (p.first - slide * q.value) * np.sin(angle) + (q.first + slide * p.value) * np.cos(angle)


def tip_slope_rate(problem: StringProblem, t: Array) -> Array:
    """D(y_x)/Dt at the ROV, 1/s: there A = 0, so it is the plain time derivative of the slope."""
    p, q = problem.sine_part(t), problem.cosine_part(t)
    length, speed, _ = problem.winch(t)
    s, c = np.sin(WAVENUMBER), np.cos(WAVENUMBER)
    value, rate = p.value * c - q.value * s, p.first * c - q.first * s
    return WAVENUMBER / length * (rate - speed / length * value)


def _along(problem: StringProblem, sigma: Array, t: Array, carrier: Array, change: Array) -> tuple[Array, Array]:
    """``L y`` and ``L^2 y`` for ``L = d_t + w d_x`` at a fixed place, w the ``carrier`` and w' its ``change``.

    Over sigma that is ``d_t + b d_sigma`` with ``b = (w - v sigma)/l``.
    """
    p, q = problem.sine_part(t), problem.cosine_part(t)
    length, speed, acceleration = problem.winch(t)
    k, s, c = WAVENUMBER, np.sin(WAVENUMBER * sigma), np.cos(WAVENUMBER * sigma)
    b = (carrier - speed * sigma) / length
    changes = (change - acceleration * sigma) / length - b * speed / length  # b_t
    bent = k * (p.value * c - q.value * s)  # y_sigma
    turning = k * (p.first * c - q.first * s)
    curved = -k * k * (p.value * s + q.value * c)
    once = p.first * s + q.first * c + b * bent
    twice = p.second * s + q.second * c + 2.0 * b * turning + (changes - b * speed / length) * bent + b * b * curved
    return once, twice


def cable_load(problem: StringProblem, sigma: Array, t: Array) -> Array:
    """f, N/m, at the places sigma and instants t, which broadcast: (A0) of docs/theory.md solved for it."""
    sea, k = problem.sea, WAVENUMBER
    length, speed, acceleration = problem.winch(t)
    heave, zeta, zeta_rate = sea.heaving(t)
    p, q = problem.sine_part(t), problem.cosine_part(t)
    s, c = np.sin(k * sigma), np.cos(k * sigma)
    slope, curved = k * (p.value * c - q.value * s) / length, -k * k * (p.value * s + q.value * c) / length**2
    material, inertial = _along(problem, sigma, t, speed, acceleration)
    passing, added = _along(problem, sigma, t, zeta, zeta_rate)  # y_t + zeta' y_x: what the water sees
    sinks, above = speed - zeta, length * (1.0 - sigma)
    braked = sinks * abs(sinks)
    gain = problem.cable_weight - problem.line_density * (acceleration - zeta_rate) - sea.tangential * braked
    tension = problem.tension_at_the_tip(t) + gain * above
    pull = tension * curved - gain * slope
    flow, changing = sea.water(length * sigma - heave, t)
    drag = sea.normal * abs(flow - passing) * (flow - passing) - sea.tangential * braked * slope
    inertia = problem.line_density * inertial + sea.added * added - (sea.displaced + sea.added) * changing
    return inertia - pull + problem.damping * material - drag


def tip_force(problem: StringProblem, t: Array) -> Array:
    """d(t), N: at the ROV A = 0, so D/Dt is the plain time derivative of p and q."""
    sea = problem.sea
    p, q = problem.sine_part(t), problem.cosine_part(t)
    length = problem.winch(t)[0]
    heave = sea.heaving(t)[0]
    s, c = np.sin(WAVENUMBER), np.cos(WAVENUMBER)
    first, second = p.first * s + q.first * c, p.second * s + q.second * c
    slope = WAVENUMBER * (p.value * c - q.value * s) / length
    flow, changing = sea.water(length - heave, t)
    relative = flow - first
    drag = (sea.body_linear + sea.body_quadratic * abs(relative)) * relative
    moved = (sea.body_added + sea.body_displaced) * changing
    inertia = (problem.mass + sea.body_added) * second
    return inertia + problem.tension_at_the_tip(t) * slope + problem.tip_damping * first - drag - moved


def wave_amplitude(problem: StringProblem, t: float) -> float:
    """Largest ``|Dy/Dt +- c y_x|``, m/s: the waves that run up and down, of which y is the sum; no water."""
    sigma = np.linspace(0.0, 1.0, 201)
    length, _, acceleration = problem.winch(np.asarray(t))
    gain = problem.cable_weight - problem.line_density * acceleration
    tension = problem.tension_at_the_tip(np.asarray(t)) + gain * length * (1.0 - sigma)
    slope = np.gradient(displacement(problem, sigma, t), sigma) / length
    running = np.sqrt(tension / problem.line_density) * slope
    w = velocity(problem, sigma, t)
    return float(max(np.abs(w + running).max(), np.abs(w - running).max()))
