"""News about work that takes time, on stderr."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import TYPE_CHECKING

from umbilical.cli.terminal import printable, report

if TYPE_CHECKING:
    from umbilical.control.contract import Controller
    from umbilical.run import Run
    from umbilical.scenario import Scenario

PATIENCE = 1.0
"""Seconds for which nobody needs a bar."""
PATIENCE_IN_LOGS = 10.0
"""Seconds before the first line where there is no terminal; the time to each next line doubles."""


@contextmanager
def bar(what: str) -> Iterator[Callable[[float], None]]:
    """A function that takes the share done, 0 to 1, and shows it on stderr: a bar on a terminal, lines elsewhere."""
    terminal = sys.stderr is not None and sys.stderr.isatty()
    shown = _Later(_Bar, PATIENCE) if terminal else _Later(_Lines, PATIENCE_IN_LOGS)
    try:
        yield lambda share: shown.move(what, share)
    finally:
        shown.close()


class _Later:
    """A display that is made when work has taken longer than somebody's patience."""

    def __init__(self, display: type[_Bar] | type[_Lines], patience: float) -> None:
        self._display, self._patience, self._begun = display, patience, perf_counter()
        self._made: _Bar | _Lines | None = None

    def move(self, what: str, share: float) -> None:
        passed = perf_counter() - self._begun
        if self._made is None and passed > self._patience:
            self._made = self._display(what)
        if self._made:
            self._made.move(share, passed)

    def close(self) -> None:
        if self._made:
            self._made.close()


class _Lines:
    """Lines for a log: one at once, and one whenever the time passed has doubled."""

    def __init__(self, what: str) -> None:
        self._what, self._next = what, 0.0

    def move(self, share: float, passed: float) -> None:
        if passed >= self._next:
            self._next = 2.0 * passed
            report(f"{self._what}: {share:.0%} after {passed:.0f} s")

    def close(self) -> None:
        pass


class _Bar:
    """A bar for a terminal."""

    def __init__(self, what: str) -> None:
        from rich.console import Console
        from rich.markup import escape
        from rich.progress import Progress

        self._progress = Progress(console=Console(stderr=True), transient=True)
        self._task = self._progress.add_task(escape(printable(what)), total=1.0)
        self._progress.start()

    def move(self, share: float, passed: float) -> None:
        self._progress.update(self._task, completed=share)

    def close(self) -> None:
        self._progress.stop()


def announce_compilation(scenario: Scenario | None = None) -> None:
    """Say so if the kernels, of a scenario's run, are about to be compiled."""
    from umbilical.compile import announce
    from umbilical.engine.setup import loop_of

    announce(*[loop_of(scenario)] if scenario else [])


def simulate_visibly(scenario: Scenario, controller: Controller | None = None) -> Run:
    """Simulate with news on stderr."""
    from umbilical.engine.simulate import simulate

    with bar(f"simulating {scenario.duration:g} s") as advance:
        return simulate(scenario, controller, progress=advance)
