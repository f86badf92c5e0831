"""Everything that acts on the plant from outside, sampled at the steps of a stretch of the run.

Signals, winch and faults are ordinary numpy here; the kernels read arrays. A new signal, winch law or
fault therefore needs no kernel. Columns are start, (middle) and end of each step; at a published jump the
end of one step takes the value before it and the start of the next the value after it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.plant import faults, signals, winch
from umbilical.plant.layout import positions
from umbilical.scenario.environment import GaussianProfile, Profile, SineProfile, TableProfile
from umbilical.scenario.scenario import Scenario

Array = np.ndarray


class Steps(NamedTuple):
    """Consecutive steps of the plant: ``start`` and ``end``, s, shape (steps,); ``jumps`` published among them."""

    start: Array
    end: Array
    jumps: Array


START, MIDDLE, END = range(3)
# Rows of Inputs.world.
LENGTH, SPEED, ACCELERATION, NET_GRAVITY, JERK_RATIO, VESSEL, VESSEL_VELOCITY, FORCE = range(8)
# Rows of Inputs.motors.
TORQUE, VOLTAGE, EFFECTIVENESS, STUCK, DRIVE_EFFECTIVENESS, DRIVE_STUCK = range(6)


class Inputs(NamedTuple):
    """What acts from outside; the first dimension is the step, the last one its start, middle and end.

    Attributes:
        dt: length of the step, s, shape (steps,).
        refresh: whether something jumped at its start, so that forces must be evaluated anew.
        world: winch l, v, a; g - a; a'/(g - a); vessel e, e'; force on the ROV d: shape (steps, 8, 3).
        motors: d1 and d2; effectiveness and stuck value of the thrust, then of the drive: (steps, 6, motors, 3).
        loads: signals of the loads along the cable, N/m, shape (steps, loads, 3).
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
    return tuple(sorted(t for t in instants if 0.0 <= t <= scenario.duration))


def profile(shape: Profile, elements: int) -> Array:
    """A load's profile at the nodes, shape (4 n + 1,)."""
    sigma = positions(elements)
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
    rows = [profile(load.profile, scenario.grid.elements) for load in scenario.environment.cable_load]
    return np.array(rows) if rows else np.zeros((0, 4 * scenario.grid.elements + 1))


def sample(scenario: Scenario, steps: Steps) -> Inputs:
    """All inputs at the given steps."""
    count = steps.start.size
    environment = scenario.environment
    motion = winch.WinchMotion(*(np.empty((count, 3)) for _ in winch.WinchMotion._fields))
    for column, t, side in _instants(steps):
        for row, values in zip(motion, winch.evaluate(scenario.winch, t, side), strict=True):
            row[:, column] = values
    world = np.zeros((count, 8, 3))
    world[:, LENGTH], world[:, SPEED], world[:, ACCELERATION] = motion.length, motion.speed, motion.acceleration
    world[:, NET_GRAVITY] = environment.gravity - motion.acceleration
    world[:, JERK_RATIO] = motion.jerk / world[:, NET_GRAVITY]
    if environment.vessel_motion:
        for column, t, side in _instants(steps):
            world[:, VESSEL, column], world[:, VESSEL_VELOCITY, column] = signals.vessel(environment, t, side)
    world[:, FORCE] = _signal(environment.payload_force, steps)
    loads = np.zeros((count, len(environment.cable_load), 3))
    for k, load in enumerate(environment.cable_load):
        loads[:, k] = _signal(load.signal, steps)
    refresh = np.isin(steps.start, steps.jumps)
    return Inputs(steps.end - steps.start, refresh, world, _motors(scenario, steps), loads)


def _instants(steps: Steps) -> tuple[tuple[int, Array, signals.Side], ...]:
    """Column, instants and side of the start, the middle and the end of all steps."""
    middle = 0.5 * (steps.start + steps.end)
    return (START, steps.start, "right"), (MIDDLE, middle, "right"), (END, steps.end, "left")


def _signal(signal: signals.Signal, steps: Steps) -> Array:
    """A signal at start, middle and end of every step, shape (steps, 3)."""
    out = np.zeros((steps.start.size, 3))
    if not signal:
        return out
    instants = _instants(steps)
    out[:, MIDDLE] = signals.evaluate(signal, instants[MIDDLE][1])
    if steps.jumps.size:
        for column, t, side in (instants[START], instants[END]):
            out[:, column] = signals.evaluate(signal, t, side)
    else:  # nothing jumps: each knot serves as the end of one step and the start of the next
        knots = signals.evaluate(signal, np.append(steps.start, steps.end[-1]))
        out[:, START], out[:, END] = knots[:-1], knots[1:]
    return out


def _motors(scenario: Scenario, steps: Steps) -> Array:
    out = np.zeros((steps.start.size, 6, len(scenario.motors), 3))
    out[:, EFFECTIVENESS] = out[:, DRIVE_EFFECTIVENESS] = 1.0
    for k, motor in enumerate(scenario.motors):
        out[:, TORQUE, k] = _signal(motor.torque_disturbance, steps)
        out[:, VOLTAGE, k] = _signal(motor.voltage_disturbance, steps)
    for number in sorted({fault.motor for fault in scenario.faults}):
        for target, share, stuck in (("thrust", EFFECTIVENESS, STUCK), ("voltage", DRIVE_EFFECTIVENESS, DRIVE_STUCK)):
            for column, t, side in _instants(steps):
                out[:, share, number - 1, column], out[:, stuck, number - 1, column] = faults.effect(
                    scenario.faults, number, target, t, side
                )
    return out
