"""The sensors: from the truth at the ROV and in the motors to what the controller reads."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.control.contract import Readings
from umbilical.engine.stepping import PlantState
from umbilical.plant import cable
from umbilical.plant.exogenous import ACCELERATION, LENGTH, SPEED
from umbilical.plant.motors import CURRENT
from umbilical.plant.motors import SPEED as ROTOR_SPEED
from umbilical.scenario.scenario import Scenario

SCALARS = 4  # displacement, slope, velocity, slope rate; then speeds, then currents


# Rows of Sensors.errors.
BIAS, NOISE, RESOLUTION, LATENCY, DROPOUT = range(5)


class Sensors(NamedTuple):
    """Errors of every channel, shape (5, 4 + 2 n), latency in samples; ``perfect`` skips them all."""

    perfect: bool
    errors: np.ndarray


class SensorState(NamedTuple):
    """Last samples (the oldest is overwritten), the readings held through a drop-out, and the count of samples."""

    samples: np.ndarray
    held: np.ndarray
    count: np.ndarray


def make_sensors(scenario: Scenario) -> Sensors:
    """Sensors of a scenario; latency in whole control periods."""
    s, n = scenario.sensors, len(scenario.motors)
    channels = [s.tip_displacement, s.tip_slope, s.tip_velocity, s.tip_slope_rate]
    channels += [s.motor_speed] * n + [s.motor_current] * n
    period = scenario.control.period
    rows = [(c.bias, c.noise, c.resolution, round(c.latency / period), c.dropout) for c in channels]
    errors = np.array(rows, dtype=float).T.copy()
    return Sensors(not errors.any(), errors)


def make_sensor_state(sensors: Sensors) -> SensorState:
    """Nothing read yet."""
    depth, width = int(sensors.errors[LATENCY].max(initial=0)) + 1, sensors.errors.shape[1]
    return SensorState(np.zeros((depth, width)), np.zeros(width), np.zeros(1, dtype=np.int64))


class Dice:
    """Draws of noise and drop-outs, in the order of the updates: they do not depend on how a run is cut up."""

    def __init__(self, sensors: Sensors, seed: int) -> None:
        self._sensors, self._drawn = sensors, 0
        streams = np.random.SeedSequence(seed).spawn(2)
        self._noise, self._lost = (np.random.Generator(np.random.Philox(stream)) for stream in streams)

    def draw(self, updates: int) -> np.ndarray:
        """Noise of the next updates, shape (updates, channels), NaN where a reading is lost; none if perfect."""
        errors = self._sensors.errors
        if self._sensors.perfect:
            return np.zeros((0, errors.shape[1]))
        shape = (updates, errors.shape[1])
        noise = self._noise.standard_normal(shape) * errors[NOISE]
        lost = self._lost.random(shape) < errors[DROPOUT]
        lost[0] &= self._drawn > 0  # there is nothing to hold before the first reading
        self._drawn += updates
        return np.where(lost, np.nan, noise)


@kernel
def true_slope_rate(state: PlantState) -> float:
    """D(y_x)/Dt at the ROV: the slope of the velocity there, 1/s.

    With the ROV's velocity imposed as the flux imposes it; so it follows a jump of the thrust at the grid's pace.
    """
    x = state.blocks[cable.PRESENT]
    n = x.shape[1] // 2
    last, d = 2 * n - 1, cable.TIP_ROW
    slope = d[0] * x[0, last] + d[1] * x[1, last] + d[2] * x[2, last] + d[3] * x[3, last] + d[4] * x[4, last]
    slope += cable.LIFT * (state.ends[cable.TIP_VELOCITY] - x[4, last])
    return 2.0 * n / state.now[LENGTH] * slope


@glue
def read_truth(state: PlantState, readings: Readings) -> None:
    """Perfect readings."""
    tip, winch, ends = readings.tip[0], readings.winch[0], state.ends
    tip.tip_displacement = ends[cable.TIP_DISPLACEMENT]
    tip.tip_slope = ends[cable.TIP_SLOPE]
    tip.tip_velocity = ends[cable.TIP_VELOCITY]
    tip.tip_slope_rate = true_slope_rate(state)
    winch.length, winch.payout_speed = state.now[LENGTH], state.now[SPEED]
    winch.payout_acceleration = state.now[ACCELERATION]
    for k in range(readings.motors.size):
        readings.motors[k].motor_speed = state.motors[ROTOR_SPEED, k]
        readings.motors[k].motor_current = state.motors[CURRENT, k]


@kernel
def add_errors(s: Sensors, memory: SensorState, noise: np.ndarray, c: int, truth: float) -> float:
    """Reading of channel c: latency, bias, noise, resolution, drop-out, in this order."""
    depth, count = memory.samples.shape[0], memory.count[0]
    memory.samples[count % depth, c] = truth
    age = min(int(s.errors[LATENCY, c]), count)
    value = memory.samples[(count - age) % depth, c] + s.errors[BIAS, c] + noise[c]
    step = s.errors[RESOLUTION, c]
    if step > 0.0:
        value = np.rint(value / step) * step
    if not np.isnan(noise[c]):
        memory.held[c] = value
    return memory.held[c]


@kernel
def spoil(s: Sensors, memory: SensorState, noise: np.ndarray, readings: Readings) -> None:
    """Errors of every channel."""
    tip, n = readings.tip[0], readings.motors.size
    tip.tip_displacement = add_errors(s, memory, noise, 0, tip.tip_displacement)
    tip.tip_slope = add_errors(s, memory, noise, 1, tip.tip_slope)
    tip.tip_velocity = add_errors(s, memory, noise, 2, tip.tip_velocity)
    tip.tip_slope_rate = add_errors(s, memory, noise, 3, tip.tip_slope_rate)
    for k in range(n):
        motor = readings.motors[k]
        motor.motor_speed = add_errors(s, memory, noise, SCALARS + k, motor.motor_speed)
        motor.motor_current = add_errors(s, memory, noise, SCALARS + n + k, motor.motor_current)
    memory.count[0] += 1


@glue
def sense(s: Sensors, memory: SensorState, noise: np.ndarray, row: int, state: PlantState, readings: Readings) -> None:
    """One sample of all sensors into ``readings``; ``row`` is the update's row in ``noise``."""
    read_truth(state, readings)
    if not s.perfect:
        spoil(s, memory, noise[row], readings)
