"""Exact discrete forms of linear filters whose input is held over a period."""

from __future__ import annotations

from functools import lru_cache

import numpy as np


def held_input_form(a: np.ndarray, b: np.ndarray, period: float) -> np.ndarray:
    """Exact step ``x <- A x + B u`` of ``x' = a x + b u`` for an input held over ``period``.

    Both come from one matrix exponential, ``exp([[a, b], [0, 0]] period)`` (Van Loan, 1978).

    Args:
        a: shape (n, n).
        b: shape (n,), or (n, inputs).
        period: s.

    Returns:
        A and B side by side, shape (n, n + inputs).

    >>> form = held_input_form(np.array([[-2.0]]), np.array([2.0]), 0.5)
    >>> bool(np.allclose(form, [[np.exp(-1.0), 1.0 - np.exp(-1.0)]], rtol=1e-15))
    True
    """
    n = a.shape[0]
    block = np.zeros((n + b.size // n, n + b.size // n))
    block[:n, :n], block[:n, n:] = a, b.reshape(n, -1)
    return _exponential((block * period).tobytes(), len(block))[:n].copy()


@lru_cache(maxsize=256)
def _exponential(content: bytes, size: int) -> np.ndarray:
    """Of a square matrix by its bytes: a thousand runs of a study share a few filters, and each takes a millisecond."""
    from scipy.linalg import expm

    return expm(np.frombuffer(content).reshape(size, size))
