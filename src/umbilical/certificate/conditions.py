"""Conditions K0 to K6 in ordinary numbers, at sampled instants, with gam = 1.

Q stands for lam q/gam = lam x0/gam + (lam/gam) x, a velocity. At a given instant everything in K0 and K5 is a
quadratic of x that opens downward (docs/certificates.md proves it), so the two ends of the cable decide.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from umbilical.certificate.records import Inequality, Weights
from umbilical.certificate.setting import Loop, Motion
from umbilical.relations.tension import inertial_tension, tension, tension_gain

Array = np.ndarray
Real = Any  # a float or an array


class Extent(NamedTuple):
    """What the search may choose from, over the samples.

    Attributes:
        reach: min(beta, c_l^2/beta), m/s, which lam (l + x0)/gam may not exceed (K1, K2).
        least_vessel: smallest lam x0/gam that K4 allows, m/s.
    """

    reach: Array
    least_vessel: float


SLACK = 1e-3
"""Share of a bound that is left free, so that interval arithmetic can decide without splitting for ever."""


def extent(loop: Loop, motion: Motion) -> Extent:
    """The room that K1, K2 and K4 leave.

    Between samples the speed may fall a little lower, unless it is exactly 0 there, as at both ends of a smooth law.
    """
    reach = np.minimum(loop.beta, _wave_speed_squared(loop, motion) / loop.beta) * (1.0 - SLACK)
    lowest, largest = float(motion.v.min()), float(abs(motion.v).max())
    if abs(lowest) <= 1e-12 * largest:
        return Extent(reach, 0.0)
    return Extent(reach, max(0.0, SLACK * largest - lowest))


def largest_cross(motion: Motion, room: Extent, vessel: Real) -> Array:
    """Largest lam/gam for each lam x0/gam, 1/s; ``vessel`` has any shape."""
    share = room.reach.ravel() - np.asarray(vessel)[..., None]
    return (share / motion.l.ravel()).min(axis=-1)


def rates(loop: Loop, motion: Motion, cross: Real, vessel: Real) -> Array:
    """Best th that K5 allows at every sample, 1/s; minus infinity where K0 fails.

    The smaller root of ``det(M - th/2 N) = 0`` at both ends of the cable. ``cross`` and ``vessel`` broadcast
    against the arrays of ``motion``.
    """
    return np.minimum(*(_rate_at(loop, motion, cross, vessel, end) for end in (0.0, 1.0)))


def _rate_at(loop: Loop, motion: Motion, cross: Real, vessel: Real, sigma: float) -> Array:
    n11, n12, n22, m11, m12, m22 = _matrices(loop, motion, cross, vessel, sigma)
    a, b, c = n11 * n22 - n12 * n12, m11 * n22 + m22 * n11 - 2.0 * m12 * n12, m11 * m22 - m12 * m12
    root = np.sqrt(np.maximum(b * b - 4.0 * a * c, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        smaller = np.where(b > 0.0, 2.0 * c / (b + root), (b - root) / (2.0 * a))
    return np.where(a > 0.0, 2.0 * smaller, -np.inf)


def _matrices(loop: Loop, motion: Motion, cross: Real, vessel: Real, sigma: float) -> tuple[Array, ...]:
    """Entries 11, 12, 22 of N, then of M, at one end of the cable."""
    rho, net, hung, above = loop.rho, motion.net, loop.hanging, (1.0 - sigma) * motion.l
    q = vessel + cross * sigma * motion.l
    pull, changing = tension(above, net, hung), inertial_tension(above, net, hung)
    m11 = loop.c + 0.5 * rho * cross
    m12 = 0.5 * (loop.c * q - rho * motion.v * cross)
    m22 = 0.5 * (cross * pull + tension_gain(q, net, hung) + changing * motion.jerk)
    return rho + 0.0 * q, rho * q, pull, m11 + 0.0 * q, m12, m22


def rate_limit(loop: Loop) -> float:
    """What K6 leaves to th at best, 1/s."""
    of_boundary = 0.99 * 2.0 * loop.k_a / loop.m
    return of_boundary if loop.k_s is None else min(loop.k_s, of_boundary)


def boundary_weight(loop: Loop, motion: Motion, rate: float) -> float:
    """Smallest eta/gam that lets K3 and K6 carry a rate; small, because loads at the ROV are weighed with it."""
    needed = tension(0.0, motion.net.max(), loop.hanging) / (2.0 * loop.beta)
    return float(needed / (loop.k_a - 0.5 * loop.m * max(rate, 0.0)) * (1.0 + SLACK))


class Condition(NamedTuple):
    """One inequality ``left <= right`` over all samples, at ``sigma = x/l``, the end where it is tighter."""

    name: str
    equation: str
    left: Array
    right: Array
    unit: str
    sigma: float
    strict: bool


def conditions(
    loop: Loop, motion: Motion, weights: Weights, proved: Array, vessel_moves: bool = False
) -> tuple[Condition, ...]:
    """K0 to K6 at every sample, for the proved rate of each slab; K4 must hold strictly where the vessel moves."""
    shape = motion.t.shape
    return tuple(
        Condition(
            name, text, np.broadcast_to(left, shape), np.broadcast_to(right, shape), unit, sigma, "<=" not in text
        )
        for name, text, left, right, unit, sigma in _conditions(loop, motion, weights, proved, vessel_moves)
    )


def _conditions(
    loop: Loop, motion: Motion, weights: Weights, proved: Array, vessel_moves: bool
) -> Iterator[tuple[Any, ...]]:
    reach, speed_squared = weights.vessel + weights.cross * motion.l, _wave_speed_squared(loop, motion)
    ends = [_rate_at(loop, motion, weights.cross, weights.vessel, end) for end in (0.0, 1.0)]
    tighter = float(ends[1].min() < ends[0].min())
    state = State(motion.v, reach, speed_squared, tension(motion.l, motion.net, loop.hanging) / loop.rho)
    wave, *others = sides(loop, weights, state, float(np.nan_to_num(proved).max()), vessel_moves)
    yield wave
    yield "K0", "lam q/gam < sqrt(T/rho)", reach, np.sqrt(speed_squared), "m/s", 1.0
    yield from others[:4]
    yield "K5", "0 < th with M - th/2 N >= 0", 0.0, _lowered(np.minimum(*ends), proved), "1/s", tighter
    yield from others[4:]


class State(NamedTuple):
    """What the winch does, as numbers, arrays or intervals: its speed v, lam (l + x0)/gam, T/rho at ROV and vessel."""

    v: Real
    reach: Real
    speed_squared: Real
    top_squared: Real


def sides(
    loop: Loop, weights: Weights, state: State, rate: Real, vessel_moves: bool
) -> Iterator[tuple[str, str, Real, Real, str, float]]:
    """The conditions with one number on each side: name, equation, left, right, unit, x/l; "<=" where equality holds.

    Written once for what is sampled and for the intervals of the proof. K0 and K5, which hold for all x, are not here.
    """
    v, reach, speed_squared, top_squared = state
    pull, eta = loop.rho * speed_squared, weights.boundary
    carried = 2.0 * (eta * loop.k_a - pull / (2.0 * loop.beta)) / (eta * loop.m)
    yield "wave", "v^2 < T_0/rho", v**2, top_squared, "m2/s2", 0.0
    yield "K1", "lam (l + x0)/gam <= T_l/(beta rho)", reach, speed_squared / loop.beta, "m/s", 1.0
    yield "K2", "lam (l + x0)/gam <= beta", reach, loop.beta, "m/s", 1.0
    yield "K3", "T_l/(2 beta) < eta k_a/gam", pull / (2.0 * loop.beta), eta * loop.k_a, "N s/m", 1.0
    yield "K4", f"-v {'<' if vessel_moves else '<='} lam x0/gam", 0.0 - v, weights.vessel, "m/s", 0.0
    yield "K6", "th <= 2 (eta k_a - gam T_l/(2 beta))/(eta m)", rate, carried, "1/s", 1.0
    if loop.k_s is not None:
        yield "K6", "th <= k_s", rate, loop.k_s, "1/s", 1.0


def _lowered(sampled: Array, proved: Array) -> Array:
    """The samples of th, lowered in each slab until the least of them is the rate that was proved, if any was."""
    excess = np.where(np.isfinite(proved), sampled.min(axis=1) - proved, 0.0)
    return sampled - excess[:, None]


def tightest(condition: Condition, motion: Motion) -> Inequality:
    """The sample with the smallest margin."""
    at = np.unravel_index(np.argmin(condition.right - condition.left), motion.t.shape)
    place = {"x": float(condition.sigma * motion.l[at]), "t": float(motion.t[at])}
    sides = float(condition.left[at]), float(condition.right[at])
    return Inequality(condition.name, condition.equation, *sides, condition.unit, **place, strict=condition.strict)


def relative_margins(found: tuple[Condition, ...]) -> dict[str, Array]:
    """Smallest margin in each slab over the larger side, by name, shape (slabs,); K5 over its own best."""
    margins: dict[str, Array] = {}
    for condition in found:
        left, right = condition.left, condition.right
        scale = np.maximum(np.abs(left), np.abs(right)).max() or 1.0
        worst = ((right - left) / scale).min(axis=1)
        known = margins.get(condition.name)
        margins[condition.name] = worst if known is None else np.minimum(worst, known)
    return margins


def _wave_speed_squared(loop: Loop, motion: Motion) -> Array:
    """T/rho at the ROV, m2/s2."""
    return tension(0.0, motion.net, loop.hanging) / loop.rho
