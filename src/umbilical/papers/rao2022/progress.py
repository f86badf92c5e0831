"""Progress of a work in parts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import accumulate

Progress = Callable[[float], None]


def parts(progress: Progress | None, shares: Sequence[float]) -> list[Progress]:
    """One progress for each part of a work, given the parts' shares of it.

    >>> seen = []
    >>> first, second = parts(seen.append, [1.0, 3.0])
    >>> first(0.5), second(1.0), seen
    (None, None, [0.125, 1.0])
    """
    total, begins = sum(shares), accumulate(shares, initial=0.0)
    pairs = zip(begins, shares, strict=False)
    return [partial(_advance, progress, begin / total, share / total) for begin, share in pairs]


def _advance(progress: Progress | None, begin: float, share: float, done: float) -> None:
    if progress:
        progress(begin + share * done)
