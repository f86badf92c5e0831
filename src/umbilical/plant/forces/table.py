"""All forces in one place: what is here acts, works, limits the step, is linearised and is checked.

Kernels cannot walk over a table, so ``along_cable``, ``on_payload`` and the two ``book_...`` name every force once;
everything else walks over :data:`FORCES`. The balance of powers, with p = y_x, W = Dy/Dt and
E = 1/2 int(rho W^2 + T p^2) dx + 1/2 m W_l^2::

    dE/dt = W_l alpha + W_l d - c_tip W_l^2 - c int W^2 + int f W
            - T_0 p_0 e' - (v/2) T_0 p_0^2 + (rho v/2) (e' + v p_0)^2
            - 1/2 (a'/(g - a)) int (m + rho (l - x)) (g - a) p^2

In water rho is M, T is Tt, v is vb and W is Wb = y_t + vb y_x (``plant/cable.py``), m is m + A_h, and there are drag,
current, added mass and what sliding changes of the tension besides. What the upwind flux takes from waves too short for
the grid is booked too, and no part of the model.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.frames import Frame, integer, real
from umbilical.plant import current as profile_of_current
from umbilical.plant.cable import CableConstants, Ends, Moment
from umbilical.plant.current import Flow, Profile, make_profile
from umbilical.plant.exogenous import Exogenous, profiles
from umbilical.plant.forces import (
    added_mass,
    body_drag,
    cable_damping,
    cable_load,
    current,
    drag,
    given,
    grid,
    payload_damping,
    tension,
    vessel,
)
from umbilical.plant.forces.body_drag import BodyDrag
from umbilical.plant.forces.current import Moved
from umbilical.plant.forces.drag import Drag
from umbilical.plant.forces.force import Decay, add_power, begin_work
from umbilical.plant.layout import to_elements, zeros
from umbilical.plant.orbital import Levels, levels_of, look_at_waves
from umbilical.plant.seaway import heaving
from umbilical.relations.tension import tension as tension_at
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.scenario import Scenario

FORCES = (
    given.THRUST, given.PAYLOAD_FORCE, payload_damping.FORCE, vessel.FORCE, cable_damping.FORCE, cable_load.FORCE,
    tension.FORCE, drag.FORCE, body_drag.FORCE, current.FORCE, added_mass.FORCE, grid.FORCE,
)  # fmt: skip
"""Everything that does work on cable and ROV, in the order of result files."""

WORKS = tuple(force.work for force in FORCES)
IN_WATER = (drag.FORCE, body_drag.FORCE, current.FORCE, added_mass.FORCE)
"""Forces that a scenario without water has no channels of."""


class Forces(NamedTuple):
    """Constants of the forces.

    Attributes:
        cable_damping: N s/m2.
        cable_decay: what linear damping takes of the cable's velocity, 1/s.
        payload_damping: N s/m.
        profiles: of the loads along the cable, shape (loads, 5, n).
        wet: whether there is water, or the sheave heaves.
        drag, body_drag, moved, current: of the water.
        waves: levels of their orbital motion.
    """

    cable_damping: float
    cable_decay: float
    payload_damping: float
    profiles: np.ndarray
    wet: bool
    drag: Drag
    body_drag: BodyDrag
    moved: Moved
    current: Profile
    waves: Levels


class EndWorks(Frame):
    """Work done at the ends of the cable since the start, and the present power of what has one.

    Thrust and force on the ROV work by their impulse.
    """

    work_thrust = real()
    work_payload_force = real()
    work_payload_damping = real()
    work_vessel = real()
    work_body_drag = real()
    work_body_current = real()
    work_added_mass = real()
    power_payload_damping = real()
    power_vessel = real()
    power_body_drag = real()
    power_body_current = real()
    power_added_mass = real()


class LastTension(Frame):
    """How the tension changed at the end of the last step: the winch's relative jerk, and whether it slid."""

    relative_jerk = real()
    slides = integer()


class Along(NamedTuple):
    """A power, W, or its work, J, in each element of the cable, shape (n,) each; ``grid``: at each interface.

    ``sliding`` is a part of the tension's.
    """

    cable_damping: np.ndarray
    cable_load: np.ndarray
    tension: np.ndarray
    sliding: np.ndarray
    drag: np.ndarray
    current: np.ndarray
    grid: np.ndarray


class AlongWorks(Frame):
    """Work done along the whole cable since the start."""

    work_cable_damping = real()
    work_cable_load = real()
    work_tension = real()
    work_drag = real()
    work_current = real()
    work_grid = real()


def is_wet(environment: Environment) -> bool:
    """Whether there is water, or the sheave heaves: what the kernels' constant ``wet`` leaves out otherwise."""
    return environment.water is not None or bool(heaving(environment))


def make_forces(scenario: Scenario) -> Forces:
    """Constants of a scenario's forces."""
    return Forces(
        scenario.cable.damping,
        cable_damping.rate(scenario),
        scenario.payload.damping,
        np.ascontiguousarray(to_elements(profiles(scenario))),
        is_wet(scenario.environment),
        drag.make(scenario),
        body_drag.make(scenario),
        current.make(scenario),
        make_profile(scenario.environment),
        levels_of(scenario.environment),
    )


def make_along(elements: int) -> Along:
    """Nothing yet."""
    rows = zeros(len(Along._fields) - 1, elements)
    return Along(**dict(zip(Along._fields, (*rows, zeros(elements + 1)), strict=True)))


@glue
def flow_past(
    forces: Forces, cable: CableConstants, ends: Ends, water: Flow, outside: Exogenous, orbits: np.ndarray
) -> None:
    """The water at the nodes, as deep as they are now: worked out where depth, current or waves have changed it."""
    length, heave, factor, change = outside.length, outside.heave, outside.current_factor, outside.current_rate
    waves, flows = forces.waves.deepest > 0.0, forces.current.starts.size > 0
    moved = length != ends.current_length or heave != ends.current_heave
    if flows and moved:
        profile_of_current.fill(forces.current, cable.above, water.profile, length, heave)
        ends.current_length, ends.current_heave = length, heave
    if waves or (flows and (moved or factor != ends.current_factor or change != ends.current_rate)):
        profile_of_current.scale(water.profile, factor, water.speed)
        if waves or change != 0.0 or ends.current_rate != 0.0:
            profile_of_current.scale(water.profile, change, water.rate)
        ends.current_factor, ends.current_rate = factor, change
    if waves:
        look_at_waves(orbits, outside.wave_place, water.orbit)
        profile_of_current.add_waves(forces.waves, cable.above, water, length, heave)


@glue
def along_cable(
    forces: Forces, cable: CableConstants, x: np.ndarray, rate: np.ndarray, loads: np.ndarray, water: Flow,
    moment: Moment, outside: Exogenous, wet: bool,
) -> None:  # fmt: skip
    """Add the forces along the cable to the rates of a block, but for linear damping, which the step takes off."""
    inertia, length, slip = cable.line_inertia, moment.length, moment.slip
    if loads.size > 0:
        cable_load.add(forces.profiles, inertia, rate, loads)
    if wet:
        if slip != 0.0 and forces.cable_decay != 0.0:
            cable_damping.add_sliding(x, rate, -forces.cable_decay * slip / length)
        if forces.drag.acts:
            drag.add(forces.drag, inertia, x, rate, water.speed, length, outside.sink_speed, slip)
        if outside.current_rate != 0.0 or forces.waves.deepest > 0.0:
            current.add(forces.moved, inertia, rate, water.rate)


@glue
def on_payload(forces: Forces, ends: Ends, water: Flow, wet: bool) -> float:
    """Force on the ROV, N, besides the cable's pull and what pushes it by impulse."""
    found = payload_damping.force(forces.payload_damping, ends.tip_velocity)
    if wet:
        last = water.speed.shape[1] - 1
        found += body_drag.force(forces.body_drag, water.speed[4, last] - ends.tip_velocity)
        found += forces.moved.body * water.rate[4, last]
    return found


@glue
def book_along(
    forces: Forces, cable: CableConstants, x: np.ndarray, power: Along, work: Along, half: float, moment: Moment,
    outside: Exogenous, last: LastTension, loads: np.ndarray, water: Flow, wet: bool,
) -> None:  # fmt: skip
    """Works along the cable over a step whose ``half`` is given, s, element by element; 0 after a jump.

    The tension works only while it changes, or did at the start of the step.
    """
    length, jerk, slip, sinks = moment.length, outside.relative_jerk, moment.slip, outside.sink_speed
    if forces.cable_damping != 0.0:
        cable_damping.book(forces.cable_damping, x, power.cable_damping, work.cable_damping, half, length, slip)
    if loads.size > 0:
        cable_load.book(forces.profiles, x, power.cable_load, work.cable_load, half, length, loads)
    if jerk != 0.0 or last.relative_jerk != 0.0:
        tension.book_jerk(cable, x, power.tension, work.tension, half, length, moment.net, -0.5 * jerk)
    last.relative_jerk = jerk
    if wet:
        foot, rise = tension.sliding(cable, moment, outside)
        if foot != 0.0 or rise != 0.0 or last.slides:
            tension.book(cable.above, x, power.sliding, work.sliding, half, length, 0.5, foot, rise)
        last.slides = foot != 0.0 or rise != 0.0
        begin_work(power.current, work.current, half)
        if forces.drag.acts:
            drag.book(
                forces.drag, x, power.drag, work.drag, power.current, water.speed, half, length, sinks, slip
            )  # fmt: skip
        if outside.current_rate != 0.0 or forces.waves.deepest > 0.0:
            current.give(forces.moved, x, power.current, water.rate, length)
        add_power(work.current, power.current, half)


@glue
def book_at_ends(
    forces: Forces, cable: CableConstants, ends: Ends, works: EndWorks, half: float, moment: Moment,
    outside: Exogenous, water: Flow, wet: bool,
) -> None:  # fmt: skip
    """Works at ROV and vessel, ``half`` as in :func:`book_along`."""
    damped = payload_damping.power(forces.payload_damping, ends.tip_velocity)
    works.work_payload_damping += half * (works.power_payload_damping + damped)
    works.power_payload_damping = damped
    top, enters = tension_at(moment.length, moment.net, moment.across), moment.speed - moment.slip
    pulled = vessel.power(cable.line_inertia, top, ends.vessel_slope, enters, moment.vessel)
    works.work_vessel += half * (works.power_vessel + pulled)
    works.power_vessel = pulled
    if wet:
        book_water_at_payload(forces, cable, ends, works, half, moment, outside, water)


@glue
def book_water_at_payload(
    forces: Forces, cable: CableConstants, ends: Ends, works: EndWorks, half: float, moment: Moment,
    outside: Exogenous, water: Flow,
) -> None:  # fmt: skip
    """What the water does to the ROV, as :func:`book_at_ends`."""
    last = water.speed.shape[1] - 1
    flow, velocity = water.speed[4, last], ends.tip_velocity
    force = body_drag.force(forces.body_drag, flow - velocity)
    dragged, given = force * (velocity - flow), force * flow
    given += forces.moved.body * water.rate[4, last] * velocity
    left = added_mass.power(cable, ends, moment, outside.sink_speed)
    works.work_body_drag += half * (works.power_body_drag + dragged)
    works.work_body_current += half * (works.power_body_current + given)
    works.work_added_mass += half * (works.power_added_mass + left)
    works.power_body_drag, works.power_body_current, works.power_added_mass = dragged, given, left


@kernel
def sum_works(work: Along, ends: EndWorks, out: AlongWorks) -> None:
    """Sum the works along the cable from vessel to ROV; the current's with what it gives to the ROV."""
    out.work_cable_damping = total(work.cable_damping)
    out.work_cable_load = total(work.cable_load)
    out.work_tension = total(work.tension) + total(work.sliding)
    out.work_drag = total(work.drag)
    out.work_current = total(work.current) + ends.work_body_current
    out.work_grid = total(work.grid)


@kernel
def total(values: np.ndarray) -> float:
    """Sum from vessel to ROV."""
    found = 0.0
    for e in range(values.size):
        found += values[e]
    return found


def decays(cable: Cable, payload: Payload, environment: Environment) -> Iterator[Decay]:
    """What takes velocity, and how fast at most."""
    for force in FORCES:
        if found := force.decay(cable=cable, payload=payload, environment=environment):
            yield found


def dampings(scenario: Scenario, water: np.ndarray, on: str) -> list[Any]:
    """What every force ``on`` the "cable" (N s/m2) or the "payload" (N s/m) damps in water that passes, m/s."""
    return [force.damping(scenario, water) for force in FORCES if force.on == on]


def payload_spring(scenario: Scenario, water: np.ndarray) -> float:
    """What all forces hold the ROV with in water that passes, N/m."""
    return sum(force.stiffness(scenario, water) for force in FORCES)
