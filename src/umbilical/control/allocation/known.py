"""Known factors, without fault control: ``U_i = sgn(K_Ti) alpha_c / sum_j |K_Tj|``."""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel


@kernel
def known_demand(coefficients: np.ndarray, thrust: float, demand: np.ndarray) -> None:
    """Demands into ``demand``, rad2/s2, shape (n,); ``coefficients`` are the believed K_T."""
    total = 0.0
    for i in range(coefficients.size):
        total += abs(coefficients[i])
    for i in range(coefficients.size):
        demand[i] = np.sign(coefficients[i]) * thrust / total
