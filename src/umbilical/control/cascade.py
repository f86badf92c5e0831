"""The built-in controller: sample, estimate, decide, hold. Outer law -> allocation -> loop of each motor.

Laws and observers live in their own files; this one only puts them in order, once per period. The
controller knows the nominal constants (:class:`~umbilical.scenario.control.Nominal`), never the truth.
"""

from __future__ import annotations

from math import exp
from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.control.allocation.adaptive import Adaptation, adapt, adaptive_demand, initial_kappa, make_adaptation
from umbilical.control.allocation.known import known_demand
from umbilical.control.contract import Command, Decision, Measurement, Readings, make_decision, make_readings
from umbilical.control.motor.backstepping import Backstepping, backstepping_drive
from umbilical.control.motor.command_filter import CommandFilter, Reference, advance_filter, make_command_filter
from umbilical.control.motor.disturbance import advance_motor_disturbance, start_motor_disturbance
from umbilical.control.nominal import NominalMotor, make_nominal_motors
from umbilical.control.observers.disturbance import (
    Disturbance,
    DisturbanceMemory,
    advance_disturbance,
    disturbance_estimate,
    make_disturbance,
    start_disturbance,
)
from umbilical.control.observers.high_gain import (
    HighGain,
    HighGainMemory,
    advance_high_gain,
    derivative_estimate,
    make_high_gain,
    start_high_gain,
)
from umbilical.control.outer.boundary import Station, boundary_error, boundary_thrust, make_station
from umbilical.control.outer.pd import pd_thrust
from umbilical.control.outer.table import LAWS, NONE, PD
from umbilical.frames import Frame, integer, part, real
from umbilical.relations.tension import Hanging, hanging, net_gravity, tension
from umbilical.relations.water import in_water
from umbilical.scenario.control import MotorLoop
from umbilical.scenario.scenario import Scenario


class Outer(NamedTuple):
    """Settings of the outer law; gains are (k_p, k_d) or (k_a, beta)."""

    law: int
    gains: tuple[float, float]
    ideal_rates: bool
    payload_mass: float
    payload_damping: float
    gravity: float
    hanging: Hanging
    station: Station
    quadratic_drag: float
    velocity_observer: HighGain
    slope_observer: HighGain
    disturbance: Disturbance


class Motors(NamedTuple):
    """Settings of allocation and motor loops; ``nominal`` is one record per motor."""

    driven: bool
    nominal: NominalMotor
    adaptation: Adaptation
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
    velocity = part(HighGainMemory)
    slope = part(HighGainMemory)
    disturbance = part(DisturbanceMemory)
    slope_mean = real()


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


def make_settings(scenario: Scenario) -> CascadeSettings:
    """Settings of a scenario's built-in controller, from its nominal constants."""
    control = scenario.control
    outer_period = control.outer_period or control.period
    outer, motors = _outer_settings(scenario, outer_period), _motor_settings(scenario, outer_period)
    return CascadeSettings(outer, motors, round(outer_period / control.period))


def _outer_settings(scenario: Scenario, period: float) -> Outer:
    control, nominal = scenario.control, scenario.control.nominal
    law = LAWS[control.law.kind]
    mass = _believed(nominal.payload_mass, scenario.payload.mass)
    gravity = _believed(nominal.gravity, scenario.environment.gravity)
    water, weight = in_water(None, scenario.payload, None), nominal.payload_wet_weight or scenario.payload.wet_weight
    return Outer(
        law.number,
        law.gains(control.law),
        control.law.reads_rates,
        mass + water.body_added,
        _believed(nominal.payload_damping, scenario.payload.damping) + water.body_linear,
        gravity,
        hanging(mass, 0.0, gravity, weight, added=water.body_vertical),
        make_station(control.law, period),
        water.body_quadratic if getattr(control.law, "drag_feedforward", None) else 0.0,
        make_high_gain(control.velocity_observer, period),
        make_high_gain(control.slope_observer, period),
        make_disturbance(control.disturbance_observer, period),
    )


def _motor_settings(scenario: Scenario, outer_period: float) -> Motors:
    control, nominal = scenario.control, scenario.control.nominal
    loop, count = control.motor_loop, len(nominal.motors or scenario.motors)
    fields = {name: getattr(loop, name) if loop else 1.0 for name in Backstepping._fields}
    gain = loop.observer_gain if loop else 1.0
    return Motors(
        loop is not None and not scenario.ideal_thruster,
        make_nominal_motors(nominal, scenario.motors),
        make_adaptation(control.allocation, count, outer_period),
        _command_filter(loop, control.period),
        Backstepping(**fields),
        gain,
        exp(-gain * control.period),
    )


def _command_filter(loop: MotorLoop | None, period: float) -> CommandFilter:
    return make_command_filter(loop.filter_frequency if loop else 1.0, loop.root_width if loop else 1.0, period)


def _believed(nominal: float | None, truth: float) -> float:
    return truth if nominal is None else nominal


def with_known_factors(settings: CascadeSettings) -> CascadeSettings:
    """The same without adaptation, which needs the u_a that only the built-in boundary law computes."""
    adaptation = settings.motors.adaptation._replace(enabled=False)
    return settings._replace(motors=settings.motors._replace(adaptation=adaptation))


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
    start_high_gain(memory.velocity, tip.tip_displacement)
    start_high_gain(memory.slope, tip.tip_slope)
    memory.slope_mean = tip.tip_slope if outer.station.washout_rate > 0.0 else 0.0
    velocity = tip.tip_velocity if outer.ideal_rates else 0.0
    start_disturbance(outer.disturbance, memory.disturbance, outer.payload_mass, velocity)
    for i in range(motors.nominal.size):
        scaled_current = motors.nominal[i].current_scale * readings.motors[i].motor_current
        state.motors[i].motor_disturbance_state = start_motor_disturbance(motors.observer_gain, scaled_current)


@glue
def update(settings: CascadeSettings, state: CascadeState, readings: Readings, decision: Decision) -> None:
    """One update: the outer law on its own samples, the motor loops on every one."""
    if settings.outer.law != NONE:
        if state.outer[0].updates % settings.outer_every == 0:
            update_outer(settings.outer, state, readings, decision)
            if settings.motors.driven:
                allocate(settings.motors, state, decision)
        if settings.motors.driven:
            update_motors(settings.motors, state, readings, decision)
    state.outer[0].updates += 1


@kernel
def update_outer(s: Outer, state: CascadeState, readings: Readings, decision: Decision) -> None:
    """Estimate and decide: from the readings at the ROV to the commanded thrust."""
    tip, out, memory = readings.tip[0], decision.outer[0], state.outer[0]
    advance = memory.updates > 0
    if advance:
        advance_high_gain(s.velocity_observer, memory.velocity, tip.tip_displacement)
        advance_high_gain(s.slope_observer, memory.slope, tip.tip_slope)
    velocity = derivative_estimate(s.velocity_observer, memory.velocity)
    slope_rate = derivative_estimate(s.slope_observer, memory.slope)
    if s.ideal_rates:
        velocity, slope_rate = tip.tip_velocity, tip.tip_slope_rate
    out.tip_velocity_estimate = velocity
    out.tip_slope_rate_estimate = slope_rate
    if s.law == PD:
        out.thrust_command = pd_thrust(s.gains[0], s.gains[1], tip.tip_displacement, velocity)
        return
    if advance:
        memory.slope_mean += s.station.washout_share * (tip.tip_slope - memory.slope_mean)
    away, lasting = tip.tip_displacement - s.station.place, memory.slope_mean
    error = boundary_error(s.gains[1], velocity, tip.tip_slope - lasting) + s.station.gain * away
    pull = readings.winch[0].tip_tension
    if pull == 0.0:
        pull = tension(0.0, net_gravity(s.gravity, readings.winch[0].payout_acceleration), s.hanging)
    known = pull * tip.tip_slope + s.payload_damping * velocity + s.quadratic_drag * abs(velocity) * velocity
    if advance:
        held = out.thrust_command
        advance_disturbance(s.disturbance, memory.disturbance, s.payload_mass, velocity, error, known - held)
    estimate = disturbance_estimate(s.disturbance, memory.disturbance, s.payload_mass, velocity)
    out.boundary_error = error
    out.disturbance_estimate = estimate
    changing = slope_rate - s.station.washout_rate * (tip.tip_slope - lasting)
    held_back = s.station.gain * s.payload_mass * velocity
    thrust = boundary_thrust(s.gains[0], s.gains[1], s.payload_mass, error, changing, known, estimate)
    out.thrust_command = thrust - held_back


@glue
def allocate(s: Motors, state: CascadeState, decision: Decision) -> None:
    """Demands on the motors from the commanded thrust."""
    outer = decision.outer[0]
    if s.adaptation.enabled:
        if state.outer[0].updates > 0:
            adapt(s.adaptation, state.kappa, outer.thrust_command, outer.boundary_error)
        adaptive_demand(s.nominal, state.kappa, outer.thrust_command, decision.motors)
    else:
        known_demand(s.nominal, outer.thrust_command, decision.motors)


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
