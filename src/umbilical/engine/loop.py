"""The two loops, one semantics: measure -> decide -> actuate -> advance, once per control period.

``run_steps`` decides by the built-in controller, ``run_held`` holds a command that came from outside until the
next one (:mod:`umbilical.engine.episode`); with the built-in controller behind the Python contract both give the
same bits (tests/twins).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import entry_kernel, glue
from umbilical.control import cascade
from umbilical.control.cascade import CascadeSettings, CascadeState
from umbilical.control.contract import Command, Decision, Readings
from umbilical.engine.recording import measure, store
from umbilical.engine.sensing import SensorErrors, SensorState, sense
from umbilical.engine.stepping import DRY, WET, Plant, PlantState, advance, enter_dry_step, enter_step
from umbilical.errors import ControllerError
from umbilical.plant.exogenous import Inputs

FINISHED = -1


class World(NamedTuple):
    """The plant with its sensors: what the controller is held against."""

    plant: Plant
    state: PlantState
    sensors: SensorErrors
    memory: SensorState
    readings: Readings
    decision: Decision


class RunRecord(NamedTuple):
    """What is kept of a run.

    Attributes:
        log, tally: stored samples, and measures of all: of the string or of the rope.
        every: every so many updates one is stored; the last one always is.
        fault_update: first update at or after the first fault.
        last_update: the update at the end of the run.
        period: of control, s.
    """

    log: Any
    tally: Any
    every: int
    fault_update: int
    last_update: int
    period: float


@glue
def actuate(world: World) -> None:
    """An ideal thruster delivers the new command at once; motors take their time."""
    if world.plant.ideal:
        world.state.now[0].thrust = world.decision.outer[0].thrust_command


@glue
def keep(world: World, record: RunRecord, update: int, kappa: np.ndarray) -> bool:
    """Take one control sample into the record; False if the model has ended."""
    good = measure(record.tally, world.state, world.decision, update >= record.fault_update)
    if good and (update % record.every == 0 or update == record.last_update):
        row = (update + record.every - 1) // record.every
        store(record.log, row, record.tally, world.state, world.decision, kappa)
    return good


@entry_kernel
def run_steps(
    world: World, settings: CascadeSettings, memory: CascadeState, record: RunRecord, inputs: Inputs, first: np.ndarray,
    noise: np.ndarray, begin: int,
) -> int:  # fmt: skip
    """Control periods ``begin`` onwards, period j having the steps ``first[j]`` to ``first[j + 1]``.

    Returns the update at which the model ended, or :data:`FINISHED`.
    """
    return run_periods(world, settings, memory, record, inputs, first, noise, begin, WET)


@entry_kernel
def run_dry_steps(
    world: World, settings: CascadeSettings, memory: CascadeState, record: RunRecord, inputs: Inputs, first: np.ndarray,
    noise: np.ndarray, begin: int,
) -> int:  # fmt: skip
    """The same without water, in two thirds of the time to compile."""
    return run_periods(world, settings, memory, record, inputs, first, noise, begin, DRY)


@glue
def run_periods(
    world: World, settings: CascadeSettings, memory: CascadeState, record: RunRecord, inputs: Inputs, first: np.ndarray,
    noise: np.ndarray, begin: int, wet: bool,
) -> int:  # fmt: skip
    """The body of :func:`run_steps`."""
    for j in range(first.size - 1):
        update = begin + j
        observe_period(world, inputs, first, noise, j, wet)
        if update == 0:
            cascade.start(settings, memory, world.readings)
        cascade.update(settings, memory, world.readings, world.decision)
        actuate(world)
        good = keep(world, record, update, memory.kappa)
        if not good:
            return update
        advance_period(world, inputs, first[j], first[j + 1], wet)
    return FINISHED


@glue
def advance_period(world: World, inputs: Inputs, begin: int, end: int, wet: bool) -> None:
    """All plant steps of one control period, entered already at ``begin``."""
    for i in range(begin, end):
        if i > begin and inputs.refresh[i]:
            enter_after_jump(world, inputs, i, wet)
        advance(world.plant, world.state, inputs, i, world.decision.motors, wet)


@glue
def enter_after_jump(world: World, inputs: Inputs, i: int, wet: bool) -> None:
    """Something outside has jumped at the start of step i."""
    if wet:
        enter_step(world.plant, world.state, inputs, i)
    else:
        enter_dry_step(world.plant, world.state, inputs, i)


@glue
def observe_period(world: World, inputs: Inputs, first: np.ndarray, noise: np.ndarray, j: int, wet: bool) -> None:
    """What comes before a decision in period j of a stretch: the outside world after a jump, then the sensors."""
    if first[j] < first[j + 1] and inputs.refresh[first[j]]:
        enter_after_jump(world, inputs, first[j], wet)
    sense(world.sensors, world.memory, noise, j, world.state, world.readings)


@entry_kernel
def observe(world: World, inputs: Inputs, first: np.ndarray, noise: np.ndarray, j: int) -> None:
    """:func:`observe_period` from Python."""
    observe_period(world, inputs, first, noise, j, WET)


@entry_kernel
def run_held(
    world: World,
    settings: CascadeSettings,
    memory: CascadeState,
    record: RunRecord,
    inputs: Inputs,
    first: np.ndarray,
    noise: np.ndarray,
    begin: int,
    periods: tuple[int, int],
    driven: bool,
    decided: bool,
) -> int:
    """Hold a command over some periods of the stretch that begins at ``begin``.

    The first is observed already, and so is in the end what follows the last, if it is in the stretch.

    ``driven``: the command is a thrust, which allocation (if it has just been ``decided``) and motor loops turn into
    voltages. Returns as :func:`run_steps`.
    """
    for j in range(periods[0], periods[1]):
        if j > periods[0]:
            observe(world, inputs, first, noise, j)
        if driven:
            if decided and j == periods[0]:
                cascade.share(settings.motors, memory, world.decision)
            cascade.update_motors(settings.motors, memory, world.readings, world.decision)
        memory.outer[0].updates += 1
        actuate(world)
        good = keep(world, record, begin + j, memory.kappa)
        if not good:
            return begin + j
        advance_period(world, inputs, first[j], first[j + 1], WET)
    if periods[1] < first.size - 1:  # here, because a call from Python costs more than a period
        observe(world, inputs, first, noise, periods[1])
    return FINISHED


def put_command(command: Command, decision: Decision) -> None:
    """Put a command where the kernels find it."""
    decision.outer["thrust_command"][0] = np.nan if command.thrust is None else command.thrust
    if command.voltage is not None:
        decision.motors["motor_voltage"] = command.voltage


def check_command(command: object, ideal: bool, decision: Decision, t: float, *, can_drive: bool) -> None:
    """Refuse what is not a command, before it reaches the plant; ``can_drive``: there are motor loops for a thrust.

    Raises:
        ControllerError: not a :class:`Command`, neither thrust nor voltage, or the wrong shape.
    """
    where = f"the controller's command at t = {t:g} s"
    if not isinstance(command, Command):
        raise ControllerError(f"{where} is a {type(command).__name__}; return (Command(thrust=...), state)")
    if command.thrust is None and (command.voltage is None or ideal):
        need = "thrust (the thruster is ideal)" if ideal else "thrust or voltage"
        raise ControllerError(f"{where} gives no {need}")
    if command.voltage is None and not ideal and not can_drive:
        raise ControllerError(f"{where} gives thrust only; add control.motor_loop, or set ideal_thruster = true")
    if command.voltage is not None and np.shape(command.voltage) != (decision.motors.size,):
        shape, motors = np.shape(command.voltage), decision.motors.size
        raise ControllerError(f"{where} gives voltages of shape {shape}; there are {motors} motors")
    for name, value in (command.log or {}).items():
        if not (isinstance(name, str) and name.isidentifier() and isinstance(value, (int, float, np.number))):
            raise ControllerError(f"{where} logs {name!r}: {value!r}; log numbers by names made of letters and digits")
