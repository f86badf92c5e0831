"""All forces in one place: what is here acts, works, limits the step, is linearised and is checked.

Kernels cannot walk over a table, so ``along_cable``, ``on_payload`` and the two ``book_...`` name every force once;
everything else walks over :data:`FORCES`. The balance of powers, with p = y_x, W = Dy/Dt and
E = 1/2 int(rho W^2 + T p^2) dx + 1/2 m W_l^2::

    dE/dt = W_l alpha + W_l d - c_tip W_l^2 - c int W^2 + int f W
            - T_0 p_0 e' - (v/2) T_0 p_0^2 + (rho v/2) (e' + v p_0)^2
            - 1/2 (a'/(g - a)) int (m + rho (l - x)) (g - a) p^2

What the upwind flux takes from waves too short for the grid is booked too, and no part of the model.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.frames import Frame, real
from umbilical.plant.cable import Cable, Ends
from umbilical.plant.exogenous import Exogenous, profiles
from umbilical.plant.forces import cable_damping, cable_load, given, grid, payload_damping, tension, vessel
from umbilical.plant.forces.force import Decay
from umbilical.plant.layout import to_elements
from umbilical.relations.tension import tension as tension_at
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable as CableRecord
from umbilical.scenario.hardware import Payload
from umbilical.scenario.scenario import Scenario

FORCES = (
    given.THRUST,
    given.PAYLOAD_FORCE,
    payload_damping.FORCE,
    vessel.FORCE,
    cable_damping.FORCE,
    cable_load.FORCE,
    tension.FORCE,
    grid.FORCE,
)
"""Everything that does work on cable and ROV, in the order of result files."""

WORKS = tuple(force.work for force in FORCES)


class Forces(NamedTuple):
    """Constants of the forces.

    Attributes:
        cable_damping: N s/m2.
        cable_decay: what linear damping takes of the cable's velocity, 1/s.
        payload_damping: N s/m.
        profiles: of the loads along the cable, shape (loads, 5, n).
    """

    cable_damping: float
    cable_decay: float
    payload_damping: float
    profiles: np.ndarray


class EndWorks(Frame):
    """Work done at the ends of the cable since the start, and the present power of what has one.

    Thrust and force on the ROV work by their impulse.
    """

    work_thrust = real()
    work_payload_force = real()
    work_payload_damping = real()
    work_vessel = real()
    power_payload_damping = real()
    power_vessel = real()


class Along(NamedTuple):
    """A power, W, or its work, J, in each element of the cable, shape (n,) each; ``grid``: at each interface."""

    cable_damping: np.ndarray
    cable_load: np.ndarray
    tension: np.ndarray
    grid: np.ndarray


class AlongWorks(Frame):
    """Work done along the whole cable since the start."""

    work_cable_damping = real()
    work_cable_load = real()
    work_tension = real()
    work_grid = real()


def make_forces(scenario: Scenario) -> Forces:
    """Constants of a scenario's forces."""
    return Forces(
        scenario.cable.damping,
        cable_damping.rate(scenario),
        scenario.payload.damping,
        np.ascontiguousarray(to_elements(profiles(scenario))),
    )


def make_along(elements: int) -> Along:
    """Nothing yet."""
    along, grid_losses = np.zeros((3, elements)), np.zeros(elements + 1)
    return Along(along[0], along[1], along[2], grid_losses)


@glue
def along_cable(forces: Forces, cable: Cable, rate: np.ndarray, loads: np.ndarray) -> None:
    """Add the forces along the cable to the rates of a block, but for linear damping, which the step takes off."""
    if loads.size > 0:
        cable_load.add(forces.profiles, cable.line_density, rate, loads)


@glue
def on_payload(forces: Forces, ends: Ends) -> float:
    """Force on the ROV, N, besides the cable's pull and what pushes it by impulse."""
    return payload_damping.force(forces.payload_damping, ends.tip_velocity)


@glue
def book_along(
    forces: Forces,
    cable: Cable,
    x: np.ndarray,
    power: Along,
    work: Along,
    half: float,
    outside: Exogenous,
    last_relative_jerk: float,
    loads: np.ndarray,
) -> None:
    """Works along the cable over a step whose ``half`` is given, s, element by element; 0 after a jump.

    The tension works only while the winch acceleration changes, or did at the start of the step.
    """
    length, net, jerk = outside.length, outside.net_gravity, outside.relative_jerk
    if forces.cable_damping != 0.0:
        cable_damping.book(forces.cable_damping, x, power.cable_damping, work.cable_damping, half, length)
    if loads.size > 0:
        cable_load.book(forces.profiles, x, power.cable_load, work.cable_load, half, length, loads)
    if jerk != 0.0 or last_relative_jerk != 0.0:
        tension.book(cable.hanging, cable.above, x, power.tension, work.tension, half, length, net, -0.5 * jerk)


@glue
def book_at_ends(forces: Forces, cable: Cable, ends: Ends, works: EndWorks, half: float, outside: Exogenous) -> None:
    """Works at ROV and vessel, ``half`` as in :func:`book_along`."""
    damped = payload_damping.power(forces.payload_damping, ends.tip_velocity)
    works.work_payload_damping += half * (works.power_payload_damping + damped)
    works.power_payload_damping = damped
    top, velocity = tension_at(outside.length, outside.net_gravity, cable.hanging), outside.vessel_velocity
    pulled = vessel.power(cable.line_density, top, ends.vessel_slope, outside.payout_speed, velocity)
    works.work_vessel += half * (works.power_vessel + pulled)
    works.power_vessel = pulled


@kernel
def add_up(work: Along, out: AlongWorks) -> None:
    """Sum the works along the cable from vessel to ROV."""
    out.work_cable_damping = total(work.cable_damping)
    out.work_cable_load = total(work.cable_load)
    out.work_tension = total(work.tension)
    out.work_grid = total(work.grid)


@kernel
def total(values: np.ndarray) -> float:
    """Sum from vessel to ROV."""
    found = 0.0
    for e in range(values.size):
        found += values[e]
    return found


def decays(cable: CableRecord, payload: Payload, environment: Environment) -> Iterator[Decay]:
    """What takes velocity, and how fast at most."""
    for force in FORCES:
        if found := force.decay(cable=cable, payload=payload, environment=environment):
            yield found
