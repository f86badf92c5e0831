"""What simulate and Episode ask of a model of the cable, and the string behind it; the rope is in ``engine/rope``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from umbilical.control import cascade
from umbilical.control.contract import Command, Measurement, to_measurement
from umbilical.engine import loop
from umbilical.engine.ending import Ending, all_metrics, assemble_run, divergence, so_far
from umbilical.engine.saturation import saturation_notices
from umbilical.engine.schedule import Clock, Stretch
from umbilical.engine.setup import set_up
from umbilical.plant.exogenous import Outside
from umbilical.run import Run
from umbilical.scenario.scenario import Scenario


class Model(Protocol):
    """A plant with its sensors, built-in controller and record, before its first step or anywhere in a run.

    ``inputs`` and ``noise`` are what :meth:`sample` and :meth:`draw` gave for one stretch of control periods.
    """

    clock: Clock
    every: int

    def sample(self, part: Stretch) -> Any:
        """What acts from outside during a stretch; its ``refresh`` marks steps before which something jumped."""
        ...

    def draw(self, updates: int) -> Any:
        """Noise of the sensors at the next updates."""
        ...

    def run(self, inputs: Any, first: np.ndarray, noise: Any, begin: int) -> int:
        """Let the built-in controller run a stretch; the update at which the model ended, or ``loop.FINISHED``."""
        ...

    def observe(self, inputs: Any, first: np.ndarray, noise: Any, j: int) -> None:
        """Measure in period j of a stretch."""
        ...

    def hold(
        self, inputs: Any, first: np.ndarray, noise: Any, begin: int, periods: tuple[int, int], driven: bool,
        decided: bool,
    ) -> int:  # fmt: skip
        """Hold a command over periods of a stretch; as :meth:`run`."""
        ...

    def start(self) -> None:
        """Start the built-in controller's motor loops on the first measurement."""
        ...

    def take(self, command: Command, t: float) -> bool:
        """Check a command and put it where the kernels find it; whether motor loops have to drive it."""
        ...

    def measurement(self) -> Measurement:
        """What the sensors read now."""
        ...

    def changing(self, rows: int) -> Iterator[np.ndarray]:
        """All arrays that change; of the log the first rows."""
        ...

    def dice(self) -> tuple[Any, ...]:
        """How far the sensors' noise is drawn."""
        ...

    def restore_dice(self, mark: tuple[Any, ...]) -> None:
        """Go back to what :meth:`dice` gave."""
        ...

    def so_far(self) -> tuple[int, float]:
        """Updates taken, and the time of the last one."""
        ...

    def diverged(self, update: int) -> Ending:
        """How a run ended whose model did at an update."""
        ...

    def notices(self) -> tuple[str, ...]:
        """What a user should know of the run so far."""
        ...

    def metrics(self) -> dict[str, float]:
        """Metrics so far, without those of the power balance."""
        ...

    def assemble(
        self, ending: Ending, notices: tuple[str, ...], timing: dict[str, float],
        logged: Sequence[tuple[int, Mapping[str, float]]] = (),
    ) -> Run:  # fmt: skip
        """The run from what is recorded."""
        ...


class StringModel:
    """The string of the paper, in one plane."""

    def __init__(self, scenario: Scenario, *, stored: bool = True, held: bool = False) -> None:
        self._scenario, self._setup = scenario, set_up(scenario, stored=stored, held=held)
        self._outside, self._held = Outside(scenario), cascade.with_known_factors(self._setup.settings)
        self.clock, self.every = self._setup.clock, self._setup.record.every
        self.state = self._setup.world.state

    def sample(self, part: Stretch) -> Any:
        inputs = self._outside.sample(part.steps)
        inputs.refresh[0] |= part.steps.start[0] == 0.0
        return inputs

    def draw(self, updates: int) -> Any:
        return self._setup.dice.draw(updates)

    def run(self, inputs: Any, first: np.ndarray, noise: Any, begin: int) -> int:
        s = self._setup
        run = loop.run_steps if s.world.plant.forces.wet else loop.run_dry_steps
        return run(s.world, s.settings, s.memory, s.record, inputs, first, noise, begin)

    def observe(self, inputs: Any, first: np.ndarray, noise: Any, j: int) -> None:
        loop.observe(self._setup.world, inputs, first, noise, j)

    def hold(
        self, inputs: Any, first: np.ndarray, noise: Any, begin: int, periods: tuple[int, int], driven: bool,
        decided: bool,
    ) -> int:  # fmt: skip
        s = self._setup
        return loop.run_held(
            s.world, self._held, s.memory, s.record, inputs, first, noise, begin, periods, driven, decided
        )

    def start(self) -> None:
        cascade.start(self._held, self._setup.memory, self._setup.world.readings)

    def take(self, command: Command, t: float) -> bool:
        world = self._setup.world
        plant, decision = world.plant, world.decision
        loop.check_command(command, plant.ideal, decision, t, can_drive=self._held.motors.driven)
        loop.put_command(command, decision)
        return command.voltage is None and not plant.ideal

    def measurement(self) -> Measurement:
        return to_measurement(self._setup.world.readings, self._scenario.sensors.ideal_velocity)

    def changing(self, rows: int) -> Iterator[np.ndarray]:
        setup, world = self._setup, self._setup.world
        state = (world.state, world.memory, world.readings, world.decision, setup.memory, setup.record.tally)
        yield from (array for part in state for array in arrays_of(part))
        yield from (array[:rows] for array in arrays_of(setup.record.log))

    def dice(self) -> tuple[Any, ...]:
        return self._setup.dice.save()

    def restore_dice(self, mark: tuple[Any, ...]) -> None:
        self._setup.dice.restore(mark)

    def so_far(self) -> tuple[int, float]:
        return so_far(self._setup)

    def diverged(self, update: int) -> Ending:
        return divergence(self._setup, update)

    def notices(self) -> tuple[str, ...]:
        return tuple(str(notice) for notice in saturation_notices(self._scenario, self._setup.record.tally))

    def metrics(self) -> dict[str, float]:
        return {name: float(value) for name, value in all_metrics(self._scenario, self._setup).items()}

    def assemble(
        self, ending: Ending, notices: tuple[str, ...], timing: dict[str, float],
        logged: Sequence[tuple[int, Mapping[str, float]]] = (),
    ) -> Run:  # fmt: skip
        return assemble_run(self._scenario, self._setup, ending, notices, timing, logged)


def arrays_of(tree: Any) -> Iterator[np.ndarray]:
    """The arrays of nested named tuples."""
    if isinstance(tree, np.ndarray):
        yield tree
    elif isinstance(tree, tuple):
        for part in tree:
            yield from arrays_of(part)


def make_model(scenario: Scenario, *, stored: bool = True, held: bool = False) -> Model:
    """The model a scenario names, ready for its first step; ``held``: commands will come from outside."""
    if scenario.model == "rope":
        from umbilical.engine.rope.model import SpatialModel

        return SpatialModel(scenario, stored=stored)
    return StringModel(scenario, stored=stored, held=held)
