"""One step of the plant: cable and ROV by a multistep method, motors by Runge-Kutta; works are added up."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import entry_kernel, glue, plain, rare_kernel
from umbilical.control.contract import MotorDecision
from umbilical.frames import Frame, integer, part, real, vector
from umbilical.plant.cable import (
    BLOCKS,
    PRESENT,
    RATES,
    CableConstants,
    Ends,
    add_up_displacement,
    at_moment,
    evaluate,
    look_at_ends,
    look_up_slowness,
    make_blocks,
    make_cable,
    make_faces,
    march,
)
from umbilical.plant.current import Flow, make_flow
from umbilical.plant.exogenous import END, MIDDLE, START, Exogenous, Inputs
from umbilical.plant.forces import given, tension
from umbilical.plant.forces.force import add_power
from umbilical.plant.forces.table import (
    Along,
    EndWorks,
    Forces,
    LastTension,
    along_cable,
    book_along,
    book_at_ends,
    flow_past,
    make_along,
    make_forces,
    on_payload,
)
from umbilical.plant.initial import initial_slopes
from umbilical.plant.layout import zeros
from umbilical.plant.motors import MotorParameters, MotorState, advance_motor, make_motors, thrust
from umbilical.plant.multistep import EXPLICIT, IMPLICIT, KNOWN
from umbilical.plant.top import vessel_at
from umbilical.relations.tension import tension as tension_at
from umbilical.scenario.scenario import Scenario

DRY, WET = False, True
"""Constants of the kernels: what only water does, or a sheave that heaves, is not compiled into a dry loop."""


class Push(Frame):
    """What pushes the ROV."""

    thrust = real()
    payload_force = real()


class Instant(Frame):
    """The present instant, and what a step remembers of those before; the cable is in :class:`PlantState`.

    ``start``, ``average`` and ``before``: what pushed the ROV at the start of the step, in its mean, one step before.
    """

    outside = part(Exogenous)
    ends = part(Ends)
    thrust = real()
    start = part(Push)
    average = part(Push)
    before = part(Push)
    known_rates = integer()
    newest_rate = integer()
    rate_weights = vector(3)
    last_step = real()
    last_tension = part(LastTension)
    works = part(EndWorks)


class Plant(NamedTuple):
    """Constants of everything that moves; ``ideal`` delivers the commanded thrust as it is.

    ``booked`` adds up what the power balance needs along the cable; the motion does not depend on it.
    ``explicit`` and ``implicit`` are the weights of the multistep method, see ``plant/multistep.py``.
    """

    cable: CableConstants
    forces: Forces
    motors: MotorParameters
    ideal: bool
    booked: bool
    explicit: np.ndarray
    implicit: np.ndarray


class PlantState(NamedTuple):
    """Everything that moves, and the outside world at the present instant.

    Attributes:
        now: one record.
        motors: one record per motor.
        blocks: slopes and velocities, and their last rates, shape (4, 5, 2 n), see ``plant/cable.py``.
        rows: the same in memory, a row for each block, shape (4, 10 n).
        faces: fluxes where elements meet, see ``make_faces`` in ``plant/cable.py``.
        starts: displacement at the interfaces, m, shape (n + 1,).
        loads: loads along the cable at the present instant, N/m, shape (loads,).
        water: what it does at the nodes.
        power, work: terms of the power balance along the cable, W, and their integrals, J.
    """

    now: Instant
    motors: MotorState
    blocks: np.ndarray
    rows: np.ndarray
    faces: np.ndarray
    starts: np.ndarray
    loads: np.ndarray
    water: Flow
    power: Along
    work: Along


def make_plant(scenario: Scenario, *, booked: bool = True) -> Plant:
    """The true plant of a scenario."""
    cable, forces, motors = make_cable(scenario), make_forces(scenario), make_motors(scenario.motors)
    return Plant(cable, forces, motors, scenario.ideal_thruster, booked, EXPLICIT, IMPLICIT)


def make_plant_state(scenario: Scenario) -> PlantState:
    """The plant at rest in its initial shape."""
    n, loads, elements = len(scenario.motors), len(scenario.environment.cable_load), scenario.grid.elements
    blocks = make_blocks(initial_slopes(scenario))
    state = PlantState(
        now=Instant.many(1),
        motors=MotorState.many(n),
        blocks=blocks,
        rows=blocks.reshape(BLOCKS, -1),
        faces=make_faces(elements),
        starts=zeros(elements + 1),
        loads=np.zeros(loads),
        water=make_flow(elements),
        power=make_along(elements),
        work=make_along(elements),
    )
    now = state.now[0]
    now.ends.current_length = -1.0  # so that the first look at the current works it out
    now.outside.vessel_displacement = float(vessel_at(scenario.environment, 0.0)[0])
    plain(add_up_displacement)(state.blocks[PRESENT], state.starts, now.outside.vessel_displacement)
    now.ends.tip_displacement = state.starts[elements]
    return state


@rare_kernel
def enter_step(plant: Plant, state: PlantState, inputs: Inputs, i: int) -> None:
    """The outside world just after the start of step i, where something jumped: rates before it no longer count.

    Where nothing jumped, all is as the last step left it, and this is not called.
    """
    enter(plant, state, inputs, i, WET)


@rare_kernel
def enter_dry_step(plant: Plant, state: PlantState, inputs: Inputs, i: int) -> None:
    """The same without water."""
    enter(plant, state, inputs, i, DRY)


@glue
def enter(plant: Plant, state: PlantState, inputs: Inputs, i: int, wet: bool) -> None:
    """The body of :func:`enter_step`."""
    now = state.now[0]
    before, vessel = now.outside.net_gravity, now.outside.vessel_displacement
    take_inputs(plant, state, inputs, i, START, wet)
    now.outside.vessel_displacement = vessel  # the vessel is where the last step left it
    book_tension_jump(plant, state, before)
    now.known_rates = 0
    if not plant.ideal:
        now.thrust = thrust(plant.motors, state.motors)
    derive(plant, state, 0.0, wet)


@glue
def take_inputs(plant: Plant, state: PlantState, inputs: Inputs, i: int, column: int, wet: bool) -> None:
    """The outside world at start or end of step i."""
    state.now[0].outside = inputs.world[column, i]
    for k in range(state.loads.size):
        state.loads[k] = inputs.loads[i, k, column]
    for k in range(state.motors.size):
        state.motors[k].outside = inputs.motors[column, i, k]
    if wet:
        flow_past(plant.forces, plant.cable, state.now[0].ends, state.water, state.now[0].outside, inputs.orbits)


@glue
def book_tension_jump(plant: Plant, state: PlantState, before: float) -> None:
    """Book the energy that a jump of the winch acceleration adds to the strained cable; ``before`` is g - a."""
    after, length = state.now[0].outside.net_gravity, state.now[0].outside.length
    if after != before and before > 0.0:
        power, work = state.power.tension, state.work.tension
        tension.book_jerk(plant.cable, state.blocks[PRESENT], power, work, 0.0, length, after, 0.5)
        add_power(work, power, 1.0 - before / after)


@glue
def derive(plant: Plant, state: PlantState, half: float, wet: bool) -> None:
    """What follows from the present state: displacement, slopes at both ends, powers, and their works.

    ``half`` is half of the step that ends here; 0 after a jump.
    """
    now, cable, x = state.now[0], plant.cable, state.blocks[PRESENT]
    outside, ends = now.outside, now.ends
    moment = at_moment(cable, outside)
    look_at_ends(cable, x, ends, moment)
    add_up_displacement(x, state.starts, outside.vessel_displacement)
    ends.tip_displacement = state.starts[state.starts.size - 1]
    book_at_ends(plant.forces, cable, ends, now.works, half, moment, outside, state.water, wet)
    if plant.booked:
        last, loads, water = now.last_tension, state.loads, state.water
        book_along(
            plant.forces, cable, x, state.power, state.work, half, moment, outside, last, loads, water, wet
        )  # fmt: skip


@glue
def advance_motors(plant: Plant, state: PlantState, inputs: Inputs, i: int, decision: MotorDecision) -> None:
    """All motors over step i under the voltages that are held."""
    for k in range(decision.size):
        voltage, middle, end = decision[k].motor_voltage, inputs.motors[MIDDLE, i, k], inputs.motors[END, i, k]
        advance_motor(plant.motors[k], state.motors[k], inputs.dt[i], voltage, middle, end)


@glue
def march_cable(plant: Plant, state: PlantState, newest: int, wet: bool) -> None:
    """Cable and ROV by the weights of the newest rate, which is evaluated here, and the two before it."""
    cable, rows, now = plant.cable, state.rows, state.now[0]
    x, rate = state.blocks[PRESENT], state.blocks[RATES + newest]
    outside, ends, w = now.outside, now.ends, now.rate_weights
    moment = at_moment(cable, outside)
    loss = moment.speed / moment.length + plant.forces.cable_decay
    if now.known_rates == 0:
        look_up_slowness(cable, state.faces, moment)
    evaluate(cable, x, rows[PRESENT], rate, state.faces, state.power.grid, ends, loss, moment)
    along_cable(plant.forces, cable, x, rate, state.loads, state.water, moment, outside, wet)
    pull = tension_at(0.0, moment.net, moment.hung) * ends.tip_slope
    ends.tip_rates[newest] = (on_payload(plant.forces, ends, state.water, wet) - pull) / cable.payload_inertia
    old, older = (newest + 2) % 3, (newest + 1) % 3
    march(rows[PRESENT], rows[RATES + newest], rows[RATES + old], rows[RATES + older], w)
    ends.tip_velocity += w[0] * ends.tip_rates[newest] + w[1] * ends.tip_rates[old] + w[2] * ends.tip_rates[older]


@entry_kernel
def find_rates(plant: Plant, state: PlantState) -> None:
    """Rates at the present state into the first of their places; the state stays as it is."""
    derive(plant, state, 0.0, WET)
    weigh_rates(state.now[0], 0.0, 0.0, 0.0)
    march_cable(plant, state, 0, WET)


@glue
def weigh_rates(now: Instant, newest: float, old: float, older: float) -> None:
    """Set the weights of the rates in the step that comes."""
    now.rate_weights[0], now.rate_weights[1], now.rate_weights[2] = newest, old, older


@glue
def push_payload(plant: Plant, now: Instant, dt: float) -> None:
    """Impulse of thrust and force on the ROV over a step; their means are left for the work they do.

    Values one step before count unless something jumped since; an ideal thruster holds its thrust.
    """
    start, average, before = now.start, now.average, now.before
    w = plant.implicit[min(now.known_rates, 1)]
    average.thrust = given.mean(w, now.thrust, start.thrust, before.thrust)
    average.payload_force = given.mean(w, now.outside.payload_force, start.payload_force, before.payload_force)
    if plant.ideal:
        average.thrust = start.thrust
    before.thrust, before.payload_force = start.thrust, start.payload_force  # a record as a whole goes byte by byte
    now.ends.tip_velocity += dt * (average.thrust + average.payload_force) / plant.cable.payload_inertia


@glue
def arrive(plant: Plant, state: PlantState, inputs: Inputs, i: int, wet: bool) -> None:
    """The outside world at the end of step i, where motors are already, and what all that pushes the ROV with."""
    dt, now = inputs.dt[i], state.now[0]
    take_inputs(plant, state, inputs, i, END, wet)
    if not plant.ideal:
        now.thrust = thrust(plant.motors, state.motors)
    push_payload(plant, now, dt)


@glue
def advance(plant: Plant, state: PlantState, inputs: Inputs, i: int, decision: MotorDecision, wet: bool) -> None:
    """Step i, from :func:`enter_step` on: the multistep method for cable and ROV, Runge-Kutta for the motors.

    The rates of the present and two past instants lead to the end of the step. After a jump there is no past: then the
    mean of the rates at both ends (Heun, order 2) replaces the first, by a second turn of the same loop, because a
    second copy of it would have to be compiled.
    """
    dt, now = inputs.dt[i], state.now[0]
    if abs(dt - now.last_step) > 1e-9 * dt:  # the weights are those of equal steps
        now.known_rates = 0
        now.last_step = dt
    if not plant.ideal:  # first, since each of these few numbers waits for another: meanwhile begins the cable
        advance_motors(plant, state, inputs, i, decision)
    before = now.ends.tip_displacement
    now.start.thrust, now.start.payload_force = now.thrust, now.outside.payload_force
    w = plant.explicit[now.known_rates]
    weigh_rates(now, dt * w[0], dt * w[1], dt * w[2])
    for turn in range(2 if now.known_rates == 0 else 1):
        march_cable(plant, state, (now.newest_rate + 1 + turn) % 3, wet)
        if turn == 0:
            if plant.booked:
                add_power(state.work.grid, state.power.grid, dt)
            arrive(plant, state, inputs, i, wet)
            if now.known_rates == 0:
                look_at_ends(plant.cable, state.blocks[PRESENT], now.ends, at_moment(plant.cable, now.outside))
                weigh_rates(now, 0.5 * dt, -0.5 * dt, 0.0)
    now.newest_rate = (now.newest_rate + 1) % 3
    now.known_rates = min(now.known_rates + 1, KNOWN)
    derive(plant, state, 0.5 * dt, wet)
    moved = now.ends.tip_displacement - before
    now.works.work_thrust += now.average.thrust * moved
    now.works.work_payload_force += now.average.payload_force * moved
