"""Instants that round-off may have touched: the one place that compares them, counts them and tells them apart."""

from __future__ import annotations

from math import ceil
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

ROUND_OFF = 1e-9
"""Share of a span (of a run, of a value counted in periods) that sums and quotients of floats may be off by."""
_SAME = 1e-12
_MOST = 1e15
_DIGITS = range(6, 18)


def is_multiple(value: float, of: float) -> bool:
    """Whether ``value`` is a whole number of ``of``, at least one, to nine digits.

    >>> is_multiple(0.3, 0.1), is_multiple(0.30001, 0.1)
    (True, False)
    """
    count = nearest_count(value, of)
    return count >= 1 and abs(value - count * of) <= ROUND_OFF * value


def nearest_count(value: float, of: float) -> int:
    """How often ``of`` goes into ``value``, rounded.

    >>> nearest_count(0.3, 0.1)
    3
    """
    return round(min(value / of, _MOST))


def count_up(value: float, of: float) -> int:
    """How many of ``of`` reach ``value``; not one more because round-off left the last one short.

    >>> count_up(0.3, 0.1), count_up(0.31, 0.1)
    (3, 4)
    """
    quotient = min(value / of, _MOST)
    return ceil(quotient - max(ROUND_OFF, _SAME * quotient))


def reaches(value: float, goal: float, span: float) -> bool:
    """Whether ``value`` is at or beyond ``goal``, but for the round-off of a span.

    >>> reaches(19.999999999999972, 20.0, 20.0), reaches(19.99, 20.0, 20.0)
    (True, False)
    """
    return value >= goal - ROUND_OFF * span


def slack(instant: ArrayLike) -> Any:
    """Difference below which an instant is the same one, s; a number, or an array of the shape of ``instant``.

    >>> bool(0.1 + 0.2 - 0.3 < slack(0.3) < 1e-11)
    True
    """
    return _SAME * np.maximum(1.0, np.abs(instant))


def apart(*values: float) -> tuple[str, ...]:
    """Numbers with six digits, or with as many as it takes that those which differ look different.

    >>> apart(19.99999, 20.0), apart(0.25, 20.0)
    (('19.99999', '20'), ('0.25', '20'))
    """
    different = len(set(values))
    texts: tuple[str, ...] = ()
    for digits in _DIGITS:
        texts = tuple(f"{value + 0.0:.{digits}g}" for value in values)  # no -0, which equals 0
        if len(set(texts)) == different:
            break
    return texts
