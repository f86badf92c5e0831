"""The rope with its motors and sensors: what the controller is held against, and what of it can be seen."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.control.contract import MotorDecision, TipReadings
from umbilical.engine.sensing import Side, add_errors
from umbilical.frames import Frame, part, real, vector
from umbilical.plant.exogenous import END, MIDDLE, START, Exogenous
from umbilical.plant.motors import MotorParameters, MotorState, advance_motor
from umbilical.plant.rope.operators import LIFT, D
from umbilical.plant.rope.operators import W as WEIGHTS
from umbilical.plant.rope.outside import RopeInputs
from umbilical.plant.rope.records import RopeConstants, RopeOutside, RopeState
from umbilical.plant.rope.step import advance_rope
from umbilical.plant.rope.water import stir
from umbilical.relations.formulas import signed_square


class RopePlant(NamedTuple):
    """Constants of everything that moves; ``directions`` of the motors' thrusts, unit vectors, shape (motors, 2)."""

    rope: RopeConstants
    motors: MotorParameters
    directions: np.ndarray
    ideal: bool
    booked: bool


class RopeNow(Frame):
    """The present instant: what acts from outside, what the thrusters give, and what of the rope can be seen."""

    outside = part(Exogenous)
    vessel_position = vector(3)
    body_position = vector(3)
    body_velocity = vector(3)
    body_thrust = vector(3)
    thrust_before = vector(3)
    tip_displacement = real()
    tip_velocity = real()
    tip_slope = real()
    tip_slope_rate = real()
    vessel_slope = real()
    thrust = real()
    top_tension = real()
    end_tension = real()
    lowest_tension = real()
    slack_length = real()


class RopePlantState(NamedTuple):
    """Everything that moves.

    Attributes:
        now: one record.
        across: what the sensors at the body would read without errors, in the direction y and in x, two records.
        motors: one record per motor.
        rope: cable and body.
        stage: what acts on the rope in the present step, shape (3,).
    """

    now: RopeNow
    across: TipReadings
    motors: MotorState
    rope: RopeState
    stage: RopeOutside


class RopeWorld(NamedTuple):
    """Plant and sensors; the motors' sensors are those of the direction x."""

    plant: RopePlant
    state: RopePlantState
    along: Side
    across: Side


@kernel
def give_thrust(plant: RopePlant, motors: MotorState, out: np.ndarray) -> None:
    """Delivered thrust of all motors, N, horizontal."""
    out[0], out[1], out[2] = 0.0, 0.0, 0.0
    for k in range(motors.size):
        motor, outside = motors[k], motors[k].outside
        amount = outside.effectiveness * signed_square(motor.motor_speed) + outside.stuck_thrust
        for i in range(2):
            out[i] += plant.motors[k].thrust_coefficient * amount * plant.directions[k, i]


@kernel
def take_plane(state: RopePlantState, inputs: RopeInputs, i: int, column: int) -> None:
    """Winch and motors' outside world at start or end of step i."""
    state.now[0].outside = inputs.plane.world[column, i]
    for k in range(state.motors.size):
        state.motors[k].outside = inputs.plane.motors[column, i, k]


@glue
def enter_rope_step(plant: RopePlant, state: RopePlantState, inputs: RopeInputs, i: int) -> None:
    """The outside world just after the start of step i, where something jumped."""
    take_plane(state, inputs, i, START)
    if not plant.ideal:
        give_thrust(plant, state.motors, state.now[0].body_thrust)
    state.rope.outside[0] = inputs.world[i, START]


@kernel
def push(state: RopePlantState, inputs: RopeInputs, i: int) -> None:
    """What acts on the rope in step i, with the thrust before it and now."""
    now = state.now[0]
    for s in range(3):
        share = 0.0 if s == 0 else (1.0 if s == 1 else 0.5)
        state.stage[s] = inputs.world[i, s]
        for k in range(3):
            before = now.thrust_before[k]
            state.stage[s].body_thrust[k] = before + share * (now.body_thrust[k] - before)


@glue
def advance_rope_plant(
    plant: RopePlant, state: RopePlantState, inputs: RopeInputs, i: int, decision: MotorDecision
) -> None:
    """Step i: the motors under their held voltages, then the rope under their thrust."""
    dt, now = inputs.plane.dt[i], state.now[0]
    for k in range(3):
        now.thrust_before[k] = now.body_thrust[k]
    for k in range(decision.size):
        middle, end = inputs.plane.motors[MIDDLE, i, k], inputs.plane.motors[END, i, k]
        advance_motor(plant.motors[k], state.motors[k], dt, decision[k].motor_voltage, middle, end)
    take_plane(state, inputs, i, END)
    if not plant.ideal:
        give_thrust(plant, state.motors, now.body_thrust)
    push(state, inputs, i)
    world = inputs.plane.world
    stir(inputs.water, state.stage, inputs.plane.orbits, world[START, i].wave_place, world[END, i].wave_place)
    advance_rope(plant.rope, state.rope, state.stage, inputs.loads[i], inputs.water, dt, plant.booked)


@kernel
def end_direction(rope: RopeState, out: TipReadings, now: RopeNow, i: int) -> None:
    """Displacement, slope and their material rates of the direction ``i`` at the body; 1/s for the slope's rate.

    The slope is the horizontal part of the tangent in which the tension pulls; its rate is P W_x/|p|, with the body's
    velocity imposed as the flux imposes it.
    """
    n, ends, length = rope.stretch.shape[1], rope.ends[0], rope.outside[0].length
    last, d, pulled = n - 1, D[4], 0.0
    for k in range(3):
        pulled += ends.end_pull[k] * ends.end_pull[k]
    slack = pulled < 1e-12
    inverse = 1.0 / (rope.stretch[4, last] * length) if slack else 1.0 / sqrt(pulled)
    along, rate, tangent = 0.0, 0.0, 0.0
    for k in range(3):
        w = (3 + k) * n + last
        x = rope.now
        slope = d[0] * x[0, w] + d[1] * x[1, w] + d[2] * x[2, w] + d[3] * x[3, w] + d[4] * x[4, w]
        slope = 2.0 * n * (slope + LIFT * (rope.body[0, k] - x[4, w]))
        t = inverse * (x[4, k * n + last] if slack else ends.end_pull[k])
        along += t * slope
        if k == i:
            rate, tangent = slope, t
    out.tip_displacement = rope.joints[i, n]
    out.tip_velocity = rope.body[0, i]
    out.tip_slope = tangent
    out.tip_slope_rate = (rate - along * tangent) / (rope.stretch[4, last] * length)


@kernel
def scan_tension(plant: RopeConstants, rope: RopeState, now: RopeNow) -> None:
    """Tension at both ends, the smallest along the cable, and the length that nothing pulls."""
    n, ends, slack, lowest = rope.stretch.shape[1], rope.ends[0], 0.0, np.inf
    for j in range(5):
        for e in range(n):
            s = rope.stretch[j, e]
            lowest = min(lowest, s)
            slack += 0.5 * WEIGHTS[j] / n if s <= 1.0 else 0.0
    now.lowest_tension = plant.stiffness * max(lowest - 1.0, 0.0)
    now.slack_length = slack * rope.outside[0].length
    top, end = 0.0, 0.0
    for k in range(3):
        top += ends.top_pull[k] * ends.top_pull[k]
        end += ends.end_pull[k] * ends.end_pull[k]
    now.top_tension, now.end_tension = sqrt(top), sqrt(end)


@glue
def look(plant: RopePlant, state: RopePlantState) -> None:
    """What can be seen of the rope at the present instant."""
    now, rope, n = state.now[0], state.rope, state.rope.stretch.shape[1]
    scan_tension(plant.rope, rope, now)
    along = state.across[1]
    end_direction(rope, along, now, 0)
    end_direction(rope, state.across[0], now, 1)
    now.tip_displacement, now.tip_velocity = along.tip_displacement, along.tip_velocity
    now.tip_slope, now.tip_slope_rate = along.tip_slope, along.tip_slope_rate
    now.vessel_slope = rope.ends[0].top_pull[0] / max(now.top_tension, 1e-12)
    now.thrust = now.body_thrust[0]
    for k in range(3):
        now.vessel_position[k] = rope.outside[0].vessel_position[k]
        now.body_position[k], now.body_velocity[k] = rope.joints[k, n], rope.body[0, k]


@glue
def sense_rope(world: RopeWorld, noise: np.ndarray, across: np.ndarray, row: int) -> None:
    """One sample of all sensors of both directions."""
    state, along, other = world.state, world.along, world.across
    look(world.plant, state)
    now = state.now[0]
    along.readings.tip[0] = state.across[1]
    other.readings.tip[0] = state.across[0]
    for k in range(along.readings.motors.size):
        along.readings.motors[k].motor_speed = state.motors[k].motor_speed
        along.readings.motors[k].motor_current = state.motors[k].motor_current
    for side in (along, other):
        winch = side.readings.winch[0]
        winch.length, winch.payout_speed = now.outside.length, now.outside.payout_speed
        winch.payout_acceleration, winch.tip_tension = now.outside.payout_acceleration, now.end_tension
    if not along.sensors.perfect:
        add_errors(along.sensors, along.memory, noise[row])
    if not other.sensors.perfect:
        add_errors(other.sensors, other.memory, across[row])
