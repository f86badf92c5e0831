"""What follows from a certificate for V: its start, the residual that loads leave, and its bound over the run."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from umbilical.certificate.loads import Loads
from umbilical.certificate.ranges import ROUNDING
from umbilical.certificate.records import Certificate, Ranges, Start, Weights
from umbilical.certificate.setting import Loop
from umbilical.plant import signals
from umbilical.plant.initial import slope_of_shape
from umbilical.plant.top import top_at
from umbilical.relations.tension import tension
from umbilical.scenario.scenario import Scenario

POINTS = 400
"""Intervals along the cable for integrals."""


class Residual(NamedTuple):
    """``V' <= -(th - spent) V + power``: spent in 1/s, power (the Th of the paper) in W; ``cable``: without V3, W."""

    spent: float
    power: float
    cable: float


def residual_of(loop: Loop, ranges: Ranges, weights: Weights, rate: float, loads: Loads) -> Residual:
    """What bounded loads leave of the decay.

    Half the rate pays for loads along the cable, if there are any: that makes their share of the final bound
    smallest. D' is that of the force on the ROV alone, since an ideal thruster delivers what is commanded.
    """
    spent = max(0.5 * rate, 0.0) if loads.cable else 0.0
    of_cable = _of_vessel(loop, ranges, weights, loads.vessel_velocity)
    if loads.cable:
        of_cable += loads.cable / (2.0 * loop.rho * spent) if spent else float("inf")
    if loop.k_s is None:
        of_law = weights.boundary * loads.force**2 / (4.0 * loop.k_a)  # half of k_a pays; loop.k_a is the other half
    else:
        of_law = weights.boundary * loads.force_rate**2 / (2.0 * loop.k_s**2 * loop.vs)
    return Residual(spent, of_cable + of_law, of_cable)


def _of_vessel(loop: Loop, ranges: Ranges, weights: Weights, velocity: float) -> float:
    if velocity == 0.0:
        return 0.0
    slowest, fastest = ranges.speed
    pays = slowest + weights.vessel
    if not pays.min() > 0.0:
        return float("inf")
    least = np.clip(0.0, slowest, fastest)  # the smallest |v| of each piece
    top = np.maximum(*(tension(length, ranges.net.high, loop.hanging) for length in ranges.length))
    pull = top - loop.rho * least**2
    largest = float((pull / (2.0 * pays) + 0.5 * loop.rho * (fastest - weights.vessel)).max())
    return (1.0 + ROUNDING) * largest * velocity**2


def start_of(loop: Loop, scenario: Scenario) -> Start:
    """At rest in the initial shape, with ``D^ = 0``: V2 vanishes, and u_a is the slope's alone."""
    motion = top_at(scenario.winch, 0.0)
    length, net = float(motion.length), float(motion.net_gravity(loop.g))
    sigma = np.linspace(0.0, 1.0, 16 * POINTS + 1)
    slope = slope_of_shape(scenario, sigma) / length
    strain = 0.5 * length * np.trapezoid(tension(length * (1.0 - sigma), net, loop.hanging) * slope**2, sigma)
    force = float(signals.evaluate(scenario.environment.payload_force, 0.0))
    return Start(float(strain), float(loop.beta * slope[-1]), force)


def lyapunov_of(loop: Loop, weights: Weights, start: Start) -> float:
    """V at the start, J."""
    of_force = 0.0 if loop.k_s is None else start.missed**2 / (loop.k_s * loop.vs)
    return start.cable + 0.5 * weights.boundary * (loop.m * start.error**2 + of_force)


def reach_of(loop: Loop, ranges: Ranges, weights: Weights, sigma: float) -> float:
    """Bound of ``|y - e|/sqrt(V)`` at ``x = sigma l``, m/sqrt(J), the largest over the run.

    ``V1 + V2 >= 1/2 int (T - rho Q^2) p^2``, what is left when W is chosen worst, and by Cauchy and Schwarz
    ``(y - e)^2 <= int p^2 (T - rho Q^2) int 1/(T - rho Q^2)``. In each piece of time T is taken smallest and Q
    largest; one over what is concave is convex, so the trapezoid rule errs upward.
    """
    share = np.linspace(0.0, sigma, POINTS + 1)
    shortest, longest, lightest = (part.ravel()[:, None] for part in (*ranges.length, ranges.net.low))
    above = 1.0 - share
    pull = np.minimum(*(tension(above * length, lightest, loop.hanging) for length in (shortest, longest)))
    reach = weights.vessel + weights.cross * share * longest
    left = (1.0 - ROUNDING) * pull - (1.0 + ROUNDING) * loop.rho * reach**2
    if not left.min() > 0.0:
        return float("inf")
    integral = longest.ravel() * np.trapezoid(1.0 / left, share, axis=1)
    return (1.0 + ROUNDING) * float(np.sqrt(2.0 * integral.max()))


def bound(certificate: Certificate, t: np.ndarray, start: float | None = None) -> np.ndarray:
    """Certified bound of V at increasing instants of the run, J, shape of ``t``.

    Between two instants V decays at the slab's rate towards the residual. At a jump of the tension V may grow by
    ``certificate.stretch``, at one of the force on the ROV its root by ``sqrt(eta/(2 k_s vs)) |jump|``.

    Args:
        certificate: from :func:`umbilical.certify`.
        t: instants, s, increasing, shape (samples,).
        start: V at the start, J; that of the scenario if left out.

    >>> import umbilical
    >>> certificate = umbilical.certify(umbilical.load("ringdown", {"control.law.slope_gain": 5.0}))
    >>> bound(certificate, np.array([0.0, 60.0]), start=1.0).round(2).tolist()
    [1.0, 0.47]
    """
    loop, instants = certificate.loop, np.asarray(t, dtype=np.float64)
    value = lyapunov_of(loop, certificate.weights, certificate.start) if start is None else start
    scale = 0.0 if loop.k_s is None else float(np.sqrt(certificate.weights.boundary / (2.0 * loop.k_s * loop.vs)))
    steps = {at: scale * size for at, size in certificate.loads.force_jumps}
    grid = np.union1d([0.0], np.concatenate([instants, certificate.edges, list(steps)]))
    stretch = dict(zip(certificate.edges.tolist(), certificate.stretch.tolist(), strict=True))

    def jump(at: float, value: float) -> float:
        return (np.sqrt(value * stretch.get(at, 1.0)) + steps.get(at, 0.0)) ** 2

    values = np.array([value, *advance_bound(certificate, grid, certificate.residual, value, jump)])
    return values[np.searchsorted(grid, instants)]


def advance_bound(
    certificate: Certificate, grid: np.ndarray, power: float | np.ndarray, value: float,
    jump: Callable[[float, float], float],
) -> Iterator[float]:  # fmt: skip
    """The end of each step of a grid from 0: the solution of ``V' = -(th - spent) V + power``, power held, then a jump.

    Args:
        certificate: its rates; every edge of a slab lies on the grid.
        grid: instants, s.
        power: W, one for all steps or one for each.
        value: V at the start, J.
        jump: V just after an instant from the instant and V just before it.
    """
    slab = np.searchsorted(certificate.edges, grid[:-1], side="right") - 1
    rate, dt = certificate.rates[np.clip(slab, 0, certificate.rates.size - 1)] - certificate.spent, np.diff(grid)
    gained = power * np.where(rate == 0.0, dt, -np.expm1(-rate * dt) / np.where(rate == 0.0, 1.0, rate))
    for end, left, more in zip(grid[1:].tolist(), np.exp(-rate * dt).tolist(), gained.tolist(), strict=True):
        value = jump(end, value * left + more)
        yield value
