"""The built-in controller: sample, estimate, decide, hold. Outer law -> allocation -> loop of each motor.

Laws and observers live in their own files; this one only puts them in order, once per period. The
controller knows the nominal constants (:class:`~umbilical.scenario.control.Nominal`), never the truth.
"""

from __future__ import annotations

from math import exp
from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.control.allocation.adaptive import initial_kappa
from umbilical.control.allocation.table import KNOWN, Allocation, allocate, make_allocation
from umbilical.control.contract import Command, Decision, Measurement, Readings, make_decision, make_readings
from umbilical.control.motor.backstepping import Backstepping, backstepping_drive
from umbilical.control.motor.command_filter import CommandFilter, Reference, advance_filter, make_command_filter
from umbilical.control.motor.disturbance import advance_motor_disturbance, start_motor_disturbance
from umbilical.control.nominal import NominalMotor, make_nominal_motors
from umbilical.control.observers.table import ObserverMemory, Observers, make_observers, observe_rates, start_observers
from umbilical.control.outer.table import NONE, LawMemory, Laws, make_laws, start_law, update_law
from umbilical.control.rates import outer_period
from umbilical.frames import Frame, integer, part, real
from umbilical.scenario.control import MotorLoop
from umbilical.scenario.scenario import Scenario


class Outer(NamedTuple):
    """Settings of the outer loop: observers, then the law."""

    observers: Observers
    laws: Laws


class Motors(NamedTuple):
    """Settings of allocation and motor loops; ``nominal`` is one record per motor."""

    driven: bool
    nominal: NominalMotor
    allocation: Allocation
    command_filter: CommandFilter
    backstepping: Backstepping
    observer_gain: float
    observer_decay: float


class CascadeSettings(NamedTuple):
    """Everything the built-in controller knows; ``outer_every`` counts periods between outer updates."""

    outer: Outer
    motors: Motors
    outer_every: int


class OuterMemory(Frame):
    """What the outer law and its observers remember."""

    updates = integer()
    observers = part(ObserverMemory)
    laws = part(LawMemory)


class MotorMemory(Frame):
    """What the loop of one motor remembers."""

    reference = part(Reference)
    motor_disturbance_state = real()
    held_drive = real()


class CascadeState(NamedTuple):
    """What the built-in controller remembers, changed in place by its kernels.

    Attributes:
        outer: one record.
        kappa: adaptive allocation, shape (n + 1,).
        motors: one record per motor.
    """

    outer: OuterMemory
    kappa: np.ndarray
    motors: MotorMemory


def make_settings(scenario: Scenario, across: bool = False) -> CascadeSettings:
    """Settings of a scenario's built-in controller, from its nominal constants; ``across``: for the direction y."""
    control, period = scenario.control, outer_period(scenario.control)
    outer = Outer(make_observers(control, period), make_laws(scenario, period, across))
    return CascadeSettings(outer, _motor_settings(scenario, period), round(period / control.period))


def _motor_settings(scenario: Scenario, period: float) -> Motors:
    control, nominal = scenario.control, scenario.control.nominal
    loop, count = control.motor_loop, len(nominal.motors or scenario.motors)
    fields = {name: getattr(loop, name) if loop else 1.0 for name in Backstepping._fields}
    gain = loop.observer_gain if loop else 1.0
    return Motors(
        loop is not None and not scenario.ideal_thruster,
        make_nominal_motors(nominal, scenario.motors),
        make_allocation(control.allocation, count, period),
        _command_filter(loop, control.period),
        Backstepping(**fields),
        gain,
        exp(-gain * control.period),
    )


def _command_filter(loop: MotorLoop | None, period: float) -> CommandFilter:
    return make_command_filter(loop.filter_frequency if loop else 1.0, loop.root_width if loop else 1.0, period)


def with_known_factors(settings: CascadeSettings) -> CascadeSettings:
    """The same without adaptation, which needs the u_a that only the built-in boundary law computes."""
    allocation = settings.motors.allocation._replace(method=KNOWN)
    return settings._replace(motors=settings.motors._replace(allocation=allocation))


def make_state(scenario: Scenario) -> CascadeState:
    """Memory of the controller before its first measurement."""
    n = len(scenario.motors)
    kappa = initial_kappa(scenario.control.allocation, n)
    return CascadeState(OuterMemory.many(1), kappa, MotorMemory.many(n))


@glue
def start(settings: CascadeSettings, state: CascadeState, readings: Readings) -> None:
    """Observers at rest on the first sample, filters at zero."""
    outer, motors, tip, memory = settings.outer, settings.motors, readings.tip[0], state.outer[0]
    memory.updates = 0
    start_observers(memory.observers, tip)
    start_law(outer.laws, memory.laws, readings, tip.tip_velocity if outer.observers.ideal_rates else 0.0)
    for i in range(motors.nominal.size):
        scaled_current = motors.nominal[i].current_scale * readings.motors[i].motor_current
        state.motors[i].motor_disturbance_state = start_motor_disturbance(motors.observer_gain, scaled_current)


@glue
def update(settings: CascadeSettings, state: CascadeState, readings: Readings, decision: Decision) -> None:
    """One update: the outer law on its own samples, the motor loops on every one."""
    if settings.outer.laws.kind != NONE:
        if state.outer[0].updates % settings.outer_every == 0:
            update_outer(settings.outer, state, readings, decision)
            if settings.motors.driven:
                share(settings.motors, state, decision)
        if settings.motors.driven:
            update_motors(settings.motors, state, readings, decision)
    state.outer[0].updates += 1


@kernel
def update_outer(s: Outer, state: CascadeState, readings: Readings, decision: Decision) -> None:
    """Estimate and decide: from the readings at the ROV to the commanded thrust."""
    out, memory = decision.outer[0], state.outer[0]
    observe_rates(s.observers, memory.observers, readings.tip[0], out, memory.updates > 0)
    update_law(s.laws, memory.laws, readings, out, memory.updates > 0)


@glue
def share(s: Motors, state: CascadeState, decision: Decision) -> None:
    """Demands on the motors from the commanded thrust."""
    allocate(s.allocation, s.nominal, state.kappa, decision.outer[0], decision.motors, state.outer[0].updates > 0)


@kernel
def update_motors(s: Motors, state: CascadeState, readings: Readings, decision: Decision) -> None:
    """The loop of every motor: filter the demand, observe the disturbance, set the voltage."""
    for i in range(s.nominal.size):
        c, seen, memory, out = s.nominal[i], readings.motors[i], state.motors[i], decision.motors[i]
        speed, scaled_current = seen.motor_speed, c.current_scale * seen.motor_current
        if state.outer[0].updates > 0:
            advance_filter(s.command_filter, memory.reference, out.demand)
            memory.motor_disturbance_state = advance_motor_disturbance(
                c, s.observer_gain, s.observer_decay, memory.motor_disturbance_state, speed, scaled_current,
                memory.held_drive,
            )  # fmt: skip
        disturbance = memory.motor_disturbance_state + s.observer_gain * scaled_current
        drive = backstepping_drive(c, s.backstepping, speed, scaled_current, memory.reference) - disturbance
        voltage = min(max(drive / c.f23, -c.voltage_limit), c.voltage_limit)
        memory.held_drive = c.f23 * voltage
        out.motor_voltage = voltage
        out.speed_reference = memory.reference.speed_reference
        out.motor_disturbance_estimate = disturbance


class Cascade:
    """The built-in controller behind the contract of a user's: the same kernels, called from Python.

    >>> import umbilical
    >>> controller = Cascade(umbilical.load("paper"))
    >>> controller.period
    0.001
    """

    def __init__(self, scenario: Scenario) -> None:
        self.period = scenario.control.period
        self._scenario = scenario
        self._settings = make_settings(scenario)

    def start(self, measurement: Measurement) -> tuple[CascadeState, Decision, Readings]:
        """Memory and decision before the first update, and room for readings."""
        state, readings = make_state(self._scenario), to_readings(measurement)
        start(self._settings, state, readings)
        return state, make_decision(len(self._scenario.motors)), readings

    def update(self, t: float, measurement: Measurement, state: Any) -> tuple[Command, Any]:
        """Thrust and voltages from the kernels; ``state`` is changed in place and handed back."""
        memory, decision, readings = state
        fill_readings(readings, measurement)
        update(self._settings, memory, readings, decision)
        thrust = float(decision.outer["thrust_command"][0])
        voltage = None if self._scenario.ideal_thruster else decision.motors["motor_voltage"].copy()
        return Command(thrust, voltage), state


def to_readings(m: Measurement) -> Readings:
    """A measurement as kernels take it; absent sensors read NaN."""
    readings = make_readings(m.motor_speed.size)
    fill_readings(readings, m)
    return readings


def fill_readings(readings: Readings, m: Measurement) -> None:
    """Put a measurement into readings, record by record."""
    velocity = np.nan if m.tip_velocity is None else m.tip_velocity
    slope_rate = np.nan if m.tip_slope_rate is None else m.tip_slope_rate
    readings.tip[0] = (m.tip_displacement, m.tip_slope, velocity, slope_rate)
    readings.winch[0] = (m.length, m.payout_speed, m.payout_acceleration, m.tip_tension)
    readings.motors["motor_speed"] = m.motor_speed
    readings.motors["motor_current"] = m.motor_current
