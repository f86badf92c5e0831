"""The sensors: from the truth at the ROV and in the motors to what the controller reads."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.control.contract import Decision, MotorReadings, Readings, TipReadings
from umbilical.engine.stepping import PlantState
from umbilical.frames import Frame, as_array, integer, numbers, real
from umbilical.plant import cable
from umbilical.scenario.scenario import Scenario


class SensorError(Frame):
    """Errors of one channel; its latency is in samples."""

    sensor_bias = real()
    sensor_noise = real()
    sensor_resolution = real()
    latency_samples = integer()
    sensor_dropout = real()


class SensorErrors(NamedTuple):
    """Errors of every channel: those at the ROV, then a quantity of all motors after another; ``perfect``: none."""

    perfect: bool
    errors: SensorError


class SensorState(NamedTuple):
    """What sensors remember, and the readings that they spoil.

    Attributes:
        samples: last true values, the oldest is overwritten, shape (depth, channels).
        held: readings held through a drop-out, shape (channels,).
        count: samples so far, shape (1,).
        tip: the memory of ``Readings.tip`` as numbers, shape (4,).
        motors: the memory of ``Readings.motors`` as numbers, shape (motors, 2).
    """

    samples: np.ndarray
    held: np.ndarray
    count: np.ndarray
    tip: np.ndarray
    motors: np.ndarray


class Side(NamedTuple):
    """Sensors of one horizontal direction, and what is decided on their readings."""

    sensors: SensorErrors
    memory: SensorState
    readings: Readings
    decision: Decision


def make_sensors(scenario: Scenario) -> SensorErrors:
    """Sensors of a scenario; latency in whole control periods."""
    names = [*TipReadings.fields, *(name for name in MotorReadings.fields for _ in scenario.motors)]
    errors = SensorError.many(len(names))
    for k, name in enumerate(names):
        c = getattr(scenario.sensors, name)
        latency = round(c.latency / scenario.control.period)
        errors[k] = (c.bias, c.noise, c.resolution, latency, c.dropout)
    return SensorErrors(not any(any(numbers(error)) for error in errors), errors)


def make_sensor_state(sensors: SensorErrors, readings: Readings) -> SensorState:
    """Nothing read yet."""
    depth, width = int(sensors.errors["latency_samples"].max(initial=0)) + 1, sensors.errors.size
    tip, motors = as_array(readings.tip)[0], as_array(readings.motors)
    return SensorState(np.zeros((depth, width)), np.zeros(width), np.zeros(1, dtype=np.int64), tip, motors)


class NoiseSource:
    """Draws of noise and drop-outs, in the order of the updates: they do not depend on how a run is cut up."""

    def __init__(self, sensors: SensorErrors, seed: int | tuple[int, int]) -> None:
        self._sensors, self._drawn = sensors, 0
        streams = np.random.SeedSequence(seed).spawn(2)
        self._noise, self._lost = (np.random.Generator(np.random.Philox(stream)) for stream in streams)

    def save(self) -> tuple[Any, ...]:
        """How far the draws have come."""
        return self._drawn, self._noise.bit_generator.state, self._lost.bit_generator.state

    def restore(self, mark: tuple[Any, ...]) -> None:
        """Go on from where :meth:`save` was called."""
        self._drawn, self._noise.bit_generator.state, self._lost.bit_generator.state = mark

    def draw(self, updates: int) -> np.ndarray:
        """Noise of the next updates, shape (updates, channels), NaN where a reading is lost; none if perfect."""
        errors = self._sensors.errors
        if self._sensors.perfect:
            return np.zeros((0, errors.size))
        shape = (updates, errors.size)
        noise = self._noise.standard_normal(shape) * errors["sensor_noise"]
        lost = self._lost.random(shape) < errors["sensor_dropout"]
        lost[0] &= self._drawn > 0  # there is nothing to hold before the first reading
        self._drawn += updates
        return np.where(lost, np.nan, noise)


@kernel
def true_slope_rate(state: PlantState) -> float:
    """D(y_x)/Dt at the ROV: the slope of the velocity there, 1/s.

    With the ROV's velocity imposed as the flux imposes it; so it follows a jump of the thrust at the grid's pace.
    """
    x, slide = state.blocks[cable.PRESENT], state.now[0].ends.slip / state.now[0].outside.length
    n = x.shape[1] // 2
    last, d = 2 * n - 1, cable.TIP_ROW
    w0, w1, w2 = x[0, last] + slide * x[0, n - 1], x[1, last] + slide * x[1, n - 1], x[2, last] + slide * x[2, n - 1]
    w3, w4 = x[3, last] + slide * x[3, n - 1], x[4, last] + slide * x[4, n - 1]
    slope = d[0] * w0 + d[1] * w1 + d[2] * w2 + d[3] * w3 + d[4] * w4
    slope += cable.LIFT * (state.now[0].ends.tip_velocity - w4)
    return 2.0 * n / state.now[0].outside.length * slope


@glue
def read_truth(state: PlantState, readings: Readings) -> None:
    """Perfect readings."""
    tip, winch, ends, outside = readings.tip[0], readings.winch[0], state.now[0].ends, state.now[0].outside
    tip.tip_displacement = ends.tip_displacement
    tip.tip_slope = ends.tip_slope
    tip.tip_velocity = ends.tip_velocity
    tip.tip_slope_rate = true_slope_rate(state)
    winch.length, winch.payout_speed = outside.length, outside.payout_speed
    winch.payout_acceleration = outside.payout_acceleration
    for k in range(readings.motors.size):
        readings.motors[k].motor_speed = state.motors[k].motor_speed
        readings.motors[k].motor_current = state.motors[k].motor_current


@kernel
def add_errors(s: SensorErrors, memory: SensorState, noise: np.ndarray) -> None:
    """Errors of every channel on what was read of the truth."""
    tip, motors = memory.tip, memory.motors
    for c in range(tip.size):
        tip[c] = with_errors(s.errors[c], memory, noise, c, tip[c])
    for quantity in range(motors.shape[1]):
        for k in range(motors.shape[0]):
            c = tip.size + quantity * motors.shape[0] + k
            motors[k, quantity] = with_errors(s.errors[c], memory, noise, c, motors[k, quantity])
    memory.count[0] += 1


@kernel
def with_errors(error: SensorError, memory: SensorState, noise: np.ndarray, c: int, truth: float) -> float:
    """Reading of channel c: latency, bias, noise, resolution, drop-out, in this order."""
    depth, count = memory.samples.shape[0], memory.count[0]
    memory.samples[count % depth, c] = truth
    age = min(error.latency_samples, count)
    value = memory.samples[(count - age) % depth, c] + error.sensor_bias + noise[c]
    if error.sensor_resolution > 0.0:
        value = np.rint(value / error.sensor_resolution) * error.sensor_resolution
    if not np.isnan(noise[c]):
        memory.held[c] = value
    return memory.held[c]


@glue
def sense(
    s: SensorErrors, memory: SensorState, noise: np.ndarray, row: int, state: PlantState, readings: Readings
) -> None:
    """One sample of all sensors into ``readings``; ``row`` is the update's row in ``noise``."""
    read_truth(state, readings)
    if not s.perfect:
        add_errors(s, memory, noise[row])
