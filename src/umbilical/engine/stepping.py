"""One step of the plant: motors first, then cable and ROV under the thrust they deliver; works are added up."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import entry_kernel, glue
from umbilical.plant.cable import (
    ACCELERATION as CABLE_ACCELERATION,
)
from umbilical.plant.cable import (
    DISPLACEMENT,
    FRESH,
    SLOPE,
    VELOCITY,
    Cable,
    correct,
    evaluate,
    kick_payload,
    leap,
    make_cable,
    make_fields,
)
from umbilical.plant.exogenous import (
    DRIVE_EFFECTIVENESS,
    DRIVE_STUCK,
    EFFECTIVENESS,
    END,
    FORCE,
    JERK_RATIO,
    LENGTH,
    MIDDLE,
    NET_GRAVITY,
    SPEED,
    START,
    STUCK,
    TORQUE,
    VESSEL,
    VESSEL_VELOCITY,
    VOLTAGE,
    Inputs,
    profiles,
)
from umbilical.plant.initial import initial_displacement
from umbilical.plant.motors import advance_motor, applied_voltage, make_motor_state, make_motors, thrust
from umbilical.plant.power import (
    ALONG_TERMS,
    END_TERMS,
    PAYLOAD_FORCE,
    TENSION,
    THRUST,
    add_power,
    mean_work,
    power_along,
    power_at_ends,
    strain_of_elements,
)
from umbilical.scenario.scenario import Scenario

DELIVERED = 8
"""Place of the delivered thrust in PlantState.now; the places before it are the rows of Inputs.world."""
PRESENT, SINCE_START = range(2)
"""Rows of PlantState.power_ends and power_along: power now, and its integral."""


class Plant(NamedTuple):
    """Constants of everything that moves; ``ideal`` delivers the commanded thrust as it is."""

    cable: Cable
    motors: np.ndarray
    ideal: bool


class PlantState(NamedTuple):
    """Everything that moves, and the outside world at the present instant.

    Attributes:
        fields: the cable, shape (7, 5, n + 1), see ``plant/cable.py``.
        motors: speeds and currents, shape (2, motors).
        now: rows of ``Inputs.world`` at the present instant, then the delivered thrust, shape (9,).
        motors_now: rows of ``Inputs.motors`` at the present instant, shape (6, motors).
        loads: loads along the cable at the present instant, N/m, shape (loads,).
        power_ends: terms of the power balance at ROV and vessel, W, and their integrals, J, shape (2, 4).
        power_along: likewise along the cable, element by element, shape (2, 3, n + 1).
        drive: voltage U + d2 and torque d1 of one motor over a step, shape (2, 3).
    """

    fields: np.ndarray
    motors: np.ndarray
    now: np.ndarray
    motors_now: np.ndarray
    loads: np.ndarray
    power_ends: np.ndarray
    power_along: np.ndarray
    drive: np.ndarray


def make_plant(scenario: Scenario) -> Plant:
    """The true plant of a scenario."""
    return Plant(make_cable(scenario, profiles(scenario)), make_motors(scenario.motors), scenario.ideal_thruster)


def make_plant_state(scenario: Scenario) -> PlantState:
    """The plant at rest in its initial shape."""
    n, loads = len(scenario.motors), len(scenario.environment.cable_load)
    fields = make_fields(initial_displacement(scenario))
    now = np.zeros(9)
    now[VESSEL] = fields[DISPLACEMENT, 0, 0]
    ends, along = np.zeros((2, END_TERMS)), np.zeros((2, ALONG_TERMS, fields.shape[2]))
    motors, motors_now = make_motor_state(n), np.zeros((6, n))
    return PlantState(fields, motors, now, motors_now, np.zeros(loads), ends, along, np.zeros((2, 3)))


@entry_kernel
def enter_step(plant: Plant, state: PlantState, inputs: Inputs, i: int) -> None:
    """The outside world just after the start of step i, where something jumped: forces are evaluated anew.

    Where nothing jumped, all is as the last step left it, and this is not called.
    """
    before = state.now[NET_GRAVITY]
    look_outside(state, inputs, i, START)
    book_tension_jump(plant, state, before)
    refresh(plant, state, CABLE_ACCELERATION)
    if not plant.ideal:
        state.now[DELIVERED] = present_thrust(plant, state)
    note_power(plant, state)


@glue
def look_outside(state: PlantState, inputs: Inputs, i: int, column: int) -> None:
    """The outside world at start or end of step i. At a start the vessel is where the last step left it."""
    for row in range(DELIVERED):
        if row != VESSEL or column == END:
            state.now[row] = inputs.world[row, column, i]
    for k in range(state.loads.size):
        state.loads[k] = inputs.loads[k, column, i]
    for row in range(state.motors_now.shape[0]):
        for k in range(state.motors_now.shape[1]):
            state.motors_now[row, k] = inputs.motors[row, k, column, i]


@glue
def present_thrust(plant: Plant, state: PlantState) -> float:
    """Thrust the motors deliver at the present instant, N."""
    return thrust(plant.motors, state.motors, state.motors_now[EFFECTIVENESS], state.motors_now[STUCK])


@glue
def book_tension_jump(plant: Plant, state: PlantState, before: float) -> None:
    """Book the energy that a jump of the winch acceleration adds to the strained cable; ``before`` is g - a."""
    after = state.now[NET_GRAVITY]
    if after != before and before > 0.0:
        strain = state.power_along[PRESENT, TENSION]
        strain_of_elements(plant.cable, state.fields, strain, state.now[LENGTH], after, 0.5)
        add_power(state.power_along[SINCE_START, TENSION], strain, 1.0 - before / after)


@glue
def refresh(plant: Plant, state: PlantState, target: int) -> None:
    """Forces on the cable at the present instant, into the field ``target``."""
    now = state.now
    evaluate(
        plant.cable, state.fields, target, now[LENGTH], now[SPEED], now[NET_GRAVITY], now[VESSEL_VELOCITY], state.loads
    )


@glue
def note_power(plant: Plant, state: PlantState) -> None:
    """Terms of the power balance at the present instant."""
    now, cable = state.now, plant.cable
    ends = state.power_ends[PRESENT]
    power_at_ends(cable, state.fields, ends, now[LENGTH], now[SPEED], now[NET_GRAVITY], now[VESSEL_VELOCITY])
    along = state.power_along[PRESENT]
    power_along(cable, state.fields, along, now[LENGTH], now[NET_GRAVITY], now[JERK_RATIO], state.loads)


@glue
def add_work(state: PlantState, time: float) -> None:
    """Let the present power work for ``time``: half a step after its start, half a step before its end."""
    add_power(state.power_ends[SINCE_START], state.power_ends[PRESENT], time)
    for term in range(ALONG_TERMS):
        add_power(state.power_along[SINCE_START, term], state.power_along[PRESENT, term], time)


@glue
def advance_motors(plant: Plant, state: PlantState, inputs: Inputs, i: int, voltage: np.ndarray) -> None:
    """All motors over step i under the held voltages, shape (motors,)."""
    drive = state.drive
    for k in range(voltage.size):
        for c in range(3):
            share, stuck = inputs.motors[DRIVE_EFFECTIVENESS, k, c, i], inputs.motors[DRIVE_STUCK, k, c, i]
            reached = applied_voltage(plant.motors, k, voltage[k], share, stuck)
            drive[0, c] = reached + inputs.motors[VOLTAGE, k, c, i]
            drive[1, c] = inputs.motors[TORQUE, k, c, i]
        advance_motor(plant.motors, state.motors, k, inputs.dt[i], drive[0], drive[1])


@glue
def advance(plant: Plant, state: PlantState, inputs: Inputs, i: int, voltage: np.ndarray) -> None:
    """Step i, from :func:`enter_step` on: velocity Verlet for cable and ROV, Runge-Kutta for the motors."""
    fields, now = state.fields, state.now
    elements = fields.shape[2] - 1
    dt = inputs.dt[i]
    delivered, force, tip = now[DELIVERED], now[FORCE], fields[VELOCITY, 0, elements]
    add_work(state, 0.5 * dt)
    kick_payload(plant.cable, fields, 0.5 * dt, now[LENGTH], now[DELIVERED] + now[FORCE])
    length, speed = inputs.world[LENGTH, MIDDLE, i], inputs.world[SPEED, MIDDLE, i]
    top_slope = 2.0 * elements / length * fields[SLOPE, 0, 0]
    fields[VELOCITY, 0, 0] = inputs.world[VESSEL_VELOCITY, MIDDLE, i] + speed * top_slope
    leap(plant.cable, fields, dt, length, speed)
    fields[DISPLACEMENT, 0, 0] = inputs.world[VESSEL, END, i]
    look_outside(state, inputs, i, END)
    if not plant.ideal:
        advance_motors(plant, state, inputs, i, voltage)
        now[DELIVERED] = present_thrust(plant, state)
    # The velocity at the end is predicted with the old forces of the cable, then corrected with the new ones.
    kick_payload(plant.cable, fields, 0.5 * dt, now[LENGTH], now[DELIVERED] + now[FORCE])
    refresh(plant, state, FRESH)
    correct(fields, 0.5 * dt)
    note_power(plant, state)
    add_work(state, 0.5 * dt)
    work, tip_end = state.power_ends[SINCE_START], fields[VELOCITY, 0, elements]
    work[THRUST] += mean_work(dt, delivered, now[DELIVERED], tip, tip_end)
    work[PAYLOAD_FORCE] += mean_work(dt, force, now[FORCE], tip, tip_end)
