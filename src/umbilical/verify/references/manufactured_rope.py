"""A manufactured solution of the rope in space: every term at work, the length growing or shrinking.

Chosen is ``R(sigma, t) = a(t) + b(t) sigma + c(t) sin(k sigma) + d(t) (cos(k sigma) - 1)`` with vectors a to d and
sigma = x/l(t). With ``A = 1 - sigma`` and ``g = v/l`` the material derivative is ``D/Dt = d/dt + g A d/dsigma``; what
must drive the cable and its body follows by putting R into the equations of docs/rope.md.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

Array = np.ndarray
WAVENUMBER = 1.3 * np.pi
SEA_WATER = 1025.0


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

    def winch(self, t: float) -> tuple[float, float, float]:
        """Length, speed, acceleration."""
        length = self.start_length + self.swing * (t + 0.2 * (1.0 - np.cos(t)))
        return length, self.swing * (1.0 + 0.2 * np.sin(t)), 0.2 * self.swing * np.cos(t)


class RopeFields(NamedTuple):
    """r, r_x, W = Dr/Dt and DW/Dt at some places and an instant, each of shape (3, places), and derivatives in x."""

    place: Array
    slope: Array
    velocity: Array
    acceleration: Array
    slope_x: Array
    velocity_x: Array


def _histories(problem: RopeProblem, t: float) -> Array:
    """a, b, c, d with two time derivatives, shape (4, 3 derivatives, 3 axes)."""
    length, speed, acceleration = problem.winch(t)

    def swings(sizes: tuple[float, float, float], rates: tuple[float, float, float], phase: float) -> Array:
        size, rate = np.array(sizes), np.array(rates)
        angle = rate * t + phase
        return np.array([size * np.sin(angle), size * rate * np.cos(angle), -size * rate**2 * np.sin(angle)])

    down = np.zeros((3, 3))
    down[:, 2] = -1.08 * np.array([length, speed, acceleration])
    lean = swings((6.0, -4.0, 0.0), (0.7, 0.9, 1.0), 0.8)
    return np.array(
        [
            swings((0.4, 0.3, 0.2), (1.3, 1.1, 1.7), 0.4),
            down + lean,
            swings((2.5, 1.5, 0.3), (1.2, 1.6, 2.1), 1.1),
            swings((1.0, 2.0, 0.2), (1.7, 0.8, 1.4), -0.5),
        ]
    )


def fields(problem: RopeProblem, sigma: Array, t: float) -> RopeFields:
    """The solution and what follows from it by the chain rule."""
    length, speed, acceleration = problem.winch(t)
    k, above = WAVENUMBER, 1.0 - sigma
    sine, cosine, one, zero = np.sin(k * sigma), np.cos(k * sigma), np.ones_like(sigma), np.zeros_like(sigma)
    shapes = np.array([one, sigma, sine, cosine - 1.0])
    first = np.array([zero, one, k * cosine, -k * sine])
    second = np.array([zero, zero, -k * k * sine, -k * k * cosine])
    h = _histories(problem, t)

    def of(shape: Array, derivative: int) -> Array:
        return np.einsum("ji,js->is", h[:, derivative], shape)

    g = speed / length
    rate = acceleration / length - g * g
    r_s, r_ss, r_ts = of(first, 0), of(second, 0), of(first, 1)
    moving = of(shapes, 2) + rate * above * r_s + 2.0 * g * above * r_ts + g * g * above * (above * r_ss - r_s)
    return RopeFields(
        place=of(shapes, 0),
        slope=r_s / length,
        velocity=of(shapes, 1) + g * above * r_s,
        acceleration=moving,
        slope_x=r_ss / length**2,
        velocity_x=(r_ts + g * (above * r_ss - r_s)) / length,
    )


def acceleration_given(problem: RopeProblem, sigma: Array, t: float) -> Array:
    """What a load must add to DW/Dt, m/s2, shape (3, places): Mb^-1 times the force that the equations lack."""
    f = fields(problem, sigma, t)
    area = np.pi / 4.0 * problem.diameter**2
    added, half = problem.added_mass * SEA_WATER * area, 0.5 * SEA_WATER * problem.diameter
    size = np.sqrt((f.slope**2).sum(axis=0))
    tangent = f.slope / size

    def across(vector: Array) -> Array:
        return vector - (vector * tangent).sum(axis=0) * tangent

    turning = across(f.slope_x) / size
    pull_x = problem.stiffness * (
        (1.0 - 1.0 / size) * f.slope_x + (f.slope * f.slope_x).sum(axis=0) / size**3 * f.slope
    )
    relative = np.array(problem.current)[:, None] - f.velocity
    slide = -(relative * tangent).sum(axis=0)
    moved = f.acceleration - 2.0 * slide * f.velocity_x / size + slide**2 * turning / size
    normal = across(relative)
    drag = half * problem.normal * np.sqrt((normal**2).sum(axis=0)) * normal
    drag = drag - half * np.pi * problem.tangential * np.abs(slide) * slide * tangent
    weight = np.array([0.0, 0.0, -problem.weight])[:, None]
    lacking = problem.density * f.acceleration + added * across(moved) - pull_x - drag - weight
    side = across(lacking)
    return (lacking - side) / problem.density + side / (problem.density + added)


def body_force(problem: RopeProblem, t: float) -> Array:
    """What must act on the body, N, shape (3,)."""
    f = fields(problem, np.ones(1), t)
    slope, velocity, acceleration = f.slope[:, 0], f.velocity[:, 0], f.acceleration[:, 0]
    size = float(np.linalg.norm(slope))
    pull = problem.stiffness * (1.0 - 1.0 / size) * slope
    relative = np.array(problem.current) - velocity
    drag = np.array(problem.body_drag) * np.abs(relative) * relative
    inertia = problem.mass + np.array(problem.body_added)
    return inertia * acceleration + pull - drag + np.array([0.0, 0.0, problem.body_weight])
