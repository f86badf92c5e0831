"""Who does the work: any executor of :mod:`concurrent.futures`; threads and processes of this machine here, a Dask
cluster in ``cluster.py``. What comes back does not depend on who made it, and never more than a few calls are under
way, so memory does not grow with their number.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from itertools import chain, islice
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import Any, TypeVar

from umbilical.errors import ControllerError

Work = TypeVar("Work")
Done = TypeVar("Done")
_LIVES = 5
"""Times a call is made whose process is killed."""


class Pool(Executor):
    """An executor that says how many calls it makes at once, and begins anew when one of its processes was killed.

    Attributes:
        jobs: calls at once.
    """

    def __init__(self, jobs: int, begin: Callable[[], Executor]) -> None:
        self.jobs = jobs
        self._begin, self._pool = begin, begin()

    def submit(self, fn: Callable[..., Done], /, *args: Any, **kwargs: Any) -> Future[Done]:
        """Call a function some time, with these arguments."""
        try:
            return self._pool.submit(fn, *args, **kwargs)
        except BrokenProcessPool:
            self._pool = self._begin()
            return self._pool.submit(fn, *args, **kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Take no more calls."""
        self._pool.shutdown(wait, **({"cancel_futures": True} if cancel_futures else {}))  # Dask knows no such word


def default_jobs() -> int:
    """Cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def threads(jobs: int) -> Pool:
    """Threads of this process: the compiled loop runs without the GIL, and nothing is copied."""
    return Pool(jobs, lambda: ThreadPoolExecutor(jobs))


def processes(jobs: int) -> Pool:
    """Processes of this machine: for controllers in Python, which hold the GIL. A killed one is replaced.

    They are fresh (a fork would inherit our threads' locks), and end when this one does.
    """
    anew = partial(ProcessPoolExecutor, jobs, mp_context=get_context("spawn"), initializer=_end_with_the_parent)
    return Pool(jobs, anew)


def opened(workers: Executor | int | None) -> AbstractContextManager[Executor]:
    """An executor that is given stays open; threads, as many as are asked for or as there are cores, are closed."""
    return nullcontext(workers) if isinstance(workers, Executor) else threads(workers or default_jobs())


def in_any_order(pool: Executor, function: Callable[[Work], Done], items: Iterable[Work]) -> Generator[Done]:
    """Results of a function in any order, with at most two calls for each worker under way.

    What a killed process had is called again.

    Raises:
        ControllerError: the process of one call was killed :data:`_LIVES` times.
    """
    window, waiting = 2 * getattr(pool, "jobs", default_jobs()), ((item, 1) for item in items)
    running: dict[Future[Done], tuple[Work, int]] = {}
    try:
        while True:
            for call in islice(waiting, window - len(running)):
                running[pool.submit(function, call[0])] = call
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                item, life = running.pop(future)
                try:
                    yield future.result()
                except BrokenProcessPool as error:
                    if life == _LIVES:
                        raise ControllerError(
                            f"worker processes died {life} times; is there memory for them?"
                        ) from error
                    waiting = chain([(item, life + 1)], waiting)
    finally:
        for future in running:
            future.cancel()


def in_order(
    function: Callable[[Work], Done],
    items: Sequence[Work],
    progress: Callable[[float], None] | None = None,
    workers: Executor | int | None = None,
) -> list[Done]:
    """Results of a function in the order of the items; ``progress`` is called with the share done.

    Args:
        function: one that can be pickled, where other processes work.
        items: of each, one result.
        progress: called with the share done, 0 to 1.
        workers: an executor, or how many threads; all cores by default.

    >>> in_order(abs, [-1, 2, -3])
    [1, 2, 3]
    """
    found: dict[int, Done] = {}
    with opened(workers) as pool:
        for place, result in in_any_order(pool, partial(_numbered, function), enumerate(items)):
            found[place] = result
            if progress:
                progress(len(found) / len(items))
    return [found[place] for place in range(len(items))]


def _numbered(function: Callable[[Work], Done], item: tuple[int, Work]) -> tuple[int, Done]:
    return item[0], function(item[1])


def _end_with_the_parent() -> None:
    """A worker whose parent was killed would wait for work for ever."""
    if (parent := parent_process()) is not None:
        Thread(target=lambda: (parent.join(), os._exit(1)), daemon=True).start()
