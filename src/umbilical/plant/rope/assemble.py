"""The rope of a scenario: its constants, and its state at the start."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import inf

import numpy as np

from umbilical.plant.exogenous import profile
from umbilical.plant.forces.table import decays
from umbilical.plant.initial import slope_of_shape
from umbilical.plant.rope.model import BodyData, CableData, make_rope
from umbilical.plant.rope.outside import CALM, forces_on_the_body, vessel_in_space
from umbilical.plant.rope.records import RopeConstants, RopeState, WaterColumn, make_rope_state
from umbilical.plant.rope.statics import Shape, hanging_shape, node_positions, put_shape, settle
from umbilical.plant.rope.step import SAFE, axial_speed, largest_step, look_at_rope
from umbilical.plant.signals import evaluate
from umbilical.plant.top import top_at
from umbilical.relations.tension import hanging_of, largest_tension, net_gravity, tension, tension_gain
from umbilical.relations.water import in_water
from umbilical.scenario.environment import EquilibriumShape, Straight
from umbilical.scenario.rope import Rope
from umbilical.scenario.scenario import Scenario

ASSUMED_STIFFNESS = 1e4
"""EA over the static tension at the vessel, where a scenario gives none: a stretch of 1e-4, near the string."""
_INSTANTS = 2001


def section(scenario: Scenario) -> Rope:
    """What the scenario says of the rope, defaults where it says nothing."""
    return scenario.rope or Rope()


def stiffness(scenario: Scenario) -> float:
    """EA, N: given, or assumed from the static tension at the vessel on the longest length of the run."""
    if scenario.cable.axial_stiffness is not None:
        return scenario.cable.axial_stiffness
    lengths = _lengths(scenario)
    hung = hanging_of(scenario.cable, scenario.payload, scenario.environment)
    return ASSUMED_STIFFNESS * float(np.max(largest_tension(lengths, net_gravity(scenario.environment.gravity), hung)))


def _lengths(scenario: Scenario) -> np.ndarray:
    return top_at(scenario.winch, np.linspace(0.0, scenario.duration, _INSTANTS)).length


def cable_data(scenario: Scenario) -> CableData:
    """The cable."""
    cable, environment = scenario.cable, scenario.environment
    hung, still = hanging_of(cable, scenario.payload, environment), net_gravity(environment.gravity)
    weight = float(tension_gain(1.0, still, hung))
    dry = CableData(stiffness(scenario), cable.line_density, weight, damping=cable.damping)
    if cable.water is None or environment.water is None:
        return dry
    return replace(dry, water_density=environment.water.density, **cable.water.model_dump())


def body_data(scenario: Scenario) -> BodyData:
    """The body; its linear damping is horizontal, as on the string."""
    payload, environment = scenario.payload, scenario.environment
    hung, still = hanging_of(scenario.cable, payload, environment), net_gravity(environment.gravity)
    found = in_water(None, payload, None)
    return BodyData(
        payload.mass,
        float(tension(0.0, still, hung)),
        (found.body_added, found.body_across, found.body_vertical),
        (found.body_linear, found.body_linear, 0.0),
        (found.body_quadratic, found.body_quadratic_across, found.body_axial),
        found.body_displaced,
        (payload.damping, payload.damping, 0.0),
    )


def rope_of(scenario: Scenario) -> RopeConstants:
    """Constants for the kernels."""
    rope = section(scenario)
    sigma = node_positions(rope.elements)
    rows = [profile(load.profile, sigma) for load in scenario.environment.cable_load]
    loads = np.array(rows) if rows else np.zeros((0, *sigma.shape))
    body = body_data(scenario)
    moving = bool(scenario.environment.water) or bool(np.any(body.drag)) or bool(np.any(body.damping))
    return make_rope(cable_data(scenario), body, rope.elements, profiles=loads, moving=moving)


def rope_step(scenario: Scenario) -> float:
    """Longest step that is stable all through the run, s."""
    rope, motion = rope_of(scenario), top_at(scenario.winch, np.linspace(0.0, scenario.duration, _INSTANTS))
    elements = section(scenario).elements
    crossing = min(
        largest_step(rope, float(length), float(speed), elements)
        for length, speed in zip(motion.length, motion.speed, strict=True)
    )
    return min(crossing, _body_step(rope), _damped_step(scenario))


def _body_step(rope: RopeConstants) -> float:
    """The body loses its speed to the waves it sends up the cable at the rate Z/(m + A)."""
    return SAFE * float(rope.inertia.min()) / (rope.density * axial_speed(rope))


def _damped_step(scenario: Scenario) -> float:
    """Damping and drag take no more of the speed than the method can follow."""
    found = decays(scenario.cable, scenario.payload, scenario.environment)
    return min((SAFE * one.inertia / one.coefficient for one in found if one.coefficient), default=inf)


def weights_of(scenario: Scenario) -> tuple[float, float]:
    """Static tension at the body and at the vessel on the longest cable of the run, N."""
    weight = body_data(scenario).weight
    return weight, weight + cable_data(scenario).weight * float(np.max(_lengths(scenario)))


def at_rest(scenario: Scenario, rope: RopeConstants, water: WaterColumn) -> tuple[RopeState, Shape]:
    """The rope at rest under the current and the loads as they are at the start, and the shape it was found in.

    Without ``initial.shape = "equilibrium"`` in still water, with no loads.

    Raises:
        ValueError: there is no such shape.
    """
    state, sigma = make_rope_state(section(scenario).elements), node_positions(section(scenario).elements)
    start, outside = top_at(scenario.winch, 0.0), state.outside[0]
    outside.length, outside.payout_speed = float(start.length), float(start.speed)
    place, speed = (part[0] for part in vessel_in_space(scenario, np.zeros(1)))
    outside.vessel_position[:], outside.vessel_speed[:] = place, speed
    initial = scenario.initial
    if not isinstance(initial, EquilibriumShape):
        found = hanging_shape(rope, CALM, outside.length, place, np.zeros(3), sigma)
    else:
        held = None if initial.tip is None else np.array([initial.tip, 0.0])
        force, load = forces_on_the_body(scenario, 0.0), partial(_load_at_start, scenario)
        found = hanging_shape(rope, water, outside.length, place, force, sigma, load=load, held=held)
    outside.body_force[:] = found.force
    put_shape(state, found.slopes, outside.length)
    return state, found


def _load_at_start(scenario: Scenario, sigma: float) -> float:
    """Loads along the cable at the start, N/m."""
    return sum(float(evaluate(load.signal, 0.0)) * float(profile(load.profile, np.array(sigma)))
               for load in scenario.environment.cable_load)  # fmt: skip


def initial_rope(scenario: Scenario, rope: RopeConstants, water: WaterColumn) -> RopeState:
    """The rope at the start; a shape of the string's is laid over the cable as it hangs in still water."""
    state, _ = at_rest(scenario, rope, water)
    outside = state.outside[0]
    if not isinstance(scenario.initial, Straight | EquilibriumShape):
        sigma = node_positions(state.stretch.shape[1])
        add_slopes(state, slope_of_shape(scenario, sigma) / outside.length)
    elif not outside.payout_speed and not outside.vessel_speed.any():
        if isinstance(scenario.initial, Straight):
            settle(rope, state, np.zeros(0), CALM)
        else:
            loads = scenario.environment.cable_load
            settle(rope, state, np.array([float(evaluate(load.signal, 0.0)) for load in loads]), water)
    move_with_the_winch(state)
    look_at_rope(rope, state)
    return state


def add_slopes(state: RopeState, slopes: np.ndarray) -> None:
    """Add slopes y_x in the direction x, below 1, shape (5, n), and keep the stretch; x counts unstretched cable."""
    n, length = state.stretch.shape[1], float(state.outside[0].length)
    parts = [state.now[:, i * n : (i + 1) * n] / length for i in range(3)]
    size = np.sqrt(sum(part**2 for part in parts))
    parts[0] = parts[0] + slopes
    rest = np.maximum(size**2 - parts[0] ** 2 - parts[1] ** 2, 0.0)
    parts[2] = -np.sqrt(rest)
    state.now[:, : 3 * n] = length * np.concatenate(parts, axis=1)


def move_with_the_winch(state: RopeState) -> None:
    """At the start cable and body move as the winch pays out along the shape, and with the vessel."""
    n, outside = state.stretch.shape[1], state.outside[0]
    for i in range(3):
        along = outside.payout_speed / outside.length * state.now[:, i * n : (i + 1) * n]
        state.now[:, (3 + i) * n : (4 + i) * n] = outside.vessel_speed[i] + along
        state.body[0, i] = state.now[4, (4 + i) * n - 1]
