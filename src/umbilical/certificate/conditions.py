"""Conditions K0 to K6 with gam = 1, written once for numbers, for arrays of samples and for intervals.

Q stands for lam q/gam = lam x0/gam + (lam/gam) x, a velocity. At a given instant everything in K0 and K5 is a line in
x, or a line minus a positive multiple of the square of one (docs/certificates.md proves it), so the two ends of the
cable decide.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from umbilical.certificate.records import Inequality, Weights
from umbilical.certificate.setting import Loop, Payout
from umbilical.relations.tension import Hanging, fading_tension, tension, tension_gain

Array = np.ndarray
Real = Any  # a float, an array or an interval


class Terms(NamedTuple):
    """What the conditions are about, as numbers, arrays or intervals.

    Attributes:
        loop, weights: constants of the loop and of V.
        hanging: what hangs on the cable.
        length, v, net, jerk: of the winch: l, v, g - a and a'.
        reach: lam (l + x0)/gam.
        top, foot: tension at the vessel and at the ROV.
    """

    loop: Loop
    weights: Weights
    hanging: Hanging
    length: Real
    v: Real
    net: Real
    jerk: Real
    reach: Real
    top: Real
    foot: Real


def terms_of(loop: Loop, weights: Weights, motion: Payout) -> Terms:
    """The case of a winch in motion; loop, weights and motion are of one kind of numbers."""
    hung, length, net = loop.hanging, motion.l, motion.net
    reach = weights.vessel + weights.cross * length
    top, foot = tension(length, net, hung), tension(0.0 * length, net, hung)
    return Terms(loop, weights, hung, length, motion.v, net, motion.jerk, reach, top, foot)


def sides(case: Terms, rate: Real, vessel_moves: bool) -> Iterator[tuple[str, str, Real, Real, str, float]]:
    """The conditions with one number on each side: name, equation, left, right, unit, x/l; "<=" where equality holds.

    K0 and K5 hold for all x and are in :data:`ALONG`.
    """
    loop, reach, speed_squared = case.loop, case.reach, case.foot / case.loop.rho
    pull, eta = loop.rho * speed_squared, case.weights.boundary
    carried = 2.0 * (eta * loop.k_a - pull / (2.0 * loop.beta)) / (eta * loop.m)
    yield "wave", "v^2 < T_0/rho", case.v**2, case.top / loop.rho, "m2/s2", 0.0
    yield "K1", "lam (l + x0)/gam <= T_l/(beta rho)", reach, speed_squared / loop.beta, "m/s", 1.0
    yield "K2", "lam (l + x0)/gam <= beta", reach, loop.beta, "m/s", 1.0
    yield "K3", "T_l/(2 beta) < eta k_a/gam", pull / (2.0 * loop.beta), eta * loop.k_a, "N s/m", 1.0
    yield "K4", f"-v {'<' if vessel_moves else '<='} lam x0/gam", 0.0 - case.v, case.weights.vessel, "m/s", 0.0
    yield "K6", "th <= 2 (eta k_a - gam T_l/(2 beta))/(eta m)", rate, carried, "1/s", 1.0
    if loop.k_s is not None:
        yield "K6", "th <= k_s", rate, loop.k_s, "1/s", 1.0


def _weights(case: Terms, rate: Real) -> Iterator[Real]:
    """lam, eta and everything else that makes V a sum of squares; K0 then makes V1 + V2 one."""
    of = case.loop
    yield from (x for x in (of.rho, of.m, of.beta, of.k_a, of.k_s, of.vs) if x is not None)
    yield from (case.weights.cross, case.weights.boundary, case.foot)


def _k0(case: Terms, rate: Real) -> Iterator[Real]:
    """T - rho Q^2 at both ends; the line density, which *weights* holds above 0, makes it concave."""
    for pull, q in ((case.top, case.weights.vessel), (case.foot, case.reach)):
        yield pull - case.loop.rho * q**2


def _k5(case: Terms, rate: Real) -> Iterator[Real]:
    """A, C and AC - B^2 of M - th/2 N at both ends: A does not depend on x, B and C are lines."""
    for a, b, c in (_entries(case, end, rate) for end in (0, 1)):
        yield from (a, c, a * c - b**2)  # without A and C, A = B = 0 would let any C pass


ALONG: dict[str, Callable[[Terms, Real], Iterator[Real]]] = {"weights": _weights, "K0": _k0, "K5": _k5}
"""Conditions for all x at once: what must not be negative, in K5, or must be positive."""


def _entries(case: Terms, end: int, rate: Real) -> tuple[Real, Real, Real]:
    """Entries 11, 12, 22 of M - th/2 N at the vessel, 0, or the ROV, 1."""
    rho, c, lam, net = case.loop.rho, case.loop.c, case.weights.cross, case.net
    above, q = ((case.length, case.weights.vessel), (0.0 * case.length, case.reach))[end]
    far = fading_tension(lam - rate, above, net, case.jerk, case.hanging) + tension_gain(q, net, case.hanging)
    return c + rho * (lam - rate) / 2, (q * (c - rate * rho) - rho * case.v * lam) / 2, far / 2


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


def extent(loop: Loop, motion: Payout) -> Extent:
    """The room that K1, K2 and K4 leave.

    Between samples the speed may fall a little lower, unless it is exactly 0 there, as at both ends of a smooth law.
    """
    speed_squared = tension(0.0, motion.net, loop.hanging) / loop.rho  # T/rho at the ROV, m2/s2
    reach = np.minimum(loop.beta, speed_squared / loop.beta) * (1.0 - SLACK)
    lowest, largest = float(motion.v.min()), float(abs(motion.v).max())
    if abs(lowest) <= 1e-12 * largest:
        return Extent(reach, 0.0)
    return Extent(reach, max(0.0, SLACK * largest - lowest))


def largest_cross(motion: Payout, room: Extent, vessel: Real) -> Array:
    """Largest lam/gam for each lam x0/gam, 1/s; ``vessel`` has any shape."""
    share = room.reach.ravel() - np.asarray(vessel)[..., None]
    return (share / motion.l.ravel()).min(axis=-1)


def decay_rates(loop: Loop, motion: Payout, cross: Real, vessel: Real) -> Array:
    """Best th that K5 allows at every sample, 1/s; minus infinity where K0 fails.

    ``cross`` and ``vessel`` broadcast against the arrays of ``motion``.
    """
    return np.minimum(*_rates_at_ends(terms_of(loop, Weights(cross, vessel, np.nan), motion)))


def _rates_at_ends(case: Terms) -> Iterator[Array]:
    """The smaller root of ``det(M - th/2 N) = 0`` at the vessel, then at the ROV."""
    rho = case.loop.rho
    for end, pull, q in ((0, case.top, case.weights.vessel), (1, case.foot, case.reach)):
        m11, m12, m22 = _entries(case, end, 0.0)
        n12 = rho * q
        a, b, c = rho * pull - n12 * n12, m11 * pull + m22 * rho - 2.0 * m12 * n12, m11 * m22 - m12 * m12
        root = np.sqrt(np.maximum(b * b - 4.0 * a * c, 0.0))
        with np.errstate(divide="ignore", invalid="ignore"):
            smaller = np.where(b > 0.0, 2.0 * c / (b + root), (b - root) / (2.0 * a))
        yield np.where(a > 0.0, 2.0 * smaller, -np.inf)


def rate_limit(loop: Loop) -> float:
    """What K6 leaves to th at best, 1/s."""
    of_boundary = 0.99 * 2.0 * loop.k_a / loop.m
    return of_boundary if loop.k_s is None else min(loop.k_s, of_boundary)


def boundary_weight(loop: Loop, motion: Payout, rate: float) -> float:
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
    loop: Loop, motion: Payout, weights: Weights, proved: Array, vessel_moves: bool = False
) -> tuple[Condition, ...]:
    """K0 to K6 at every sample, for the proved rate of each slab; K4 must hold strictly where the vessel moves."""
    case = terms_of(loop, weights, motion)
    ends = tuple(_rates_at_ends(case))
    best = np.minimum(*ends)
    # Lowered in each slab until the least of them is the rate that was proved, if any was.
    rates = best - np.where(np.isfinite(proved), best.min(axis=1) - proved, 0.0)[:, None]
    wave, *others = sides(case, float(np.nan_to_num(proved).max()), vessel_moves)
    everywhere = np.zeros(motion.t.shape)
    k0 = ("K0", "lam q/gam < sqrt(T/rho)", case.reach, np.sqrt(case.foot / loop.rho), "m/s", 1.0)
    k5 = ("K5", "0 < th with M - th/2 N >= 0", 0.0, rates, "1/s", float(ends[1].min() < ends[0].min()))
    return tuple(
        Condition(name, text, left + everywhere, right + everywhere, unit, sigma, "<=" not in text)
        for name, text, left, right, unit, sigma in (wave, k0, *others[:4], k5, *others[4:])
    )


def tightest(condition: Condition, motion: Payout) -> Inequality:
    """The sample with the smallest margin."""
    at = np.unravel_index(np.argmin(condition.right - condition.left), motion.t.shape)
    place = {"x": float(condition.sigma * motion.l[at]), "t": float(motion.t[at])}
    sides = float(condition.left[at]), float(condition.right[at])
    return Inequality(condition.name, condition.equation, *sides, condition.unit, **place, strict=condition.strict)


def relative_margins(found: tuple[Condition, ...]) -> dict[str, Array]:
    """Smallest margin in each slab over the larger side, by name, shape (slabs,); K5 over its own best."""
    margins: dict[str, Array] = {}
    for name, _, left, right, *_ in found:
        scale = np.maximum(np.abs(left), np.abs(right)).max() or 1.0
        margins[name] = np.minimum(((right - left) / scale).min(axis=1), margins.get(name, np.inf))
    return margins
