"""Observed orders of convergence."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Curve(NamedTuple):
    """Errors over the size of what was refined.

    Attributes:
        name: what the error is of.
        size: what was refined, with its unit.
        sizes: falling, each half of the one before.
        errors: one for each size.
        order: the stated one.
    """

    name: str
    size: str
    sizes: tuple[float, ...]
    errors: tuple[float, ...]
    order: float


def orders(errors: Sequence[float]) -> np.ndarray:
    """Order between each grid and the next, twice as fine.

    >>> orders([1.6, 0.4, 0.1]).tolist()
    [2.0, 2.0]
    """
    values = np.asarray(errors)
    return np.log2(values[:-1] / values[1:])
