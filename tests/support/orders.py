"""Observed orders of convergence."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def orders(errors: Sequence[float]) -> np.ndarray:
    """Order between each grid and the next, twice as fine."""
    values = np.asarray(errors)
    return np.log2(values[:-1] / values[1:])
