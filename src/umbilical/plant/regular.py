"""Sums of regular waves over arrays of time, and their derivatives: tabulated in blocks, so that many cost as few.

Between instants :data:`STEP` apart the curve is the quintic that has value, slope and curvature of the sum at both:
w^6 h^6/46080 of the amplitude is what it misses, 1e-7 at 4 rad/s.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from umbilical.scenario.signals import Waves

STEP = 0.1
"""s."""
_BLOCK, _KEPT = 512, 64
_HIGHEST = 5


def waves(term: Waves, t: np.ndarray, order: int = 0) -> np.ndarray:
    """The derivative of an order from 0 to 3 of a sum of waves, same shape as the instants ``t``, s."""
    known: Any = term  # frozen records have a hash, which type checkers cannot see
    return _tables(known).at(np.asarray(t, dtype=float), order)


@lru_cache(maxsize=16)
def _tables(term: Waves) -> _Tables:
    return _Tables(term)


class _Tables:
    """Values and derivatives at the ends of all steps of the blocks that were asked for last."""

    def __init__(self, term: Waves) -> None:
        self._omega = np.array(term.frequencies)
        self._amplitude = np.array(term.amplitudes) * np.exp(1j * np.array(term.phases))
        self._turns = np.exp(1j * np.outer(np.arange(_BLOCK + 1) * STEP, self._omega))
        self._block = lru_cache(_KEPT)(self._tabulate)

    def at(self, t: np.ndarray, order: int) -> np.ndarray:
        flat = t.ravel()
        place = np.floor(flat / STEP).astype(np.int64)
        number, found = place // _BLOCK, np.empty(flat.size)
        for block in np.unique(number):
            here = number == block
            step = place[here] - block * _BLOCK
            rows = self._block(int(block))[:, order : order + 3]
            found[here] = quintic(rows[step], rows[step + 1], flat[here] / STEP - place[here])
        return found.reshape(t.shape)

    def _tabulate(self, number: int) -> np.ndarray:
        """Derivatives 0 to 5 at the instants of a block, shape (instants, 6)."""
        start = self._amplitude * np.exp(1j * self._omega * (number * _BLOCK * STEP))
        powers = (1j * self._omega[:, None]) ** np.arange(_HIGHEST + 1)
        return (self._turns @ (start[:, None] * powers)).real


def quintic(left: np.ndarray, right: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Quintic of value, slope and curvature at both ends, each of the shape (n, 3), at shares of the step."""
    value, slope, curve = left[:, 0], left[:, 1] * STEP, left[:, 2] * STEP**2 / 2.0
    rest = right[:, 0] - value - slope - curve
    slopes = right[:, 1] * STEP - slope - 2.0 * curve
    curves = right[:, 2] * STEP**2 / 2.0 - curve
    third, fourth = 10.0 * rest - 4.0 * slopes + curves, -15.0 * rest + 7.0 * slopes - 2.0 * curves
    fifth = 6.0 * rest - 3.0 * slopes + curves
    return value + share * (slope + share * (curve + share * (third + share * (fourth + share * fifth))))
