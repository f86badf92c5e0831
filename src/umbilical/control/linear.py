"""Exact discrete forms of linear filters whose input is held over a period."""

from __future__ import annotations

import numpy as np


def held_input_form(a: np.ndarray, b: np.ndarray, period: float) -> np.ndarray:
    """Exact step ``x <- A x + B u`` of ``x' = a x + b u`` for an input held over ``period``.

    Both come from one matrix exponential, ``exp([[a, b], [0, 0]] period)`` (Van Loan, 1978).

    Args:
        a: shape (n, n).
        b: shape (n,).
        period: s.

    Returns:
        A and B side by side, shape (n, n + 1).

    >>> form = held_input_form(np.array([[-2.0]]), np.array([2.0]), 0.5)
    >>> bool(np.allclose(form, [[np.exp(-1.0), 1.0 - np.exp(-1.0)]], rtol=1e-15))
    True
    """
    from scipy.linalg import expm

    n = a.shape[0]
    block = np.zeros((n + 1, n + 1))
    block[:n, :n], block[:n, n] = a, b
    return np.ascontiguousarray(expm(block * period)[:n])
