"""News about work that takes time, on stderr."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import TYPE_CHECKING

from umbilical.cli.speech import tell

if TYPE_CHECKING:
    from umbilical.run import Run
    from umbilical.scenario import Scenario

PATIENCE = 1.0
"""Seconds for which nobody needs a bar."""
COMPILING = 30
"""Seconds the first compilation took where this was written: an AMD EPYC, one core busy."""


@contextmanager
def bar(what: str) -> Iterator[Callable[[float], None]]:
    """A function that takes the share done, 0 to 1, and shows a bar: on a terminal, after a second."""
    begun = perf_counter()
    shown = []

    def advance(share: float) -> None:
        if not shown and sys.stderr.isatty() and perf_counter() - begun > PATIENCE:
            shown.append(_Bar(what))
        for one in shown:
            one.move(share)

    try:
        yield advance
    finally:
        for one in shown:
            one.close()


class _Bar:
    def __init__(self, what: str) -> None:
        from rich.console import Console
        from rich.progress import Progress

        self._progress = Progress(console=Console(stderr=True), transient=True)
        self._task = self._progress.add_task(what, total=1.0)
        self._progress.start()

    def move(self, share: float) -> None:
        self._progress.update(self._task, completed=share)

    def close(self) -> None:
        self._progress.stop()


def announce_compilation() -> None:
    """Say so if the kernels are about to be compiled."""
    from umbilical.compile import is_warm

    if not is_warm():
        tell(f"compiling the kernels once, about {COMPILING} s; later runs load them from disk")


def simulate_visibly(scenario: Scenario) -> Run:
    """Simulate with news on stderr."""
    from umbilical.engine.simulate import simulate

    announce_compilation()
    with bar(f"simulating {scenario.duration:g} s") as advance:
        return simulate(scenario, progress=advance)
