"""Everything that acts on the plant from outside, sampled at the steps of a stretch of the run.

Signals, winch and faults are ordinary numpy here; the kernels read arrays. A new signal, winch law or
fault therefore needs no kernel. Columns are start, (middle) and end of each step; at a published jump the
end of one step takes the value before it and the start of the next the value after it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
    """What acts from outside; the first dimension is the step, the second its start, middle and end.

    Attributes:
        dt: length of the step, s, shape (steps,).
        refresh: whether something jumped at its start, so that forces must be evaluated anew.
        world: winch l, v, a; g - a; a'/(g - a); vessel e, e'; force on the ROV d: shape (steps, 3, 8).
        motors: d1 and d2; effectiveness and stuck value of the thrust, then of the drive: (steps, 3, 6, motors).
        loads: signals of the loads along the cable, N/m, shape (steps, 3, loads).
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
    world = np.zeros((count, 3, 8))
    motion = _at_all(lambda t, side: winch.evaluate(scenario.winch, t, side), steps)
    for row, values in zip((LENGTH, SPEED, ACCELERATION), motion, strict=False):
        world[:, :, row] = values
    world[:, :, NET_GRAVITY] = environment.gravity - motion[2]
    world[:, :, JERK_RATIO] = motion[3] / world[:, :, NET_GRAVITY]
    if environment.vessel_motion:
        vessel = _at_all(lambda t, side: signals.vessel(environment, t, side), steps)
        world[:, :, VESSEL], world[:, :, VESSEL_VELOCITY] = vessel
    if environment.payload_force:
        world[:, :, FORCE] = _signal(environment.payload_force, steps)
    loads = np.zeros((count, 3, len(environment.cable_load)))
    for k, load in enumerate(environment.cable_load):
        loads[:, :, k] = _signal(load.signal, steps)
    refresh = np.zeros(count, dtype=np.bool_)
    refresh[np.isin(steps.start, steps.jumps)] = True
    return Inputs(steps.end - steps.start, refresh, world, _motors(scenario, steps), loads)


def _at_all(function: Callable[[Array, signals.Side], Sequence[Array]], steps: Steps) -> list[Array]:
    """Functions of time at start, middle and end of every step, each of shape (steps, 3)."""
    middle = function(0.5 * (steps.start + steps.end), "right")
    if steps.jumps.size:
        start, end = function(steps.start, "right"), function(steps.end, "left")
    else:  # nothing jumps: each knot serves as the end of one step and the start of the next
        knots = function(np.append(steps.start, steps.end[-1]), "right")
        start, end = [k[:-1] for k in knots], [k[1:] for k in knots]
    out = [np.empty((steps.start.size, 3)) for _ in middle]
    for values, *columns in zip(out, start, middle, end, strict=True):
        for place, column in enumerate(columns):
            values[:, place] = column
    return out


def _signal(signal: signals.Signal, steps: Steps) -> Array:
    """A signal at start, middle and end of every step, shape (steps, 3)."""
    return _at_all(lambda t, side: (signals.evaluate(signal, t, side),), steps)[0]


def _motors(scenario: Scenario, steps: Steps) -> Array:
    out = np.zeros((steps.start.size, 3, 6, len(scenario.motors)))
    out[:, :, EFFECTIVENESS] = out[:, :, DRIVE_EFFECTIVENESS] = 1.0
    for k, motor in enumerate(scenario.motors):
        for row, signal in ((TORQUE, motor.torque_disturbance), (VOLTAGE, motor.voltage_disturbance)):
            if signal:
                out[:, :, row, k] = _signal(signal, steps)
    for number in sorted({fault.motor for fault in scenario.faults}):
        _add_faults(scenario, number, steps, out[:, :, :, number - 1])
    return out


def _add_faults(scenario: Scenario, number: int, steps: Steps, out: Array) -> None:
    """Faults of one motor into ``out``, shape (steps, 3, 6)."""
    for target, share, stuck in (("thrust", EFFECTIVENESS, STUCK), ("voltage", DRIVE_EFFECTIVENESS, DRIVE_STUCK)):
        effects = _at_all(lambda t, side, of=target: faults.effect(scenario.faults, number, of, t, side), steps)
        out[:, :, share], out[:, :, stuck] = effects
