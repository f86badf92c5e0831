"""The error of a motor's inner loop in continuous time: what Theorem 2 speaks about.

With ``e1 = z1 - w_d`` and ``e2 = z2 - i_d``, (49), (52), (56) and (60) make, whatever speed is wanted::

    e1' = -k1 e1 + e2 - db1 mu S(e1, e0) + r1        S(e, w) = e/sqrt(e^2 + w^2)
    e2' = -k2 e2 - e1 - db2 mu S(e2, e02) + r2

where r1 is the torque disturbance ``f13 d1`` and r2 what is left of ``f23 d2`` less its estimate and of d1 in (59).
A test compares these two lines with the motor under :func:`umbilical.control.motor.backstepping.backstepping_drive`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from umbilical.scenario.control import MotorLoop

Rate = Callable[[float, np.ndarray], np.ndarray]
START = (1.0, 0.0)
"""Errors e1 (rad/s) and e2 (rad/s2) a decay starts from."""
DECADES = 8
"""Powers of ten of e1 over which a decay is followed."""
HORIZON = 10.0
"""s, after which a decay is given up."""
TRIED = np.geomspace(1e-8, 1e4, 4001)
"""Errors at which a supremum is looked for; 0.7 per cent apart."""


def smoothed(e: float, width: float) -> float:
    """S(e, w) of (51)."""
    return e / float(np.sqrt(e * e + width * width))


def error_rate(loop: MotorLoop, t: float, e: np.ndarray, left: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Rates of (e1, e2) under the law with smooth robust terms; ``left`` is (r1, r2)."""
    robust1 = loop.speed_bound * loop.robust_factor * smoothed(e[0], loop.speed_width)
    robust2 = loop.current_bound * loop.robust_factor * smoothed(e[1], loop.current_width)
    return np.array(
        [
            -loop.speed_gain * e[0] + e[1] - robust1 + left[0],
            -loop.current_gain * e[1] - e[0] - robust2 + left[1],
        ]
    )


def decade_times(rate: Rate, start: tuple[float, float] = START, decades: int = DECADES) -> np.ndarray:
    """Time each further decade of |e1| takes, s, shape (decades,); infinite where it is not reached.

    A finite settling time needs these times to sum to a finite value over infinitely many decades, so they must
    shrink; where each takes as long as the one before, the decay is exponential.
    """
    from scipy.integrate import solve_ivp

    levels = start[0] * 10.0 ** -np.arange(1, decades + 1)
    events = [partial(_above, level=level) for level in levels]
    setattr(events[-1], "terminal", True)  # noqa: B010  # scipy's way to stop at an event
    found = solve_ivp(rate, (0.0, HORIZON), start, method="Radau", rtol=1e-8, atol=1e-14, events=events)
    reached = np.array([times[0] if len(times) else np.inf for times in found.t_events])
    with np.errstate(invalid="ignore"):
        steps = np.diff(np.concatenate([[0.0], reached]))
    return np.where(np.isfinite(steps), steps, np.inf)


def _above(t: float, e: np.ndarray, level: float) -> float:
    return abs(float(e[0])) - level


def sign_time(loop: MotorLoop, start: float = START[0]) -> float:
    """Time to e1 = 0 with the sign of (50) instead of (51), e2 = 0: ``ln(1 + k1 |e1|/db1)/k1``, s."""
    return float(np.log1p(loop.speed_gain * start / loop.speed_bound) / loop.speed_gain)


def ultimate_bound(loop: MotorLoop, left: tuple[float, float]) -> float:
    """Bound of \\|e1\\| that holds in the end, rad/s, for disturbances within ``left`` = (sup |r1|, sup |r2|).

    V = (e1^2 + e2^2)/2 has ``V' <= -k V + G`` with ``k`` the smaller of k1 and k2 and, for each of the two errors,
    ``G_i = max_e (r_i e - db_i mu e^2/sqrt(e^2 + w_i^2) - (k_i - k/2) e^2)``; so V ends below G/k.
    """
    slowest = min(loop.speed_gain, loop.current_gain)
    terms = (
        (loop.speed_gain, loop.speed_bound, loop.speed_width, left[0]),
        (loop.current_gain, loop.current_bound, loop.current_width, left[1]),
    )
    gained = sum(_gained(k - 0.5 * slowest, bound * loop.robust_factor, width, r) for k, bound, width, r in terms)
    return float(np.sqrt(2.0 * gained / slowest))


def _gained(gain: float, robust: float, width: float, left: float) -> float:
    e = TRIED
    return max(float((left * e - robust * e * e / np.sqrt(e * e + width * width) - gain * e * e).max()), 0.0)


def premise_band(loop: MotorLoop) -> float:
    """|e1| below which the premise of (55), ``mu |e1|/sqrt(e1^2 + e0^2) >= 1``, is false, rad/s."""
    return loop.speed_width / float(np.sqrt(loop.robust_factor**2 - 1.0))
