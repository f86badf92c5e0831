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
from umbilical.control.contract import (
    BOUNDARY_ERROR,
    DEMAND,
    DISTURBANCE_ESTIMATE,
    MOTOR_CURRENT,
    MOTOR_DISTURBANCE,
    MOTOR_SPEED,
    PAYOUT_ACCELERATION,
    SLOPE_RATE_ESTIMATE,
    SPEED_REFERENCE,
    THRUST_COMMAND,
    TIP_DISPLACEMENT,
    TIP_SLOPE,
    TIP_SLOPE_RATE,
    TIP_VELOCITY,
    VELOCITY_ESTIMATE,
    VOLTAGE,
    Command,
    Decision,
    Measurement,
    Readings,
    make_decision,
    make_readings,
)
from umbilical.control.motor.backstepping import Backstepping, backstepping_drive
from umbilical.control.motor.command_filter import CommandFilter, advance_filter, make_command_filter
from umbilical.control.motor.disturbance import advance_motor_disturbance, start_motor_disturbance
from umbilical.control.observers.disturbance import (
    Disturbance,
    advance_disturbance,
    disturbance_estimate,
    make_disturbance,
    start_disturbance,
)
from umbilical.control.observers.high_gain import (
    HighGain,
    advance_high_gain,
    derivative_estimate,
    make_high_gain,
    start_high_gain,
)
from umbilical.control.outer.boundary import boundary_error, boundary_thrust
from umbilical.control.outer.pd import pd_thrust
from umbilical.relations.formulas import MotorConstants, motor_constants, tension
from umbilical.scenario.control import BoundaryLaw, MotorLoop, ProportionalDerivative
from umbilical.scenario.scenario import Scenario

NONE, PD, BOUNDARY = range(3)

# Places in CascadeState.outer and, per motor, in CascadeState.motors (the filter has the first three).
VELOCITY_MEMORY, SLOPE_MEMORY, PHI = 0, 2, 4
UPSILON, HELD_DRIVE = 3, 4
COEFFICIENT, LIMIT = range(2)  # rows of Motors.thrusters


class Outer(NamedTuple):
    """Settings of the outer law; gains are (k_p, k_d) or (k_a, beta)."""

    law: int
    gains: tuple[float, float]
    ideal_rates: bool
    payload_mass: float
    payload_damping: float
    gravity: float
    velocity_observer: HighGain
    slope_observer: HighGain
    disturbance: Disturbance


class Motors(NamedTuple):
    """Settings of allocation and motor loops.

    ``constants`` holds the seven of :class:`MotorConstants` for each motor, shape (n, 7); ``thrusters`` its
    believed K_T and voltage limit, shape (2, n).
    """

    driven: bool
    thrusters: np.ndarray
    adaptation: Adaptation
    constants: np.ndarray
    command_filter: CommandFilter
    backstepping: Backstepping
    observer_gain: float
    observer_decay: float


class CascadeSettings(NamedTuple):
    """Everything the built-in controller knows; ``outer_every`` counts periods between outer updates."""

    outer: Outer
    motors: Motors
    outer_every: int


class CascadeState(NamedTuple):
    """What the built-in controller remembers, arrays that its kernels change in place.

    Attributes:
        updates: updates so far, shape (1,).
        outer: pi1, pi2 of the velocity observer; chi1, chi2 of the slope observer; phi: shape (5,).
        kappa: adaptive allocation, shape (n + 1,).
        motors: w_d, w_d', w_d'' of the command filter; ups; held V: shape (n, 5).
    """

    updates: np.ndarray
    outer: np.ndarray
    kappa: np.ndarray
    motors: np.ndarray


def make_settings(scenario: Scenario) -> CascadeSettings:
    """Settings of a scenario's built-in controller, from its nominal constants."""
    control = scenario.control
    outer_period = control.outer_period or control.period
    outer, motors = _outer_settings(scenario, outer_period), _motor_settings(scenario, outer_period)
    return CascadeSettings(outer, motors, round(outer_period / control.period))


def _outer_settings(scenario: Scenario, period: float) -> Outer:
    control, nominal = scenario.control, scenario.control.nominal
    law, gains, ideal = NONE, (0.0, 0.0), False
    match control.law:
        case ProportionalDerivative() as pd:
            law, gains, ideal = PD, (pd.position_gain, pd.velocity_gain), pd.velocity == "sensor"
        case BoundaryLaw() as boundary:
            law, gains, ideal = BOUNDARY, (boundary.damping_gain, boundary.slope_gain), boundary.rates == "sensor"
    return Outer(
        law,
        gains,
        ideal,
        _believed(nominal.payload_mass, scenario.payload.mass),
        _believed(nominal.payload_damping, scenario.payload.damping),
        _believed(nominal.gravity, scenario.environment.gravity),
        make_high_gain(control.velocity_observer, period),
        make_high_gain(control.slope_observer, period),
        make_disturbance(control.disturbance_observer, period),
    )


def _motor_settings(scenario: Scenario, outer_period: float) -> Motors:
    control, nominal = scenario.control, scenario.control.nominal
    believed = nominal.motors or scenario.motors
    loop = control.motor_loop
    coefficients = nominal.thrust_coefficients or tuple(m.thrust_coefficient for m in believed)
    limits = [np.inf if m.voltage_limit is None else m.voltage_limit for m in believed]
    fields = {name: getattr(loop, name) if loop else 1.0 for name in Backstepping._fields}
    gain = loop.observer_gain if loop else 1.0
    return Motors(
        loop is not None and not scenario.ideal_thruster,
        np.array([coefficients, limits], dtype=float),
        make_adaptation(control.allocation, len(believed), outer_period),
        np.array([motor_constants(m) for m in believed], dtype=float).reshape(len(believed), 7),
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
    return CascadeState(np.zeros(1, dtype=np.int64), np.zeros(5), kappa, np.zeros((n, 5)))


@glue
def start(settings: CascadeSettings, state: CascadeState, readings: Readings) -> None:
    """Observers at rest on the first sample, filters at zero."""
    outer, motors, seen = settings.outer, settings.motors, readings.boundary
    state.updates[0] = 0
    start_high_gain(state.outer[VELOCITY_MEMORY:], seen[TIP_DISPLACEMENT])
    start_high_gain(state.outer[SLOPE_MEMORY:], seen[TIP_SLOPE])
    velocity = seen[TIP_VELOCITY] if outer.ideal_rates else 0.0
    start_disturbance(outer.disturbance, state.outer[PHI:], outer.payload_mass, velocity)
    for i in range(motors.constants.shape[0]):
        scaled_current = motors.constants[i, 6] * readings.motors[MOTOR_CURRENT, i]
        state.motors[i, UPSILON] = start_motor_disturbance(motors.observer_gain, scaled_current)


@glue
def update(settings: CascadeSettings, state: CascadeState, readings: Readings, decision: Decision) -> None:
    """One update: the outer law on its own samples, the motor loops on every one."""
    if settings.outer.law != NONE:
        if state.updates[0] % settings.outer_every == 0:
            update_outer(settings.outer, state, readings, decision)
            if settings.motors.driven:
                allocate(settings.motors, state, decision)
        if settings.motors.driven:
            update_motors(settings.motors, state, readings, decision)
    state.updates[0] += 1


@kernel
def update_outer(s: Outer, state: CascadeState, readings: Readings, decision: Decision) -> None:
    """Estimate and decide: from the readings at the ROV to the commanded thrust."""
    seen, out = readings.boundary, decision.outer
    advance = state.updates[0] > 0
    if advance:
        advance_high_gain(s.velocity_observer, state.outer[VELOCITY_MEMORY:], seen[TIP_DISPLACEMENT])
        advance_high_gain(s.slope_observer, state.outer[SLOPE_MEMORY:], seen[TIP_SLOPE])
    velocity = derivative_estimate(s.velocity_observer, state.outer[VELOCITY_MEMORY:])
    slope_rate = derivative_estimate(s.slope_observer, state.outer[SLOPE_MEMORY:])
    if s.ideal_rates:
        velocity, slope_rate = seen[TIP_VELOCITY], seen[TIP_SLOPE_RATE]
    out[VELOCITY_ESTIMATE] = velocity
    out[SLOPE_RATE_ESTIMATE] = slope_rate
    if s.law == PD:
        out[THRUST_COMMAND] = pd_thrust(s.gains[0], s.gains[1], seen[TIP_DISPLACEMENT], velocity)
        return
    error = boundary_error(s.gains[1], velocity, seen[TIP_SLOPE])
    pull = tension(0.0, s.gravity - seen[PAYOUT_ACCELERATION], s.payload_mass, 0.0)
    known = pull * seen[TIP_SLOPE] + s.payload_damping * velocity
    if advance:
        held = out[THRUST_COMMAND]
        advance_disturbance(s.disturbance, state.outer[PHI:], s.payload_mass, velocity, error, known - held)
    estimate = disturbance_estimate(s.disturbance, state.outer[PHI:], s.payload_mass, velocity)
    out[BOUNDARY_ERROR] = error
    out[DISTURBANCE_ESTIMATE] = estimate
    out[THRUST_COMMAND] = boundary_thrust(s.gains[0], s.gains[1], s.payload_mass, error, slope_rate, known, estimate)


@glue
def allocate(s: Motors, state: CascadeState, decision: Decision) -> None:
    """Demands on the motors from the commanded thrust."""
    thrust = decision.outer[THRUST_COMMAND]
    if s.adaptation.enabled:
        if state.updates[0] > 0:
            adapt(s.adaptation, state.kappa, thrust, decision.outer[BOUNDARY_ERROR])
        adaptive_demand(s.thrusters[COEFFICIENT], state.kappa, thrust, decision.motors[DEMAND])
    else:
        known_demand(s.thrusters[COEFFICIENT], thrust, decision.motors[DEMAND])


@kernel
def update_motors(s: Motors, state: CascadeState, readings: Readings, decision: Decision) -> None:
    """The loop of every motor: filter the demand, observe the disturbance, set the voltage."""
    k = s.constants
    for i in range(k.shape[0]):
        c = MotorConstants(k[i, 0], k[i, 1], k[i, 2], k[i, 3], k[i, 4], k[i, 5], k[i, 6])
        speed, scaled_current = readings.motors[MOTOR_SPEED, i], c.current_scale * readings.motors[MOTOR_CURRENT, i]
        memory = state.motors[i]
        if state.updates[0] > 0:
            advance_filter(s.command_filter, memory, decision.motors[DEMAND, i])
            memory[UPSILON] = advance_motor_disturbance(
                c, s.observer_gain, s.observer_decay, memory[UPSILON], speed, scaled_current, memory[HELD_DRIVE]
            )
        disturbance = memory[UPSILON] + s.observer_gain * scaled_current
        drive = backstepping_drive(c, s.backstepping, speed, scaled_current, memory) - disturbance
        voltage = min(max(drive / c.f23, -s.thrusters[LIMIT, i]), s.thrusters[LIMIT, i])
        memory[HELD_DRIVE] = c.f23 * voltage
        decision.motors[VOLTAGE, i] = voltage
        decision.motors[SPEED_REFERENCE, i] = memory[0]
        decision.motors[MOTOR_DISTURBANCE, i] = disturbance


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

    def start(self, measurement: Measurement) -> tuple[CascadeState, Decision]:
        """Memory and decision before the first update."""
        state = make_state(self._scenario)
        start(self._settings, state, to_readings(measurement))
        return state, make_decision(len(self._scenario.motors))

    def update(self, t: float, measurement: Measurement, state: Any) -> tuple[Command, Any]:
        """Thrust and voltages from the kernels; ``state`` is changed in place and handed back."""
        memory, decision = state
        update(self._settings, memory, to_readings(measurement), decision)
        thrust = float(decision.outer[THRUST_COMMAND])
        voltage = None if self._scenario.ideal_thruster else decision.motors[VOLTAGE].copy()
        return Command(thrust, voltage), state


def to_readings(m: Measurement) -> Readings:
    """A measurement as kernels take it; absent sensors read NaN."""
    readings = make_readings(m.motor_speed.size)
    velocity = np.nan if m.tip_velocity is None else m.tip_velocity
    slope_rate = np.nan if m.tip_slope_rate is None else m.tip_slope_rate
    readings.boundary[:] = (
        m.tip_displacement, m.tip_slope, velocity, slope_rate, m.length, m.payout_speed, m.payout_acceleration,
    )  # fmt: skip
    readings.motors[MOTOR_SPEED] = m.motor_speed
    readings.motors[MOTOR_CURRENT] = m.motor_current
    return readings
