"""A sharper bound of V1 + V2, because the law does not feel the cable: u_a first, then the cable under it.

``m u_a' = -k_a u_a + D~``, ``D~' = -k_s (D~ + vs u_a) + D'`` has two poles of its own, much faster than the cable. V
mixes both and lets loads at the ROV act for as long as the cable rings; bounding u_a alone and feeding it to

    (V1 + V2)' <= -(th - spent)(V1 + V2) + T_l/(2 beta) u_a^2 + residual of the cable

does not. The rates are the proved ones; in each step u_a and T_l are held at what they cannot exceed in it.
"""

from __future__ import annotations

import numpy as np

from umbilical.certificate.bounds import advance_bound
from umbilical.certificate.loads import Loads
from umbilical.certificate.records import Certificate, Start
from umbilical.certificate.setting import Loop
from umbilical.relations.tension import tension

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
    grid = np.union1d(instants_of(certificate), t)
    slab = np.searchsorted(certificate.edges, grid[:-1], side="right") - 1
    pull = tension(0.0, certificate.ranges.net.high.max(axis=1)[slab], loop.hanging)
    fed = pull / (2.0 * loop.beta) * error_bound(loop, grid, begin, certificate.loads) ** 2
    stretch = dict(zip(certificate.edges.tolist(), certificate.stretch.tolist(), strict=True))
    steps = advance_bound(
        certificate, grid, fed + certificate.cable_residual, begin.cable, lambda at, v: v * stretch.get(at, 1.0)
    )
    return np.array([begin.cable, *steps])[np.searchsorted(grid, t)]


def instants_of(certificate: Certificate) -> np.ndarray:
    """The steps of the bound, s: between them it has no turning point. Every jump of winch and force is among them."""
    loop, duration = certificate.loop, float(certificate.edges[-1])
    fastest = loop.k_a / loop.m + (loop.k_s or 0.0)
    count = int(np.clip(STEPS_PER_TIME * fastest * duration, FEWEST, MOST))
    jumps = [instant for instant, _ in certificate.loads.force_jumps if 0.0 < instant < duration]
    return np.unique(np.concatenate([np.linspace(0.0, duration, count + 1), certificate.edges, jumps]))


def error_bound(loop: Loop, t: np.ndarray, start: Start, loads: Loads) -> np.ndarray:
    """Bound of |u_a| over each step of a grid from 0, m/s, shape (steps,); jumps of the force lie on the grid."""
    if loop.k_s is None:
        fade = np.exp(-2.0 * loop.k_a / loop.m * t)  # all of k_a: loop.k_a is the half that is left to V
        level = fade * abs(start.error) + (1.0 - fade) * loads.force / (2.0 * loop.k_a)
        return np.maximum(level[:-1], level[1:])
    ends, bulge = _ends_and_bulge(loop, t, 0.0, 1.0)
    area = np.cumsum(np.diff(t) * (0.5 * (ends[:-1] + ends[1:]) + bulge * 2.0 / 3.0))
    bound = _largest(loop, t, start.error, start.missed) + area * loads.force_rate
    for instant, size in loads.force_jumps:
        if 0.0 < instant < t[-1]:
            first = int(np.searchsorted(t, instant))
            bound[first:] += _largest(loop, t[first:] - instant, 0.0, size)
    return bound


def _largest(loop: Loop, t: np.ndarray, error: float, missed: float) -> np.ndarray:
    """Bound of |u_a| over each step after a start of u_a, m/s, and D~, N, shape (steps,)."""
    ends, bulge = _ends_and_bulge(loop, t, error, missed)
    return np.maximum(ends[:-1], ends[1:]) + bulge


def _ends_and_bulge(loop: Loop, t: np.ndarray, error: float, missed: float) -> tuple[np.ndarray, np.ndarray]:
    """|u_a| at all ends of steps, and by how much it may exceed the line between two of them: ``h^2/8 sup |u_a''|``."""
    of_error, of_missed = responses(loop, t)
    curved = np.minimum(_curvature_by_length(loop, t[:-1], error, missed), _curvature(loop, t[:-1], error, missed))
    return abs(of_error * error + of_missed * missed), np.diff(t) ** 2 / 8.0 * curved


def _curvature(loop: Loop, t: np.ndarray, error: float, missed: float) -> np.ndarray:
    """Bound of |u_a''| from t on, m/s3, mode by mode; without a bound where the two are the same."""
    mean, spread = _poles(loop)
    with np.errstate(divide="ignore", invalid="ignore"):
        apart = ((-loop.k_a / loop.m - mean) * error + missed / loop.m) / (2.0 * spread)
        parts = [
            abs(0.5 * error + sign * apart) * abs(mean + sign * spread) ** 2 * np.exp((mean + sign * spread).real * t)
            for sign in (1.0, -1.0)
        ]
    return np.nan_to_num(parts[0] + parts[1], nan=np.inf, posinf=np.inf)


def _curvature_by_length(loop: Loop, t: np.ndarray, error: float, missed: float) -> np.ndarray:
    """The same for any modes: with D~ in the unit ``sqrt(k_s vs m)`` the law is ``z' = A z``, A its two rates and a
    turn, so the length of z decays at the smaller rate, and ``|u_a''| <= |A|^2 |z|``."""
    assert loop.k_s is not None
    rates, turn = (loop.k_a / loop.m, loop.k_s), np.sqrt(loop.k_s * loop.vs / loop.m)
    length = np.hypot(error, missed / np.sqrt(loop.k_s * loop.vs * loop.m))
    return (max(rates) + turn) ** 2 * length * np.exp(-min(rates) * t)


def responses(loop: Loop, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """u_a at t after a unit start of u_a, and after one of D~ (m/s per N): the first row of ``exp(A t)``."""
    mean, spread = _poles(loop)
    fast, slow = np.exp((mean - spread) * t), np.exp((mean + spread) * t)
    apart = abs(spread) > 1e-9 * abs(mean)
    ramp = (slow - fast) / (2.0 * spread) if apart else t * slow
    return (0.5 * (slow + fast) + (-loop.k_a / loop.m - mean) * ramp).real, (ramp / loop.m).real


def _poles(loop: Loop) -> tuple[float, np.complex128]:
    """Mean of the law's two poles, 1/s, and half of their distance."""
    assert loop.k_s is not None
    a, d = -loop.k_a / loop.m, -loop.k_s
    return 0.5 * (a + d), np.sqrt(np.complex128(0.25 * (a - d) ** 2 - loop.k_s * loop.vs / loop.m))
