"""Many runs on all cores, in order, with progress."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from umbilical.studies.engines import default_jobs

Task = TypeVar("Task")
Result = TypeVar("Result")
Progress = Callable[[float], None]


def in_parallel(
    function: Callable[[Task], Result], tasks: Sequence[Task], progress: Progress | None = None
) -> list[Result]:
    """The results of all tasks, in their order, whatever the number of cores.

    Threads suffice: the compiled loop runs without the GIL. Ctrl-C drops what has not begun.

    Args:
        function: called once for each task.
        tasks: its arguments.
        progress: called with the share done, 0 to 1.

    >>> in_parallel(abs, [-1, 2, -3])
    [1, 2, 3]
    """
    found = []
    with ThreadPoolExecutor(default_jobs()) as pool:
        futures = [pool.submit(function, task) for task in tasks]
        try:
            for future in futures:
                found.append(future.result())
                if progress:
                    progress(len(found) / len(futures))
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise
    return found


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
