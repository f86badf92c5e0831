"""Adams-Bashforth and Adams-Moulton weights of order 1 to 3, and the largest step they allow on the cable.

Source: Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, III.1.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from umbilical.plant.elements import upwind_spectrum

EXPLICIT = np.array([[1.0, 0.0, 0.0], [3 / 2, -1 / 2, 0.0], [23 / 12, -16 / 12, 5 / 12]])
"""Row k: weights of the present rate and the two before it, when k rates before the present one are known."""
IMPLICIT = np.array([[1 / 2, 1 / 2, 0.0], [5 / 12, 8 / 12, -1 / 12]])
"""Row k: weights of a force at the end of the step, at its start, and one step before, when k before are known."""
KNOWN = EXPLICIT.shape[0] - 1
"""Rates before the present one that the highest order needs."""


def amplification(product: np.ndarray) -> np.ndarray:
    """Largest |z| of ``x_(k+1) = z x_k`` for order 3 and products of step and eigenvalue, same shape.

    The roots of ``z^3 = (1 + 23 q/12) z^2 - 16 q/12 z + 5 q/12``.

    >>> amplification(np.array([-0.5, 0.7j, 0.75j])) <= 1.0
    array([ True,  True, False])
    """
    q = np.asarray(product, dtype=complex)
    companion = np.zeros((*q.shape, 3, 3), dtype=complex)
    companion[..., 0, :] = q[..., None] * EXPLICIT[2]
    companion[..., 0, 0] += 1.0
    companion[..., 1, 0] = companion[..., 2, 1] = 1.0
    return np.abs(np.linalg.eigvals(companion)).max(axis=-1)


@cache
def courant_limit() -> float:
    """Largest step times wave speed over element length for which no wave of the grid grows."""
    spectrum = upwind_spectrum(phases=90)
    low, high = 0.0, 1.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        growing = spectrum[amplification(middle * spectrum) > 1.0 + 1e-9]
        if growing.size:  # the others do not grow at smaller steps either
            high, spectrum = middle, growing
        else:
            low = middle
    return low


DECAY_LIMIT = 6 / 11
"""Largest step times rate of a decay for which order 3 is stable."""
