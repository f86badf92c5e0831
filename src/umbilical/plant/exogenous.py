"""Everything that acts on the plant from outside, sampled at the steps of a stretch of the run.

Signals, winch and faults are ordinary numpy here; the kernels read arrays. A new signal, winch law or
fault therefore needs no kernel. Columns are start, (middle) and end of each step; at a published jump the
end of one step takes the value before it and the start of the next the value after it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from umbilical.plant import faults, signals, winch
from umbilical.plant.layout import positions
from umbilical.relations.instants import slack
from umbilical.scenario.environment import GaussianProfile, Profile, SineProfile, TableProfile
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.winch import Winch

Array = np.ndarray


@dataclass(frozen=True, eq=False)
class Steps:
    """Consecutive steps of the plant: ``start`` and ``end``, s, shape (steps,); ``jumps`` published among them.

    Never changed, and known by identity. Where runs share them, what was sampled is kept.
    """

    start: Array
    end: Array
    jumps: Array
    shared: bool = False


START, MIDDLE, END = range(3)
# Rows of Inputs.world.
LENGTH, SPEED, ACCELERATION, NET_GRAVITY, JERK_RATIO, VESSEL, VESSEL_VELOCITY, FORCE = range(8)
# Rows of Inputs.motors.
TORQUE, VOLTAGE, EFFECTIVENESS, STUCK, DRIVE_EFFECTIVENESS, DRIVE_STUCK = range(6)


class Inputs(NamedTuple):
    """What acts from outside: the last dimension is the step, the one before its start, middle and end.

    Attributes:
        dt: length of the step, s, shape (steps,).
        refresh: whether something jumped at its start, so that forces must be evaluated anew.
        world: winch l, v, a; g - a; a'/(g - a); vessel e, e'; force on the ROV d: shape (8, 3, steps).
        motors: d1 and d2; effectiveness and stuck value of the thrust, then of the drive: (6, motors, 3, steps).
        loads: signals of the loads along the cable, N/m, shape (loads, 3, steps).
    """

    dt: Array
    refresh: Array
    world: Array
    motors: Array
    loads: Array


def published_jumps(scenario: Scenario) -> tuple[float, ...]:
    """Every instant within the run at which something outside jumps, increasing, s."""
    environment = scenario.environment
    named = [
        environment.payload_force,
        environment.vessel_motion,
        *(load.signal for load in environment.cable_load),
        *(m.torque_disturbance for m in scenario.motors),
        *(m.voltage_disturbance for m in scenario.motors),
    ]
    instants = {t for signal in named for t in signals.jumps(signal)}
    instants |= {environment.vessel_ramp} | set(winch.jumps(scenario.winch))
    instants |= set(faults.jumps(scenario.faults, scenario.duration))
    found: list[float] = []
    for t in sorted(t for t in instants if 0.0 <= t <= scenario.duration):
        if not found or t - found[-1] > slack(t):  # what differs by round-off is one instant
            found.append(t)
    return tuple(found)


def profile(shape: Profile, sigma: Array) -> Array:
    """A load's profile at positions ``sigma = x/l``, same shape."""
    match shape:
        case SineProfile():
            return np.sin(shape.half_waves * np.pi * sigma)
        case GaussianProfile():
            return np.exp(-(((sigma - shape.center) / shape.width) ** 2))
        case TableProfile():
            return np.interp(sigma, shape.positions, shape.values)
        case _:
            return np.ones_like(sigma)


def profiles(scenario: Scenario) -> Array:
    """Profiles of all loads along the cable, shape (loads, 4 n + 1)."""
    sigma = positions(scenario.grid.elements)
    rows = [profile(load.profile, sigma) for load in scenario.environment.cable_load]
    return np.array(rows) if rows else np.zeros((0, 4 * scenario.grid.elements + 1))


class Outside:
    """Samples the outside world of a scenario, stretch by stretch, into the same arrays."""

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario
        self._inputs = _empty(scenario, 0)

    def sample(self, steps: Steps) -> Inputs:
        """All inputs at the given steps. The arrays are used again by the next call."""
        count = steps.start.size
        if self._inputs.dt.size != count:
            self._inputs = _empty(self._scenario, count)
        inputs, environment = self._inputs, self._scenario.environment
        np.subtract(steps.end, steps.start, out=inputs.dt)
        inputs.refresh[:] = np.isin(steps.start, steps.jumps) if steps.jumps.size else False
        inputs.world[: JERK_RATIO + 1] = _kept(_winch_at, steps)(self._scenario.winch, environment.gravity, steps)
        if environment.vessel_motion:
            motion = inputs.world[VESSEL : VESSEL_VELOCITY + 1]
            _fill(motion, lambda t, side: signals.vessel(environment, t, side), steps, middle=False)
        _fill_signal(inputs.world[FORCE], environment.payload_force, steps, middle=False)
        for row, load in zip(inputs.loads, environment.cable_load, strict=True):
            _fill_signal(row, load.signal, steps, middle=False)
        self._sample_motors(steps, inputs.motors)
        return inputs

    def _sample_motors(self, steps: Steps, out: Array) -> None:
        for k, motor in enumerate(self._scenario.motors):
            _fill_signal(out[TORQUE, k], motor.torque_disturbance, steps)
            _fill_signal(out[VOLTAGE, k], motor.voltage_disturbance, steps)
        for number in sorted({fault.motor for fault in self._scenario.faults}):
            of_motor = out[:, number - 1]
            self._sample_faults(number, "thrust", steps, of_motor[EFFECTIVENESS : STUCK + 1])
            self._sample_faults(number, "voltage", steps, of_motor[DRIVE_EFFECTIVENESS : DRIVE_STUCK + 1])

    def _sample_faults(self, number: int, target: faults.Target, steps: Steps, out: Array) -> None:
        timeline = self._scenario.faults
        _fill(out, lambda t, side: faults.effect(timeline, number, target, t, side), steps)


def _empty(scenario: Scenario, steps: int) -> Inputs:
    """Nothing acts, and every motor is healthy."""
    motors = _step_by_step(steps, 6, len(scenario.motors), 3)
    motors[EFFECTIVENESS] = motors[DRIVE_EFFECTIVENESS] = 1.0
    loads = _step_by_step(steps, len(scenario.environment.cable_load), 3)
    return Inputs(np.zeros(steps), np.zeros(steps, dtype=np.bool_), _step_by_step(steps, 8, 3), motors, loads)


def _step_by_step(steps: int, *shape: int) -> Array:
    """Zeros of shape (..., steps) that lie in memory step after step: a kernel reads one stretch, not fifty rows."""
    return np.moveaxis(np.zeros((steps, *shape)), 0, -1)


# The runs of a study share the winch and most signals, and these cost a sixth of a run: kept by steps and record.
@lru_cache(maxsize=16)
def _winch_at(law: Winch, gravity: float, steps: Steps) -> Array:
    """Winch and what follows from it, rows LENGTH to JERK_RATIO of the world."""

    def motion(t: Array, side: signals.Side) -> Sequence[Array]:
        length, speed, acceleration, jerk = winch.evaluate(law, t, side)
        net_gravity = gravity - acceleration
        return length, speed, acceleration, net_gravity, jerk / net_gravity

    rows = np.zeros((JERK_RATIO + 1, 3, steps.start.size))
    _fill(rows, motion, steps, middle=False)
    return rows


@lru_cache(maxsize=64)
def _signal_at(signal: signals.Signal, steps: Steps, middle: bool) -> Array:
    rows = np.zeros((1, 3, steps.start.size))
    _fill(rows, lambda t, side: (signals.evaluate(signal, t, side),), steps, middle=middle)
    return rows[0]


def _kept(function: Any, steps: Steps) -> Callable[..., Array]:
    """The function with its memory, or without it at steps that will not come again."""
    return function if steps.shared else function.__wrapped__


def _fill_signal(row: Array, signal: signals.Signal, steps: Steps, *, middle: bool = True) -> None:
    """A signal into ``row``, shape (3, steps); the rows of absent signals stay zero."""
    if signal:
        row[:] = _kept(_signal_at, steps)(signal, steps, middle)


def _fill(
    rows: Array, function: Callable[[Array, signals.Side], Sequence[Array]], steps: Steps, *, middle: bool = True
) -> None:
    """Functions of time into ``rows``, shape (functions, 3, steps); only motors look at the ``middle``."""
    if middle:
        for row, values in zip(rows, function(0.5 * (steps.start + steps.end), "right"), strict=True):
            row[MIDDLE] = values
    if steps.jumps.size:
        starts, ends = function(steps.start, "right"), function(steps.end, "left")
    else:  # nothing jumps: each knot serves as the end of one step and the start of the next
        knots = function(np.append(steps.start, steps.end[-1]), "right")
        starts, ends = [k[:-1] for k in knots], [k[1:] for k in knots]
    for row, start, end in zip(rows, starts, ends, strict=True):
        row[START], row[END] = start, end
