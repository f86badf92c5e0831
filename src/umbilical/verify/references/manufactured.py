"""Manufactured solutions of string and rope: every term at work, the length growing or shrinking.

Chosen is a sum of histories times shapes of sigma = x/l(t). What must drive it follows by putting it into the
equations as they stand, over the place x and not over what a solver may make of it; derivatives are those of a fixed
place, and with ``L = d/dt + w d/dx`` the material derivative has w = v, the winch's speed.

String, eqs. (6)-(8): ``y = p(t) sin(k sigma) + q(t) cos(k sigma)``, which starts from rest, so ``e = q``, and

    f = rho D2y/Dt2 - (T y_x)_x + c Dy/Dt         d = m D2y/Dt2 + T y_x + c_tip Dy/Dt  at the ROV
    T = W + w (l - x) - (m + rho (l - x)) a       weights in water, masses with all they are

In a sea there are added mass, drag and current besides, and the sheave heaves::

    f = ... + rho_a (d/dt + zeta' d/dx)^2 y - f_n - (rho_w A_c + rho_a) u_t
    f_n = q_n |u_r| u_r - q_t |v_z| v_z y_x,      u_r = u - y_t - zeta' y_x,      v_z = v - zeta'
    d = ... + A_h V' - (D_l + D_q |u - V|) (u - V) - (A_h + W_FK) u_t
    T = ... - A_z a_z - (q_b + q_t (l - x)) |v_z| v_z,      a_z = a - zeta'' in place of a

Rope, docs/rope.md: ``r = a(t) + b(t) sigma + c(t) sin(k sigma) + d(t) (cos(k sigma) - 1)`` with vectors a to d.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

Array = np.ndarray
History = Sequence[Any] | Array
"""A value with its two derivatives."""
WAVENUMBER, ROPE_WAVENUMBER = 2.3 * np.pi, 1.3 * np.pi
HEAVING, SURGING = 1.1, 1.7
"""Frequencies of the sheave's heave and of the current, rad/s."""
SEA_WATER = 1025.0


def _from_rest(size: float, frequency: float, t: Any) -> History:
    """``size (1 - cos w t)``."""
    w = frequency
    return size * (1.0 - np.cos(w * t)), size * w * np.sin(w * t), size * w * w * np.cos(w * t)


class Jet(NamedTuple):
    """A solution and its derivatives over place and time, at a fixed place."""

    value: Array
    x: Array
    xx: Array
    t: Array
    xt: Array
    tt: Array

    def along(self, speed: Any, change: Any) -> tuple[Array, Array]:
        """``L y`` and ``L^2 y`` for ``L = d/dt + w d/dx``, w the ``speed`` and w' its ``change``."""
        twice = self.tt + 2.0 * speed * self.xt + speed**2 * self.xx + change * self.x
        return self.t + speed * self.x, twice


def jet(histories: Sequence[History], shapes: Sequence[History], sigma: Array, winch: History) -> Jet:
    """The sum of histories times shapes by the chain rule; ``winch`` gives length, speed and acceleration."""

    def of(time: int, place: int) -> Array:
        return sum((h[time] * s[place] for h, s in zip(histories, shapes, strict=True)), start=np.zeros(()))

    length, v, a = winch
    moved, changed = -sigma * v / length, sigma * (2.0 * (v / length) ** 2 - a / length)
    return Jet(
        value=of(0, 0), x=of(0, 1) / length, xx=of(0, 2) / length**2, t=of(1, 0) + moved * of(0, 1),
        xt=(of(1, 1) + moved * of(0, 2) - v / length * of(0, 1)) / length,
        tt=of(2, 0) + 2.0 * moved * of(1, 1) + moved**2 * of(0, 2) + changed * of(0, 1),
    )  # fmt: skip


def _waves(k: float, sigma: Array, less: float = 0.0) -> tuple[History, History]:
    """sin(k sigma) and cos(k sigma) - ``less`` with two derivatives."""
    s, c = np.sin(k * sigma), np.cos(k * sigma)
    return (s, k * c, -k * k * s), (c - less, -k * s, -k * k * c)


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

    def winch(self, t: Array) -> History:
        """Length, speed, acceleration."""
        if self.steady:
            return self.start_length + self.speed * t, self.speed + 0.0 * t, 0.0 * t
        out, *rates = _from_rest(self.swing, self.frequency, t)
        return self.start_length + out, *rates

    def at(self, sigma: Array, t: Array) -> Jet:
        """y; ``q = q0 (1 - cos(1.3 t))`` is also the vessel's motion, and ``p = p(0) - (1 - cos(2 t))/3``."""
        value, *rates = _from_rest(-1.0 / 3.0, 2.0, t)
        histories = (self.start + value, *rates), _from_rest(self.vessel, 1.3, t)
        return jet(histories, _waves(WAVENUMBER, sigma), sigma, self.winch(t))

    def sinking(self, t: Array) -> History:
        """zeta, v_z and a_z: the heave, and how ROV and cable sink, m/s and m/s2."""
        (_, speed, acceleration), (heave, up, rate) = self.winch(t), _from_rest(self.sea.heave, HEAVING, t)
        return heave, speed - up, acceleration - rate

    def tension(self, above: Array, t: Array) -> tuple[Array, Array]:
        """T at a height above the ROV, N, and what it gains per metre, N/m."""
        sea, (_, sinks, sunk) = self.sea, self.sinking(t)
        braked = sinks * abs(sinks)
        gain = self.cable_weight - self.line_density * sunk - sea.tangential * braked
        return self.weight - (self.mass + sea.body_vertical) * sunk - sea.body_axial * braked + gain * above, gain


def displacement(problem: StringProblem, sigma: Array, t: Array | float) -> Array:
    """y, m."""
    return problem.at(sigma, np.asarray(t)).value


def velocity(problem: StringProblem, sigma: Array, t: Array | float) -> Array:
    """Dy/Dt, m/s."""
    return problem.at(sigma, np.asarray(t)).along(problem.winch(np.asarray(t))[1], 0.0)[0]


def tip_slope_rate(problem: StringProblem, t: Array) -> Array:
    """D(y_x)/Dt at the ROV, 1/s."""
    y = problem.at(np.ones(()), t)
    return y.xt + problem.winch(t)[1] * y.xx


def cable_load(problem: StringProblem, sigma: Array, t: Array) -> Array:
    """f, N/m, at the places sigma and instants t, which broadcast: (A0) of docs/theory.md solved for it."""
    sea, y, (length, speed, acceleration) = problem.sea, problem.at(sigma, t), problem.winch(t)
    heave, sinks, sunk = problem.sinking(t)
    material, inertial = y.along(speed, acceleration)
    passing, added = y.along(speed - sinks, acceleration - sunk)  # y_t + zeta' y_x: what the water sees
    tension, gain = problem.tension(length * (1.0 - sigma), t)
    flow, changing = sea.water(length * sigma - heave, t)
    drag = sea.normal * abs(flow - passing) * (flow - passing) - sea.tangential * sinks * abs(sinks) * y.x
    inertia = problem.line_density * inertial + sea.added * added - (sea.displaced + sea.added) * changing
    return inertia - (tension * y.xx - gain * y.x) + problem.damping * material - drag


def tip_force(problem: StringProblem, t: Array) -> Array:
    """d(t), N."""
    sea, y, (length, speed, acceleration) = problem.sea, problem.at(np.ones(()), t), problem.winch(t)
    first, second = y.along(speed, acceleration)
    flow, changing = sea.water(length - problem.sinking(t)[0], t)
    relative = flow - first
    drag = (sea.body_linear + sea.body_quadratic * abs(relative)) * relative
    moved = (sea.body_added + sea.body_displaced) * changing
    pull = problem.tension(np.zeros(()), t)[0] * y.x
    return (problem.mass + sea.body_added) * second + pull + problem.tip_damping * first - drag - moved


def wave_amplitude(problem: StringProblem, t: float) -> float:
    """Largest ``|Dy/Dt +- c y_x|``, m/s: the waves that run up and down, of which y is the sum; no water."""
    sigma, now = np.linspace(0.0, 1.0, 201), np.asarray(t)
    length, _, acceleration = problem.winch(now)
    gain = problem.cable_weight - problem.line_density * acceleration
    tension = problem.tension(np.zeros(()), now)[0] + gain * length * (1.0 - sigma)
    running = np.sqrt(tension / problem.line_density) * problem.at(sigma, now).x
    w = velocity(problem, sigma, t)
    return float(max(np.abs(w + running).max(), np.abs(w - running).max()))


class RopeProblem(NamedTuple):
    """Cable and body, SI units, and ``l = l0 + s (t + (1 - cos t)/5)``; the cable is taut and slides one way."""

    swing: float
    stiffness: float = 2e4
    density: float = 2.0
    weight: float = 15.0
    diameter: float = 0.04
    normal: float = 1.2
    tangential: float = 0.05
    added_mass: float = 1.0
    mass: float = 40.0
    body_weight: float = 300.0
    body_added: tuple[float, float, float] = (20.0, 30.0, 50.0)
    body_drag: tuple[float, float, float] = (10.0, 20.0, 30.0)
    current: tuple[float, float, float] = (0.3, -0.4, 0.0)
    start_length: float = 60.0

    def winch(self, t: float) -> History:
        """Length, speed, acceleration."""
        out, speed, acceleration = _from_rest(0.2 * self.swing, 1.0, t)
        return self.start_length + self.swing * t + out, self.swing + speed, acceleration

    def at(self, sigma: Array, t: float) -> Jet:
        """r, each derivative of shape (3, places)."""

        def swings(sizes: list[float], rates: list[float], phase: float) -> Array:
            size, rate = np.array([sizes, rates])[..., None]
            angle = rate * t + phase
            return np.array([size * np.sin(angle), size * rate * np.cos(angle), -size * rate**2 * np.sin(angle)])

        down = np.zeros((3, 3, 1))
        down[:, 2, 0] = -1.08 * np.array(self.winch(t))
        histories = (
            swings([0.4, 0.3, 0.2], [1.3, 1.1, 1.7], 0.4),
            swings([6.0, -4.0, 0.0], [0.7, 0.9, 1.0], 0.8) + down,
            swings([2.5, 1.5, 0.3], [1.2, 1.6, 2.1], 1.1),
            swings([1.0, 2.0, 0.2], [1.7, 0.8, 1.4], -0.5),
        )
        one, zero = np.ones_like(sigma), np.zeros_like(sigma)
        straight = (one, zero, zero), (sigma, one, zero)
        return jet(histories, (*straight, *_waves(ROPE_WAVENUMBER, sigma, 1.0)), sigma, self.winch(t))


def acceleration_given(problem: RopeProblem, sigma: Array, t: float) -> Array:
    """What a load must add to DW/Dt, m/s2, shape (3, places): Mb^-1 times the force that the equations lack."""
    r, (_, speed, change) = problem.at(sigma, t), problem.winch(t)
    velocity, acceleration = r.along(speed, change)
    added, half = problem.added_mass * SEA_WATER * np.pi / 4.0 * problem.diameter**2, 0.5 * SEA_WATER * problem.diameter
    size = np.linalg.norm(r.x, axis=0)
    tangent = r.x / size

    def across(vector: Array) -> Array:
        return vector - (vector * tangent).sum(axis=0) * tangent

    pull_x = problem.stiffness * ((1.0 - 1.0 / size) * r.xx + (r.x * r.xx).sum(axis=0) / size**3 * r.x)
    relative = np.array(problem.current)[:, None] - velocity
    slide = -(relative * tangent).sum(axis=0)
    moved = acceleration - 2.0 * slide * (r.xt + speed * r.xx) / size + slide**2 * across(r.xx) / size**2
    normal = across(relative)
    drag = half * problem.normal * np.linalg.norm(normal, axis=0) * normal
    drag = drag - half * np.pi * problem.tangential * np.abs(slide) * slide * tangent
    weight = np.array([[0.0], [0.0], [-problem.weight]])
    lacking = problem.density * acceleration + added * across(moved) - pull_x - drag - weight
    side = across(lacking)
    return (lacking - side) / problem.density + side / (problem.density + added)


def body_force(problem: RopeProblem, t: float) -> Array:
    """What must act on the body, N, shape (3,)."""
    r, (_, speed, change) = problem.at(np.ones(1), t), problem.winch(t)
    slope, velocity, acceleration = r.x[:, 0], *(rate[:, 0] for rate in r.along(speed, change))
    pull = problem.stiffness * (1.0 - 1.0 / np.linalg.norm(slope)) * slope
    relative = np.array(problem.current) - velocity
    drag = np.array(problem.body_drag) * np.abs(relative) * relative
    inertia = problem.mass + np.array(problem.body_added)
    return inertia * acceleration + pull - drag + np.array([0.0, 0.0, problem.body_weight])
