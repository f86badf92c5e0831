"""The two loops, one semantics: measure -> decide -> actuate -> advance, once per control period.

``run_steps`` is compiled from end to end for the built-in controller. ``run_python`` calls the same kernels
for everything but the decision, which may be any Python object; with the built-in controller behind the
Python contract it gives the same bits (tests/twins).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import entry_kernel, glue
from umbilical.control import cascade
from umbilical.control.cascade import CascadeSettings, CascadeState
from umbilical.control.contract import Command, Controller, Decision, Readings, to_measurement
from umbilical.engine.recording import Log, Tally, measure, store
from umbilical.engine.sensing import Sensors, SensorState, sense
from umbilical.engine.stepping import Plant, PlantState, advance, enter_step
from umbilical.errors import ControllerError
from umbilical.plant.exogenous import Inputs

FINISHED = -1


class World(NamedTuple):
    """The plant with its sensors: what the controller is held against."""

    plant: Plant
    state: PlantState
    sensors: Sensors
    memory: SensorState
    readings: Readings
    decision: Decision


class Record(NamedTuple):
    """What is kept of a run.

    Attributes:
        log, tally: stored samples, and measures of all.
        every: every so many updates one is stored; the last one always is.
        fault_update: first update at or after the first fault.
        last_update: the update at the end of the run.
    """

    log: Log
    tally: Tally
    every: int
    fault_update: int
    last_update: int


@glue
def actuate(world: World) -> None:
    """An ideal thruster delivers the new command at once; motors take their time."""
    if world.plant.ideal:
        world.state.now[0].thrust = world.decision.outer[0].thrust_command


@glue
def keep(world: World, record: Record, update: int, kappa: np.ndarray) -> bool:
    """Take one control sample into the record; False if the model has ended."""
    good = measure(record.tally, world.state, world.decision, update >= record.fault_update)
    if good and (update % record.every == 0 or update == record.last_update):
        row = (update + record.every - 1) // record.every
        store(record.log, row, record.tally, world.state, world.decision, kappa)
    return good


@entry_kernel
def run_steps(
    world: World,
    settings: CascadeSettings,
    memory: CascadeState,
    record: Record,
    inputs: Inputs,
    first: np.ndarray,
    noise: np.ndarray,
    begin: int,
) -> int:
    """Control periods ``begin`` onwards, period j having the steps ``first[j]`` to ``first[j + 1]``.

    Returns the update at which the model ended, or :data:`FINISHED`.
    """
    for j in range(first.size - 1):
        update = begin + j
        if first[j] < first[j + 1] and inputs.refresh[first[j]]:
            enter_step(world.plant, world.state, inputs, first[j])
        sense(world.sensors, world.memory, noise, j, world.state, world.readings)
        if update == 0:
            cascade.start(settings, memory, world.readings)
        cascade.update(settings, memory, world.readings, world.decision)
        actuate(world)
        good = keep(world, record, update, memory.kappa)
        if not good:
            return update
        advance_period(world, inputs, first[j], first[j + 1])
    return FINISHED


@glue
def advance_period(world: World, inputs: Inputs, begin: int, end: int) -> None:
    """All plant steps of one control period, entered already at ``begin``."""
    for i in range(begin, end):
        if i > begin and inputs.refresh[i]:
            enter_step(world.plant, world.state, inputs, i)
        advance(world.plant, world.state, inputs, i, world.decision.motors)


class BuiltIn:
    """The compiled loop around the scenario's own controller."""

    def __init__(self, world: World, settings: CascadeSettings, memory: CascadeState, record: Record) -> None:
        self._world, self._settings, self._record = world, settings, record
        self._memory = memory

    def run(self, inputs: Inputs, first: np.ndarray, noise: np.ndarray, begin: int) -> int:
        """As :func:`run_steps`."""
        return run_steps(self._world, self._settings, self._memory, self._record, inputs, first, noise, begin)


class Python:
    """The same loop around any controller.

    A controller that gives thrust only is followed by the scenario's allocation (known factors) and motor
    loops, which go on at the scenario's own period while the controller is called at its.
    """

    def __init__(
        self, world: World, drive: CascadeSettings, memory: CascadeState, record: Record, controller: Controller,
        period: float, every: int, ideal_velocity: bool,
    ) -> None:  # fmt: skip
        self._world, self._controller, self._drive, self._record = world, controller, drive, record
        self._memory = memory
        self._period, self._every, self._ideal_velocity = period, every, ideal_velocity
        self._state: Any = None
        self._through_motors = False

    def run(self, inputs: Inputs, first: np.ndarray, noise: np.ndarray, begin: int) -> int:
        """As :func:`run_steps`."""
        world = self._world
        for j in range(first.size - 1):
            if first[j] < first[j + 1] and inputs.refresh[first[j]]:
                enter_step(world.plant, world.state, inputs, first[j])
            sense(world.sensors, world.memory, noise, j, world.state, world.readings)
            self._update(begin + j)
            actuate(world)
            if not keep(world, self._record, begin + j, self._memory.kappa):
                return begin + j
            advance_period(world, inputs, first[j], first[j + 1])
        return FINISHED

    def _update(self, update: int) -> None:
        """One control instant: the controller at its own period, the motor loops at theirs."""
        world = self._world
        if update == 0:
            cascade.start(self._drive, self._memory, world.readings)
        if update % self._every == 0:
            self._decide(update)
        if self._through_motors:
            cascade.update_motors(self._drive.motors, self._memory, world.readings, world.decision)
        self._memory.outer[0].updates += 1

    def _decide(self, update: int) -> None:
        """Ask the controller, and put its command where the kernels find it."""
        world, t = self._world, update * self._period
        measurement = to_measurement(world.readings, self._ideal_velocity)
        try:
            if update == 0:
                self._state = self._controller.start(measurement)
            command, self._state = self._controller.update(t, measurement, self._state)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # sys.exit() of a controller ends its run, not the program around it
            name = type(self._controller).__name__
            raise ControllerError(f"{name} failed at t = {t:g} s: {type(error).__name__}: {error}") from error
        check_command(command, world, t, can_drive=self._drive.motors.driven)
        world.decision.outer[0].thrust_command = np.nan if command.thrust is None else command.thrust
        if command.voltage is not None:
            world.decision.motors["motor_voltage"] = command.voltage
        self._through_motors = command.voltage is None and not world.plant.ideal
        if self._through_motors:
            cascade.allocate(self._drive.motors, self._memory, world.decision)


def check_command(command: object, world: World, t: float, *, can_drive: bool) -> None:
    """Refuse what is not a command, before it reaches the plant; ``can_drive``: there are motor loops for a thrust.

    Raises:
        ControllerError: not a :class:`Command`, neither thrust nor voltage, or the wrong shape.
    """
    where = f"the controller's command at t = {t:g} s"
    if not isinstance(command, Command):
        raise ControllerError(f"{where} is a {type(command).__name__}; return (Command(thrust=...), state)")
    if command.thrust is None and (command.voltage is None or world.plant.ideal):
        need = "thrust (the thruster is ideal)" if world.plant.ideal else "thrust or voltage"
        raise ControllerError(f"{where} gives no {need}")
    if command.voltage is None and not world.plant.ideal and not can_drive:
        raise ControllerError(f"{where} gives thrust only; add control.motor_loop, or set ideal_thruster = true")
    if command.voltage is not None and np.shape(command.voltage) != (world.decision.motors.size,):
        shape, motors = np.shape(command.voltage), world.decision.motors.size
        raise ControllerError(f"{where} gives voltages of shape {shape}; there are {motors} motors")
