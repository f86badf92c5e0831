"""A run that is stepped from outside, one held command after another."""

from __future__ import annotations

from collections.abc import Mapping
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from umbilical.control.contract import Command, Measurement
from umbilical.engine import loop
from umbilical.engine.base import Model
from umbilical.engine.ending import Ending
from umbilical.engine.model import make_model
from umbilical.engine.schedule import end_of_stretch, stretch
from umbilical.errors import ControllerError, Problem, ScenarioError
from umbilical.library import admit
from umbilical.relations.instants import apart, is_multiple, nearest_count
from umbilical.run import Run, Status
from umbilical.scenario.scenario import Scenario


class Block(NamedTuple):
    """Updates ``begin`` to ``end`` (exclusive) with what acts from outside during them, and the sensors' noise."""

    begin: int
    end: int
    inputs: Any
    first: np.ndarray
    noise: Any


class Mark(NamedTuple):
    """Where an episode stood: copies of everything that changes."""

    update: int
    driven: bool
    ending: Ending | None
    block: tuple[int, Any]
    dice: tuple[Any, ...]
    arrays: list[np.ndarray]
    logged: list[tuple[int, Mapping[str, float]]]


class Episode:
    """A simulation of a scenario that its user steps: for model predictive control, learning, co-simulation.

    Driven by a controller's commands it is that controller's run in :func:`~umbilical.engine.simulate.simulate`, bit
    for bit: ``simulate`` itself is such a loop.

    Args:
        scenario: what to simulate; checked completely before the first step.
        period: how long a command is held, s, a multiple of the scenario's ``control.period`` (the default). The last
            step ends with the run and may be shorter.
        stored: False keeps no samples but the first and the last, for metrics alone.
        owner: whose period and commands these are, for the message of an error and the name of the run.

    Raises:
        ScenarioError: the scenario or the period was refused, with every problem.

    >>> import umbilical
    >>> episode = Episode(umbilical.load("crosscheck-pd", {"duration": 1.0}), period=0.1)
    >>> while not episode.over:
    ...     measurement = episode.step(umbilical.Command(thrust=-100.0 * episode.measurement.tip_displacement))
    >>> run = episode.finish()
    >>> run.status.name, run.end_time
    ('COMPLETED', 1.0)
    """

    def __init__(
        self, scenario: Scenario, period: float | None = None, *, stored: bool = True, owner: str = "Episode"
    ) -> None:
        begun = perf_counter()
        self.scenario, self._notices = scenario, tuple(str(notice) for notice in admit(scenario))
        self._owner = owner
        self._held = 1 if period is None else _periods(scenario, float(period), owner)
        self._model = make_model(scenario, stored=stored, held=True)
        self._update, self._driven, self._sampling = 0, False, 0.0
        self._ending: Ending | None = None
        self._run: Run | None = None
        self._logged: list[tuple[int, Mapping[str, float]]] = []
        self._begun = perf_counter()
        self._prepared = self._begun - begun
        self._block = self._next_block(0)
        self._observe()
        self._model.start()

    @property
    def time(self) -> float:
        """The present instant, s."""
        return self._update * self._model.clock.period

    @property
    def over(self) -> bool:
        """Whether the end of the run is reached, or the model has ended: no step can follow."""
        return self._ending is not None or self._update == self._model.clock.periods

    @property
    def model(self) -> Model:
        """The model behind it, for :func:`umbilical.engine.truth.truth`."""
        return self._model

    @property
    def status(self) -> Status | None:
        """How the run ended; None before that, and before :meth:`finish`."""
        return self._ending.status if self._ending else None

    @property
    def reason(self) -> str:
        """Why the run ended; empty before that."""
        return self._ending.reason if self._ending else ""

    @property
    def commanded(self) -> bool:
        """Whether a command is due now: at the end of the run only where that is a whole number of periods."""
        return self._ending is None and self._update % self._held == 0

    def step(self, command: Command) -> Measurement:
        """Hold a command for one period; the new measurement, or the last one if the model has ended.

        Raises:
            ControllerError: the command breaks the contract, or the episode is over.
        """
        if self.over:
            raise ControllerError(f"the episode is over at t = {self.time:g} s; restore a mark, or begin another one")
        self._take(command)
        self._hold(min(self._update + self._held, self._model.clock.periods), decided=True)
        return self.measurement

    def stop(self, status: Status, reason: str) -> Ending:
        """End the run here, for a reason; what has ended stays as it ended."""
        self._ending = self._ending or Ending(status, reason, *self._model.so_far())
        return self._ending

    def interrupt(self) -> Ending:
        """End the run here: its user gave up."""
        return self.stop(Status.INTERRUPTED, f"interrupted at t = {self._model.so_far()[1]:g} s")

    def end(self, command: Command | None = None) -> Ending:
        """Take the update at the end of the run, if it is reached; how the run ended."""
        periods = self._model.clock.periods
        if self._ending is None and self._update == periods:
            if command is not None:
                self._take(command)
            self._hold(periods + 1, decided=command is not None)
            self._update = periods
            reached = "the end of the run was reached"
            self._ending = self._ending or Ending(Status.COMPLETED, reached, periods + 1, self.scenario.duration)
        return self.stop(Status.INTERRUPTED, f"stopped at t = {self.time:g} s, before the end of the run")

    def finish(self, command: Command | None = None) -> Run:
        """The run so far. What is over is complete; what is not counts as interrupted.

        Args:
            command: what is decided at the end itself, for the last sample; by default the last command is held.
        """
        if self._run is None:
            ending = self.end(command)
            simulated = perf_counter() - self._begun
            timing = {"prepare_s": self._prepared, "simulate_s": simulated, "outside_s": self._sampling}
            notices = (*self._notices, *self._model.notices())
            run = self._model.assemble(ending, notices, timing, self._logged)
            self._run = run.with_controller(self._owner)
        return self._run

    def metrics(self) -> dict[str, float]:
        """Metrics so far, without those of the power balance; the last sample counts once :meth:`end` has taken it."""
        return self._model.metrics()

    def save(self) -> Mark:
        """Copy everything that changes, the sensors' noise included."""
        block = (self._block.begin, self._block.noise)
        arrays = [array.copy() for array in self._model.changing(self._rows())]
        return Mark(self._update, self._driven, self._ending, block, self._model.dice(), arrays, list(self._logged))

    def restore(self, mark: Mark) -> None:
        """Go back (or forward) to a mark of this episode or of another one of the same scenario."""
        self._update, self._driven, self._ending, self._run = mark.update, mark.driven, mark.ending, None
        self._logged = list(mark.logged)
        for array, saved in zip(self._model.changing(self._rows()), mark.arrays, strict=True):
            array[...] = saved
        begin, noise = mark.block
        self._block = self._next_block(begin)._replace(noise=noise)
        self._model.restore_dice(mark.dice)
        self._read()

    def _rows(self) -> int:
        """Rows of the log in use: those of the updates before the present one, and the last of a run that is over."""
        every, last = self._model.every, self._ending is not None
        return (self._update + every - 1) // every + last

    def _next_block(self, begin: int) -> Block:
        """Inputs and noise from an update on; the update at the end is a period without steps."""
        before, model, clock = perf_counter(), self._model, self._model.clock
        if begin == clock.periods:
            return Block(begin, begin + 1, self._block.inputs, np.zeros(2, dtype=np.int64), model.draw(1))
        end = end_of_stretch(clock, begin)
        part = stretch(clock, begin, end)
        inputs = model.sample(part)
        self._sampling += perf_counter() - before
        return Block(begin, end, inputs, part.first, model.draw(end - begin))

    def _observe(self) -> None:
        """Measure at the present update."""
        block = self._block
        self._model.observe(block.inputs, block.first, block.noise, self._update - block.begin)
        self._read()

    def _read(self) -> None:
        """What the sensors read now."""
        self.measurement = self._model.measurement()

    def _take(self, command: Command) -> None:
        """Put a command where the kernels find it."""
        self._driven = self._model.take(command, self.time)
        if command.log:
            self._logged.append((self._update, {name: float(value) for name, value in command.log.items()}))

    def _hold(self, end: int, *, decided: bool) -> None:
        """Run until an update, and measure there."""
        while self._update < end:
            block, last = self._block, min(end, self._block.end)
            span = self._update - block.begin, last - block.begin
            stopped = self._model.hold(block.inputs, block.first, block.noise, block.begin, span, self._driven, decided)
            if stopped != loop.FINISHED:
                self._ending = self._model.diverged(stopped)
                self._update = stopped
                return
            self._update, decided = last, False
            if last == block.end and last <= self._model.clock.periods:
                self._block = self._next_block(last)
                self._observe()
        self._read()


def _periods(scenario: Scenario, period: float, owner: str) -> int:
    """Count the control periods that a command is held for."""
    own = scenario.control.period
    if not np.isfinite(period) or not is_multiple(period, own):
        reason = "the motor loops and the sensors run at control.period"
        fix, bound = "set control.period to this period or to a fraction of it", f"control.period = {own:g} s"
        found = f"{apart(period, own)[0]} s"
        raise ScenarioError([Problem(f"{owner}.period", found, f"a multiple of {bound}", reason, fix)])
    return nearest_count(period, own)
