"""Solvers that share nothing with the engine: closed forms, characteristics, high-order integrations, MoorDyn.

numpy, scipy and mpmath only, and nothing of this package. They judge the simulator and are never used by it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


class CaseError(Exception):
    """A case could not be carried through: a run that did not complete, a reference that failed."""


def integrated(rates: Callable[..., Any], start: Any, times: np.ndarray, **options: Any) -> np.ndarray:
    """Integrate ordinary differential equations by scipy; states at ``times``, shape (states, times).

    Raises:
        CaseError: scipy gave up, or the state is not finite.
    """
    found = solve_ivp(rates, (float(times[0]), float(times[-1])), start, t_eval=times, **options)
    if not (found.success and np.isfinite(found.y).all()):
        raise CaseError(f"the reference failed: {found.message}")
    return found.y


def roots(function: Callable[[float], float], grid: np.ndarray, count: int) -> np.ndarray:
    """The first roots of a function that changes its sign between points of a grid, to round-off."""
    values = np.array([function(x) for x in grid])
    places = np.flatnonzero(values[:-1] * values[1:] < 0.0)[:count]
    found: list[Any] = [brentq(function, grid[k], grid[k + 1], xtol=1e-15) for k in places]
    return np.array(found)
