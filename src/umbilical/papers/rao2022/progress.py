"""Progress of a work in parts."""

from __future__ import annotations

from collections.abc import Callable, Sequence

Progress = Callable[[float], None]


def parts(progress: Progress | None, shares: Sequence[float]) -> list[Progress]:
    """One progress for each part of a work, given the parts' shares of it.

    >>> seen = []
    >>> first, second = parts(seen.append, [1.0, 3.0])
    >>> first(0.5), second(1.0), seen
    (None, None, [0.125, 1.0])
    """
    total, begin, found = sum(shares), 0.0, []
    for share in shares:
        found.append(_part(progress, begin / total, share / total))
        begin += share
    return found


def _part(progress: Progress | None, begin: float, share: float) -> Progress:
    def advance(done: float) -> None:
        if progress:
            progress(begin + share * done)

    return advance
