"""News about work that takes time, on stderr."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
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
    begun = perf_counter()
    with ExitStack() as stack:
        terminal = sys.stderr is not None and sys.stderr.isatty()
        show = _bar(what, stack) if terminal else _lines(what)
        yield lambda share: show(share, perf_counter() - begun)


def _lines(what: str) -> Callable[[float, float], None]:
    """Lines for a log: one after a while, and one whenever the time passed has doubled."""
    due = PATIENCE_IN_LOGS

    def show(share: float, passed: float) -> None:
        nonlocal due
        if passed >= due:
            due = 2.0 * passed
            report(f"{what}: {share:.0%} after {passed:.0f} s")

    return show


def _bar(what: str, stack: ExitStack) -> Callable[[float, float], None]:
    """A bar for a terminal, made when the work has taken longer than somebody's patience."""
    update: Callable[..., None] | None = None

    def show(share: float, passed: float) -> None:
        nonlocal update
        if update is None and passed > PATIENCE:
            from rich.console import Console
            from rich.markup import escape
            from rich.progress import Progress

            progress = stack.enter_context(Progress(console=Console(stderr=True), transient=True))
            update = partial(progress.update, progress.add_task(escape(printable(what)), total=1.0))
        if update is not None:
            update(completed=share)

    return show


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
