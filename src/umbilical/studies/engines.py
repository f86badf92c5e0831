"""Who does the work: threads, processes or a Dask cluster, behind one contract.

An engine takes the draws and the members to run, and yields their rows in any order. What is in a row does not depend
on who made it. Never more than a few members are under way, so memory does not grow with their number.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from functools import lru_cache
from itertools import chain, islice
from typing import TypeVar

from umbilical.errors import ControllerError
from umbilical.studies.members import Draws, Member
from umbilical.studies.rows import Row, run_member

Engine = Callable[[Draws, Iterable[Member]], Iterator[Row]]
Work = TypeVar("Work")
Done = TypeVar("Done")
_LIVES = 5
"""Times a pool of processes is started anew after one of them was killed."""


def default_jobs() -> int:
    """Cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def threads(jobs: int) -> Engine:
    """Threads of this process: the compiled loop runs without the GIL, and nothing is copied."""

    def run(draws: Draws, members: Iterable[Member]) -> Iterator[Row]:
        with ThreadPoolExecutor(jobs) as pool:
            yield from in_pool(pool, lambda member: run_member(draws, member), members, 2 * jobs)

    return run


def processes(jobs: int) -> Engine:
    """Processes of this machine: for controllers in Python, which hold the GIL. A killed one is replaced."""

    def run(draws: Draws, members: Iterable[Member]) -> Iterator[Row]:
        packed, coming, begun = pickle.dumps(draws.study), iter(members), dict[int, Member]()
        for life in range(_LIVES):
            try:
                for row in _one_pool(jobs, packed, _noted(chain(list(begun.values()), coming), begun)):
                    del begun[row.number]
                    yield row
                return
            except BrokenProcessPool as error:
                if life + 1 == _LIVES:
                    raise ControllerError(f"worker processes died {_LIVES} times; is there memory for them?") from error

    return run


def _noted(members: Iterable[Member], begun: dict[int, Member]) -> Iterator[Member]:
    """The members one by one, each noted when it is taken."""
    for member in members:
        begun[member.number] = member
        yield member


def _one_pool(jobs: int, packed: bytes, members: Iterable[Member]) -> Iterator[Row]:
    with worker_processes(jobs) as pool:
        yield from in_pool(pool, _Packed(packed), members, 2 * jobs)


def worker_processes(jobs: int) -> ProcessPoolExecutor:
    """Fresh processes (a fork would inherit our threads' locks), which end when this one does."""
    from multiprocessing import get_context

    return ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), initializer=_end_with_the_parent)


def in_pool(pool: Executor, function: Callable[[Work], Done], items: Iterable[Work], window: int) -> Iterator[Done]:
    """Results of a function in any order, with at most ``window`` calls under way."""
    waiting = iter(items)
    running: set[Future[Done]] = {pool.submit(function, item) for item in islice(waiting, window)}
    try:
        while running:
            done, running = wait(running, return_when=FIRST_COMPLETED)
            running |= {pool.submit(function, item) for item in islice(waiting, len(done))}
            for future in done:
                yield future.result()
    finally:
        for future in running:
            future.cancel()


def in_order(
    function: Callable[[Work], Done],
    items: Sequence[Work],
    progress: Callable[[float], None] | None = None,
    jobs: int | None = None,
) -> list[Done]:
    """Results of a function in the order of the items, by threads; ``progress`` is called with the share done.

    >>> in_order(abs, [-1, 2, -3])
    [1, 2, 3]
    """
    found = []
    with ThreadPoolExecutor(jobs or default_jobs()) as pool:
        futures = [pool.submit(function, item) for item in items]
        try:
            for future in futures:
                found.append(future.result())
                if progress:
                    progress(len(found) / len(futures))
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise
    return found


class _Packed:
    """Runs a member in another process; its study travels as bytes and is unpacked once."""

    def __init__(self, packed: bytes) -> None:
        self._packed = packed

    def __call__(self, member: Member) -> Row:
        return run_packed(self._packed, member)


def run_packed(packed: bytes, member: Member) -> Row:
    """Run a member of a pickled study."""
    return run_member(_unpacked(packed), member)


@lru_cache(maxsize=4)
def _unpacked(packed: bytes) -> Draws:
    return Draws(pickle.loads(packed))


def _end_with_the_parent() -> None:
    """A worker whose parent was killed would wait for work for ever."""
    from multiprocessing import parent_process
    from threading import Thread

    parent = parent_process()
    if parent is not None:
        Thread(target=lambda: (parent.join(), os._exit(1)), daemon=True).start()
