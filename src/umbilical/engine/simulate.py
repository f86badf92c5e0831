"""From a scenario to a run."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from traceback import extract_tb
from typing import Any, NamedTuple, TypeVar

import numpy as np

from umbilical.control.contract import Controller
from umbilical.engine import loop
from umbilical.engine.base import Model
from umbilical.engine.ending import Ending
from umbilical.engine.episode import Episode
from umbilical.engine.model import make_model
from umbilical.engine.resolution import on_chosen_grid
from umbilical.engine.schedule import end_of_stretch, stretch
from umbilical.errors import ControllerError, expect
from umbilical.library import admit
from umbilical.run import Run, Status
from umbilical.scenario.scenario import Scenario

T = TypeVar("T")


class MeasuredRun(NamedTuple):
    """What :func:`measure` keeps of a run: how it ended, when and why, and its metrics in SI units."""

    status: Status
    reason: str
    end_time: float
    metrics: dict[str, float]


@dataclass
class Common:
    """What need not be done again for a run that others are taken in turns with.

    Attributes:
        samplers: of what acts from outside, one for all runs where that is the same.
        admitted: the last scenario that was.
    """

    samplers: list[Any] = field(default_factory=list)
    admitted: Scenario | None = None


def simulate(
    scenario: Scenario,
    controller: Controller | None = None,
    *,
    progress: Callable[[float], None] | None = None,
) -> Run:
    """Simulate a scenario from start to end.

    Args:
        scenario: what to simulate; checked completely before the first step.
        controller: replaces the scenario's own. Anything with ``period``, ``start`` and ``update``
            (:class:`~umbilical.control.contract.Controller`).
        progress: called now and then with the share of the run that is done, 0 to 1.

    Returns:
        The run. A loop that diverges or is interrupted is a run too, whose ``status`` and ``reason`` say so,
        and the samples up to then are kept.

    Raises:
        ScenarioError: the scenario was refused, with every problem.
        ControllerError: the user's controller raised or broke its contract; ``error.run`` has the samples
            up to then.

    >>> import umbilical
    >>> scenario = umbilical.load("crosscheck-none").replace({"duration": 1.0})
    >>> run = simulate(scenario)
    >>> run.status.name, 0.05 < run.metrics["tip_peak"] < 0.15
    ('COMPLETED', True)
    """
    if controller is not None:
        check_controller(controller)
    chosen, notices = _on_its_grid(scenario, controller, progress)
    return _simulate(chosen, controller, progress).with_notices(notices)


def _on_its_grid(
    scenario: Scenario, controller: Controller | None, progress: Callable[[float], None] | None = None
) -> tuple[Scenario, tuple[str, ...]]:
    """The scenario on the grid it asks for, where it asks for one that a run chooses."""
    expect(scenario, "Scenario", "load")
    if scenario.grid.tolerance is None:
        return scenario, ()
    return on_chosen_grid(scenario, lambda fixed: _measure(fixed, controller), progress)


def _simulate(scenario: Scenario, controller: Controller | None, progress: Callable[[float], None] | None) -> Run:
    if controller is not None:
        episode = Episode(scenario, controller.period, owner=type(controller).__name__)
        error = follow(episode, controller, progress)
        run = episode.finish()
        if error is not None:
            error.run = run
            raise error
        return run
    begun = perf_counter()
    notices = tuple(str(notice) for notice in admit(scenario))
    model = make_model(scenario)
    prepared = perf_counter()
    ending, sampling = _whole(_run(scenario, model, progress))
    simulated = perf_counter()
    timing = {"prepare_s": prepared - begun, "simulate_s": simulated - prepared, "outside_s": sampling}
    return model.assemble(ending, (*notices, *model.notices()), timing)


def check_controller(controller: object) -> None:
    """Refuse what is no controller before it is asked anything.

    Raises:
        ControllerError: a class instead of an object of it, or something without ``period``, ``start`` and ``update``.
    """
    name = controller.__name__ if isinstance(controller, type) else type(controller).__name__
    missing = [part for part in ("period", "start", "update") if not hasattr(controller, part)]
    if missing:
        raise ControllerError(f"{name} is no controller: it has no {' and no '.join(missing)}")
    if isinstance(controller, type):
        raise ControllerError(f"{name} is a class; the controller is an object of it, such as {name}()")


def measure(scenario: Scenario, controller: Controller | None = None) -> MeasuredRun:
    """Simulate for the metrics alone: the same numbers as :func:`simulate`, without storing or labelling a sample.

    What is read from stored fields, the power balance, is left out.

    Raises:
        ScenarioError, ControllerError: as :func:`simulate`.

    >>> import umbilical
    >>> scenario = umbilical.load("crosscheck-none").replace({"duration": 1.0})
    >>> measure(scenario).metrics["tip_peak"] == simulate(scenario).metrics["tip_peak"]
    True
    """
    return _whole(measuring(scenario, controller))


def measuring(
    scenario: Scenario, controller: Controller | None = None, common: Common | None = None
) -> Generator[None, None, MeasuredRun]:
    """Do :func:`measure` piece by piece, and return what it does.

    Args:
        scenario, controller: as there.
        common: one for all runs that are taken in turns.
    """
    return (yield from _measuring(_on_its_grid(scenario, controller)[0], controller, common or Common()))


def in_turns(runs: Sequence[Generator[None, None, T]]) -> list[T]:
    """Take a piece of each, again and again; what they return, in their order."""
    found: dict[int, T] = {}
    while len(found) < len(runs):
        for number, run in enumerate(runs):
            if number not in found:
                try:
                    next(run)
                except StopIteration as end:
                    found[number] = end.value
    return [found[number] for number in range(len(runs))]


def _whole(run: Generator[None, None, T]) -> T:
    return in_turns([run])[0]


def _measure(scenario: Scenario, controller: Controller | None) -> MeasuredRun:
    return _whole(_measuring(scenario, controller, Common()))


def _measuring(scenario: Scenario, controller: Controller | None, common: Common) -> Generator[None, None, MeasuredRun]:
    if controller is not None:
        episode = Episode(scenario, controller.period, stored=False, owner=type(controller).__name__)
        if (error := follow(episode, controller)) is not None:
            raise error
        ending = episode.end()
        return MeasuredRun(ending.status, ending.reason, ending.time, episode.metrics())
    admit(scenario, common.admitted)
    common.admitted = scenario
    model = make_model(scenario, stored=False)
    model.sample_with(common.samplers)
    ending, _ = yield from _run(scenario, model, None)
    return MeasuredRun(ending.status, ending.reason, ending.time, model.metrics())


def rehearse(scenario: Scenario, controller: Controller) -> None:
    """Take the first two updates of a controller in an admitted scenario, and forget them.

    Raises:
        ScenarioError, ControllerError: as :func:`simulate`.
    """
    episode = Episode(scenario, controller.period, stored=False, owner=type(controller).__name__)
    if (error := follow(episode, controller, updates=2)) is not None:
        raise error


def follow(
    episode: Episode,
    controller: Controller,
    progress: Callable[[float], None] | None = None,
    updates: float = float("inf"),
) -> ControllerError | None:
    """Let a controller step an episode to its end, or for some updates; the error that ended it before, if any."""
    told = 0.0
    try:
        state = _asked(controller, episode, controller.start, episode.measurement)
        while episode.commanded and updates > 0:
            answer = _asked(controller, episode, _updated, controller, episode, state)
            updates, (command, state) = updates - 1, answer
            if episode.over:
                episode.end(command)
            else:
                episode.step(command)
            share = episode.time / episode.scenario.duration
            if progress and (share >= told + 0.01 or episode.over):
                progress(share)
                told = share
    except KeyboardInterrupt:
        episode.interrupt()
    except ControllerError as error:
        episode.stop(Status.FAILED, str(error))
        return error
    return None


def _updated(controller: Controller, episode: Episode, state: Any) -> tuple[Any, Any]:
    command, state = controller.update(episode.time, episode.measurement, state)
    return command, state


def _asked(controller: Controller, episode: Episode, method: Callable[..., Any], *arguments: Any) -> Any:
    """What a controller answers; whatever it raises names it and the time."""
    try:
        return method(*arguments)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # sys.exit() of a controller ends its run, not the program around it
        at = f"{type(controller).__name__} failed at t = {episode.time:g} s"
        raise ControllerError(f"{at}: {type(error).__name__}: {error}{_line(error)}") from error


def _line(error: BaseException) -> str:
    """Where in the controller's own code it happened."""
    package = str(Path(__file__).parents[1])
    own = [place for place in extract_tb(error.__traceback__) if not place.filename.startswith(package)]
    return f" ({Path(own[0].filename).name}, line {own[0].lineno})" if own else ""


def _run(
    scenario: Scenario, model: Model, progress: Callable[[float], None] | None
) -> Generator[None, None, tuple[Ending, float]]:
    """The loop, a stretch at a time; also the seconds spent sampling the outside world."""
    clock, sampling, begin, inputs = model.clock, 0.0, 0, None
    try:
        while begin < clock.periods:
            end = end_of_stretch(clock, begin)
            before = perf_counter()
            part = stretch(clock, begin, end)
            inputs = model.sample(part)
            sampling += perf_counter() - before
            stopped = model.run(inputs, part.first, model.draw(end - begin), begin)
            if stopped != loop.FINISHED:
                return model.diverged(stopped), sampling
            begin = end
            if progress:
                progress(end / clock.periods)
            yield
        # The update at the end: a period without steps.
        if model.run(inputs, np.zeros(2, dtype=np.int64), model.draw(1), clock.periods) != loop.FINISHED:
            return model.diverged(clock.periods), sampling
    except KeyboardInterrupt:
        updates, time = model.so_far()
        return Ending(Status.INTERRUPTED, f"interrupted at t = {time:g} s", updates, time), sampling
    return Ending(Status.COMPLETED, "the end of the run was reached", clock.periods + 1, scenario.duration), sampling
