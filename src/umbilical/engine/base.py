"""What simulate and Episode ask of a model of the cable, and what all models answer alike."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from umbilical.control import cascade
from umbilical.control.contract import Command, Measurement, to_measurement
from umbilical.engine.ending import Ending, closed, held_values, only_measured, stored_times
from umbilical.engine.loop import RunRecord, check_command, put_command
from umbilical.engine.saturation import saturation, saturation_notices
from umbilical.engine.schedule import Clock, Stretch
from umbilical.engine.sensing import NoiseSource, Side
from umbilical.plant.layout import positions
from umbilical.run import Run, Status, assemble
from umbilical.scenario.scenario import Scenario


class Model(ABC):
    """A plant with its sensors, built-in controller and record, before its first step or anywhere in a run.

    ``inputs`` and ``noise`` are what :meth:`sample` and :meth:`draw` gave for one stretch of control periods.

    Attributes:
        clock: of the run.
        state: everything that moves.
    """

    clock: Clock
    state: Any
    _scenario: Scenario
    _record: RunRecord
    _sampler: Any
    _dice: tuple[NoiseSource, ...]
    _sides: tuple[Side, ...]
    """The direction of the string first."""
    _settings: cascade.CascadeSettings
    """Of a command that comes from outside."""
    _memories: tuple[cascade.CascadeState, ...]
    _elements: int
    _works: Sequence[str]
    """Channels that the energy is balanced with, in the order they are summed."""
    _snaps: np.ndarray | None = None

    @property
    def every(self) -> int:
        """Every so many updates one is stored."""
        return self._record.every

    def sample_with(self, samplers: list[Any]) -> None:
        """Let one of these that samples the same do it, or be one of them."""
        if self._sampler not in samplers:
            samplers.append(self._sampler)
        self._sampler = samplers[samplers.index(self._sampler)]

    def sample(self, part: Stretch) -> Any:
        """What acts from outside during a stretch; its ``refresh`` marks steps before which something jumped."""
        inputs = self._sampler.sample(part.steps)
        inputs.refresh[0] |= part.steps.start[0] == 0.0
        return inputs

    def draw(self, updates: int) -> tuple[np.ndarray, ...]:
        """Noise of the sensors at the next updates."""
        return tuple(dice.draw(updates) for dice in self._dice)

    @abstractmethod
    def run(self, inputs: Any, first: np.ndarray, noise: Any, begin: int) -> int:
        """Let the built-in controller run a stretch; the update at which the model ended, or ``loop.FINISHED``."""

    @abstractmethod
    def observe(self, inputs: Any, first: np.ndarray, noise: Any, j: int) -> None:
        """Measure in period j of a stretch."""

    @abstractmethod
    def hold(
        self, inputs: Any, first: np.ndarray, noise: Any, begin: int, periods: tuple[int, int], driven: bool,
        decided: bool,
    ) -> int:  # fmt: skip
        """Hold a command over periods of a stretch; as :meth:`run`."""

    def start(self) -> None:
        """Start the built-in controller's motor loops on the first measurement."""
        cascade.start(self._settings, self._memories[0], self._sides[0].readings)

    def take(self, command: Command, t: float) -> bool:
        """Check a command and put it where the kernels find it; whether motor loops have to drive it."""
        ideal, (along, *others) = self._scenario.ideal_thruster, (side.decision for side in self._sides)
        check_command(command, ideal, along, t, can_drive=self._settings.motors.driven)
        put_command(command, along)
        for decision in others:
            decision.outer[0].thrust_command = command.thrust_across
        return command.voltage is None and not ideal

    def measurement(self) -> Measurement:
        """What the sensors read now."""
        return to_measurement(self._sides[0].readings, self._scenario.sensors.ideal_velocity)

    def changing(self, rows: int) -> Iterator[np.ndarray]:
        """All arrays that change; of the log the first rows."""
        sides = tuple(side[1:] for side in self._sides)
        yield from arrays_of((self.state, sides, self._memories, self._record.tally))
        yield from (array[:rows] for array in arrays_of(self._record.log))

    def dice(self) -> tuple[Any, ...]:
        """How far the sensors' noise is drawn."""
        return tuple(dice.save() for dice in self._dice)

    def restore_dice(self, mark: tuple[Any, ...]) -> None:
        """Go back to what :meth:`dice` gave."""
        for dice, saved in zip(self._dice, mark, strict=True):
            dice.restore(saved)

    def so_far(self) -> tuple[int, float]:
        """Updates taken, and the time of the last one."""
        updates = int(self._record.tally.measures[0].samples)
        return updates, max(updates - 1, 0) * self.clock.period

    def diverged(self, update: int) -> Ending:
        """How a run ended whose model did at an update."""
        time, why = update * self.clock.period, self._cause() or "a state or a voltage is no longer finite"
        return Ending(Status.DIVERGED, f"at t = {time:g} s {why}", update, time)

    @abstractmethod
    def _cause(self) -> str:
        """Why the model ended; empty where something is not finite."""

    def notices(self) -> tuple[str, ...]:
        """What a user should know of the run so far."""
        return tuple(str(notice) for notice in saturation_notices(self._scenario, self._record.tally))

    def metrics(self) -> dict[str, float]:
        """Metrics so far, without those of the power balance; what there was nothing to measure of is absent."""
        found = only_measured(self._scenario, self._measures()) | saturation(self._scenario, self._record.tally)
        return {name: float(value) for name, value in found.items()}

    @abstractmethod
    def _measures(self) -> dict[str, float]:
        """Metrics of the tally."""

    def assemble(
        self, ending: Ending, notices: tuple[str, ...], timing: dict[str, float],
        logged: Sequence[tuple[int, Mapping[str, float]]] = (),
    ) -> Run:  # fmt: skip
        """The run from what is recorded; ``logged``: values of a user's controller, by the update it logged them at."""
        scenario, clock, every, log = self._scenario, self.clock, self.every, self._record.log
        times = stored_times(scenario, ending, clock, every, log.outer.size)
        named, metrics = self._channels(times.size), self.metrics()
        if times.size:
            named["energy"] = self._energy(times.size, named)
            metrics |= closed(named, np.stack([named[name] for name in self._works if name in named], axis=1))
            notices += tuple(map(str, self._of_the_balance(metrics)))
        updates = np.minimum(np.arange(times.size) * every, clock.periods)
        return assemble(
            scenario, named, time=times, **ending.told(), metrics=metrics, timing=timing, notices=notices,
            sigma=positions(self._elements), logged=held_values(logged, updates), snaps=self._snaps,
        )  # fmt: skip

    @abstractmethod
    def _channels(self, samples: int) -> dict[str, np.ndarray]:
        """The stored samples by name."""

    @abstractmethod
    def _energy(self, samples: int, named: dict[str, np.ndarray]) -> np.ndarray:
        """Energy at the stored samples, J."""

    def _of_the_balance(self, metrics: Mapping[str, float]) -> Iterator[object]:
        """What a user should know of the power balance."""
        yield from ()


def arrays_of(tree: Any) -> Iterator[np.ndarray]:
    """The arrays of nested named tuples."""
    if isinstance(tree, np.ndarray):
        yield tree
    elif isinstance(tree, tuple):
        for part in tree:
            yield from arrays_of(part)
