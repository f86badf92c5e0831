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
        sizes: falling.
        errors: one for each size.
        order: the stated one.
    """

    name: str
    size: str
    sizes: tuple[float, ...]
    errors: tuple[float, ...]
    order: float


def orders(errors: Sequence[float], sizes: Sequence[float] | None = None) -> np.ndarray:
    """Order between each grid and the next, which is twice as fine where no ``sizes`` are given.

    >>> orders([1.6, 0.4, 0.1]).tolist(), orders([9.0, 1.0], [3.0, 1.0]).tolist()
    ([2.0, 2.0], [2.0])
    """
    falls = np.log2(np.asarray(errors)[:-1] / np.asarray(errors)[1:])
    return falls if sizes is None else falls / np.log2(np.asarray(sizes)[:-1] / np.asarray(sizes)[1:])
