"""A sharper bound of V1 + V2, because the law does not feel the cable: u_a first, then the cable under it.

``m u_a' = -k_a u_a + D~``, ``D~' = -k_s (D~ + vs u_a) + D'`` has two poles of its own, much faster than the cable. V
mixes both and lets loads at the ROV act for as long as the cable rings; bounding u_a alone and feeding it to

    (V1 + V2)' <= -(th - spent)(V1 + V2) + T_l/(2 beta) u_a^2 + residual of the cable

does not. The rates are the proved ones; the time integrals here are ordinary arithmetic on a fine grid.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.analysis.certificate.loads import Loads
from umbilical.analysis.certificate.records import Certificate, Start
from umbilical.analysis.certificate.setting import Loop
from umbilical.plant import winch

FEWEST, MOST = 4000, 100_000
STEPS_PER_TIME = 20.0
"""Steps in the shortest time of the law."""


def cable_bound(certificate: Certificate, t: np.ndarray, start: Start | None = None) -> np.ndarray:
    """Bound of V1 + V2 at increasing instants of the run, J, shape of ``t``.

    Args:
        certificate: from :func:`umbilical.certify`.
        t: instants, s, increasing, shape (samples,).
        start: where the run starts; the scenario's own start if left out.
    """
    loop, begin = certificate.loop, certificate.start if start is None else start
    grid = np.unique(np.concatenate([_grid(loop, float(certificate.edges[-1])), certificate.edges]))
    error = error_bound(loop, grid, begin, certificate.loads)
    pull = loop.m * (loop.g - winch.evaluate(certificate.scenario.winch, grid).acceleration)
    power = np.maximum(pull[:-1], pull[1:]) / (2.0 * loop.beta) * np.maximum(error[:-1], error[1:]) ** 2
    values = np.array([begin.cable, *_march(certificate, grid, power + certificate.cable_residual, begin.cable)])
    return np.interp(t, grid, values)


def error_bound(loop: Loop, t: np.ndarray, start: Start, loads: Loads) -> np.ndarray:
    """Bound of |u_a| on an even-spaced or refined grid from 0, m/s, shape of ``t``."""
    if loop.k_s is None:
        fade = np.exp(-2.0 * loop.k_a / loop.m * t)  # all of k_a: loop.k_a is the half that is left to V
        return fade * abs(start.error) + (1.0 - fade) * loads.force / (2.0 * loop.k_a)
    of_error, of_missed = responses(loop, t)
    area = np.concatenate([[0.0], np.cumsum(np.maximum(abs(of_missed[1:]), abs(of_missed[:-1])) * np.diff(t))])
    bound = abs(of_error * start.error + of_missed * start.missed) + area * loads.force_rate
    for instant, size in loads.force_jumps:
        after = t >= instant
        if instant > 0.0:
            bound[after] += abs(responses(loop, t[after] - instant)[1]) * size
    return bound


def responses(loop: Loop, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """u_a at t after a unit start of u_a, and after one of D~ (m/s per N): the first row of ``exp(A t)``."""
    assert loop.k_s is not None
    a, d = -loop.k_a / loop.m, -loop.k_s
    mean, spread = 0.5 * (a + d), np.sqrt(0.25 * (a - d) ** 2 - loop.k_s * loop.vs / loop.m + 0j)
    fast, slow = np.exp((mean - spread) * t), np.exp((mean + spread) * t)
    apart = abs(spread) > 1e-9 * abs(mean)
    ramp = (slow - fast) / (2.0 * spread) if apart else t * slow
    return (0.5 * (slow + fast) + (a - mean) * ramp).real, (ramp / loop.m).real


def _grid(loop: Loop, duration: float) -> np.ndarray:
    fastest = loop.k_a / loop.m + (loop.k_s or 0.0)
    return np.linspace(0.0, duration, int(np.clip(STEPS_PER_TIME * fastest * duration, FEWEST, MOST)) + 1)


def _march(certificate: Certificate, grid: np.ndarray, power: np.ndarray, value: float) -> Iterator[float]:
    """V1 + V2 at the end of each step: the solution for a power that is held over it."""
    slab = np.searchsorted(certificate.edges, grid[:-1], side="right") - 1
    rate, dt = certificate.rates[slab] - certificate.spent, np.diff(grid)
    fade = np.exp(-rate * dt)
    gained = power * np.where(rate == 0.0, dt, -np.expm1(-rate * dt) / np.where(rate == 0.0, 1.0, rate))
    stretch = dict(zip(certificate.edges.tolist(), certificate.stretch.tolist(), strict=True))
    for end, left, more in zip(grid[1:].tolist(), fade.tolist(), gained.tolist(), strict=True):
        value = (value * left + more) * stretch.get(end, 1.0)
        yield value
