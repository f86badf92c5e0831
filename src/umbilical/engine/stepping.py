"""One step of the plant: cable and ROV by a multistep method, motors by Runge-Kutta; works are added up."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import entry_kernel, glue
from umbilical.control.contract import MotorDecision
from umbilical.plant.cable import (
    ENDS,
    PRESENT,
    RATES,
    TIP_DISPLACEMENT,
    TIP_RATES,
    TIP_VELOCITY,
    Cable,
    add_up_displacement,
    evaluate,
    look_at_ends,
    make_blocks,
    make_cable,
    march,
)
from umbilical.plant.exogenous import (
    DRIVE_EFFECTIVENESS,
    DRIVE_STUCK,
    EFFECTIVENESS,
    END,
    FORCE,
    JERK_RATIO,
    LENGTH,
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
from umbilical.plant.initial import initial_slopes
from umbilical.plant.motors import advance_motor, applied_voltage, make_motor_state, make_motors, thrust
from umbilical.plant.multistep import EXPLICIT, IMPLICIT, KNOWN
from umbilical.plant.power import (
    ALONG_TERMS,
    END_TERMS,
    PAYLOAD_FORCE,
    TENSION,
    THRUST,
    add_power,
    book_along,
    book_at_ends,
    strain_of_elements,
)
from umbilical.plant.signals import vessel
from umbilical.scenario.scenario import Scenario

DELIVERED = 8
"""Place of the delivered thrust in PlantState.now; the places before it are the rows of Inputs.world."""
NOW, SINCE_START = range(2)
"""Rows of PlantState.power_ends, power_along and losses: power now, and its integral."""
AGE, NEWEST = range(2)
"""Places in PlantState.history: rates known before the present one, and the place of the last of them."""
STEP, JERK = range(2)
"""Places in PlantState.last."""
AT_START, MEAN, BEFORE = range(3)
"""Rows of PlantState.acting: thrust and force on the ROV at the start of a step, in its mean, one step before."""


class Plant(NamedTuple):
    """Constants of everything that moves; ``ideal`` delivers the commanded thrust as it is.

    ``booked`` adds up what the power balance needs along the cable; the motion does not depend on it.
    ``explicit`` and ``implicit`` are the weights of the multistep method, see ``plant/multistep.py``.
    """

    cable: Cable
    motors: np.ndarray
    ideal: bool
    booked: bool
    explicit: np.ndarray
    implicit: np.ndarray


class PlantState(NamedTuple):
    """Everything that moves, and the outside world at the present instant.

    Attributes:
        blocks: slopes and velocities, their last rates and their fluxes, shape (5, 5, 2 n), see ``plant/cable.py``.
        faces: flux where elements meet, shape (2, 2 n).
        losses: power that the grid takes at each interface, W, and its integral, J, shape (2, n + 1).
        ends: ROV and vessel's end, shape (7,).
        starts: displacement at the interfaces, m, shape (n + 1,).
        history: how many rates are known, and where the newest is, shape (2,).
        last: length of the last step, s, and a'/(g - a) at its end, 1/s, shape (2,).
        acting: thrust and force on the ROV, N, shape (3, 2).
        weights: of the rates in the present step, s, shape (3,).
        motors: speeds and currents, shape (2, motors).
        now: rows of ``Inputs.world`` at the present instant, then the delivered thrust, shape (9,).
        motors_now: rows of ``Inputs.motors`` at the present instant, shape (6, motors).
        loads: loads along the cable at the present instant, N/m, shape (loads,).
        power_ends: terms of the power balance at ROV and vessel, W, and their integrals, J, shape (2, 4).
        power_along: likewise along the cable, element by element, shape (2, 3, n).
        drive: voltage U + d2 and torque d1 of one motor over a step, shape (2, 3).
    """

    blocks: np.ndarray
    faces: np.ndarray
    losses: np.ndarray
    ends: np.ndarray
    starts: np.ndarray
    history: np.ndarray
    last: np.ndarray
    acting: np.ndarray
    weights: np.ndarray
    motors: np.ndarray
    now: np.ndarray
    motors_now: np.ndarray
    loads: np.ndarray
    power_ends: np.ndarray
    power_along: np.ndarray
    drive: np.ndarray


def make_plant(scenario: Scenario, *, booked: bool = True) -> Plant:
    """The true plant of a scenario."""
    cable, motors = make_cable(scenario, profiles(scenario)), make_motors(scenario.motors)
    return Plant(cable, motors, scenario.ideal_thruster, booked, EXPLICIT, IMPLICIT)


def make_plant_state(scenario: Scenario) -> PlantState:
    """The plant at rest in its initial shape."""
    n, loads, elements = len(scenario.motors), len(scenario.environment.cable_load), scenario.grid.elements
    state = PlantState(
        blocks=make_blocks(initial_slopes(scenario)),
        faces=np.zeros((2, 2 * elements)),
        losses=np.zeros((2, elements + 1)),
        ends=np.zeros(ENDS),
        starts=np.zeros(elements + 1),
        history=np.zeros(2, dtype=np.int64),
        last=np.zeros(2),
        acting=np.zeros((3, 2)),
        weights=np.zeros(3),
        motors=make_motor_state(n),
        now=np.zeros(DELIVERED + 1),
        motors_now=np.zeros((6, n)),
        loads=np.zeros(loads),
        power_ends=np.zeros((2, END_TERMS)),
        power_along=np.zeros((2, ALONG_TERMS, elements)),
        drive=np.zeros((2, 3)),
    )
    state.now[VESSEL] = vessel(scenario.environment, 0.0)[0]
    add_up_displacement(state.blocks[PRESENT], state.starts, state.now[VESSEL])
    state.ends[TIP_DISPLACEMENT] = state.starts[elements]
    return state


@entry_kernel
def enter_step(plant: Plant, state: PlantState, inputs: Inputs, i: int) -> None:
    """The outside world just after the start of step i, where something jumped: rates before it no longer count.

    Where nothing jumped, all is as the last step left it, and this is not called.
    """
    before = state.now[NET_GRAVITY]
    look_outside(state, inputs, i, START)
    book_tension_jump(plant, state, before)
    state.history[AGE] = 0
    if not plant.ideal:
        state.now[DELIVERED] = present_thrust(plant, state)
    settle(plant, state, 0.0)


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
        power, work = state.power_along[NOW, TENSION], state.power_along[SINCE_START, TENSION]
        strain_of_elements(plant.cable, state.blocks[PRESENT], power, work, 0.0, state.now[LENGTH], after, 0.5)
        add_power(work, power, 1.0 - before / after)


@glue
def settle(plant: Plant, state: PlantState, half: float) -> None:
    """What follows from the present state: displacement, slopes at both ends, powers, and their works.

    ``half`` is half of the step that ends here; 0 after a jump.
    """
    now, cable, x, ends = state.now, plant.cable, state.blocks[PRESENT], state.ends
    length, speed, gravity, vessel = now[LENGTH], now[SPEED], now[NET_GRAVITY], now[VESSEL_VELOCITY]
    add_up_displacement(x, state.starts, now[VESSEL])
    ends[TIP_DISPLACEMENT] = state.starts[state.starts.size - 1]
    look_at_ends(cable, x, ends, length, speed, gravity, vessel)
    power, work = state.power_ends[NOW], state.power_ends[SINCE_START]
    book_at_ends(cable, ends, power, work, half, length, speed, gravity, vessel)
    if plant.booked:
        along, done = state.power_along[NOW], state.power_along[SINCE_START]
        book_along(cable, x, along, done, half, length, gravity, now[JERK_RATIO], state.last[JERK], state.loads)
    state.last[JERK] = now[JERK_RATIO]


@glue
def advance_motors(plant: Plant, state: PlantState, inputs: Inputs, i: int, decision: MotorDecision) -> None:
    """All motors over step i under the voltages that are held."""
    drive = state.drive
    for k in range(decision.size):
        for c in range(3):
            share, stuck = inputs.motors[DRIVE_EFFECTIVENESS, k, c, i], inputs.motors[DRIVE_STUCK, k, c, i]
            reached = applied_voltage(plant.motors, k, decision[k].motor_voltage, share, stuck)
            drive[0, c] = reached + inputs.motors[VOLTAGE, k, c, i]
            drive[1, c] = inputs.motors[TORQUE, k, c, i]
        advance_motor(plant.motors, state.motors, k, inputs.dt[i], drive[0], drive[1])


@glue
def march_cable(plant: Plant, state: PlantState, newest: int) -> None:
    """Cable and ROV by ``state.weights`` of the newest rate, which is evaluated here, and the two before it."""
    now, cable, blocks, ends, weights = state.now, plant.cable, state.blocks, state.ends, state.weights
    length, speed, gravity, vessel = now[LENGTH], now[SPEED], now[NET_GRAVITY], now[VESSEL_VELOCITY]
    evaluate(cable, blocks, state.faces, state.losses[NOW], ends, newest, length, speed, gravity, vessel, state.loads)
    old, older = (newest + 2) % 3, (newest + 1) % 3
    loss = speed / length + cable.damping / cable.line_density
    march(
        blocks[PRESENT], blocks[RATES + newest], blocks[RATES + old], blocks[RATES + older], cable.moving, loss, weights
    )
    rates = ends[TIP_RATES : TIP_RATES + 3]
    ends[TIP_VELOCITY] += weights[0] * rates[newest] + weights[1] * rates[old] + weights[2] * rates[older]


@entry_kernel
def find_rates(plant: Plant, state: PlantState) -> None:
    """Rates at the present state into the first of their places; the state stays as it is."""
    settle(plant, state, 0.0)
    state.weights[0], state.weights[1], state.weights[2] = 0.0, 0.0, 0.0
    march_cable(plant, state, 0)


@glue
def advance_cable(plant: Plant, state: PlantState, dt: float) -> None:
    """From the rates of the present and two past instants to the end of the step, without the forces on the ROV."""
    for k in range(state.weights.size):
        state.weights[k] = dt * plant.explicit[state.history[AGE], k]
    march_cable(plant, state, (state.history[NEWEST] + 1) % 3)
    if plant.booked:
        add_power(state.losses[SINCE_START], state.losses[NOW], dt)


@glue
def push_payload(plant: Plant, state: PlantState, dt: float) -> None:
    """Impulse of thrust and force on the ROV over a step; their means are left for the work they do.

    Values one step before count unless something jumped since; an ideal thruster holds its thrust.
    """
    now, start, mean, before = state.now, state.acting[AT_START], state.acting[MEAN], state.acting[BEFORE]
    w = plant.implicit[min(state.history[AGE], 1)]
    mean[0] = w[0] * now[DELIVERED] + w[1] * start[0] + w[2] * before[0]
    mean[1] = w[0] * now[FORCE] + w[1] * start[1] + w[2] * before[1]
    if plant.ideal:
        mean[0] = start[0]
    before[0], before[1] = start[0], start[1]
    state.ends[TIP_VELOCITY] += dt * (mean[0] + mean[1]) / plant.cable.payload_mass


@glue
def correct_first_step(plant: Plant, state: PlantState, dt: float) -> None:
    """After a jump there is no past: the mean of the rates at both ends (Heun, order 2) replaces the first."""
    now, x = state.now, state.blocks[PRESENT]
    look_at_ends(plant.cable, x, state.ends, now[LENGTH], now[SPEED], now[NET_GRAVITY], now[VESSEL_VELOCITY])
    state.weights[0], state.weights[1], state.weights[2] = 0.5 * dt, -0.5 * dt, 0.0
    march_cable(plant, state, (state.history[NEWEST] + 2) % 3)


@glue
def advance(plant: Plant, state: PlantState, inputs: Inputs, i: int, decision: MotorDecision) -> None:
    """Step i, from :func:`enter_step` on: the multistep method for cable and ROV, Runge-Kutta for the motors."""
    dt, now, history = inputs.dt[i], state.now, state.history
    if abs(dt - state.last[STEP]) > 1e-9 * dt:  # the weights are those of equal steps
        history[AGE] = 0
        state.last[STEP] = dt
    start, mean, before = state.acting[AT_START], state.acting[MEAN], state.ends[TIP_DISPLACEMENT]
    start[0], start[1] = now[DELIVERED], now[FORCE]
    advance_cable(plant, state, dt)
    look_outside(state, inputs, i, END)
    if not plant.ideal:
        advance_motors(plant, state, inputs, i, decision)
        now[DELIVERED] = present_thrust(plant, state)
    push_payload(plant, state, dt)
    if history[AGE] == 0:
        correct_first_step(plant, state, dt)
    history[NEWEST] = (history[NEWEST] + 1) % 3
    history[AGE] = min(history[AGE] + 1, KNOWN)
    settle(plant, state, 0.5 * dt)
    moved, work = state.ends[TIP_DISPLACEMENT] - before, state.power_ends[SINCE_START]
    work[THRUST] += mean[0] * moved
    work[PAYLOAD_FORCE] += mean[1] * moved
