"""A manufactured solution of the full problem, eqs. (6)-(8): every term at work, the length growing or shrinking.

y(x, t) is chosen; the load along the cable, the force on the ROV and the vessel's motion follow from the
equations by sympy, with T(x, t) = (m + rho (l - x)) (g - a), both dampings, v, a and a' all non-zero.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np
import sympy

from tests.support.scenarios import open_loop
from umbilical.engine.loop import World, advance_period
from umbilical.engine.simulate import set_up
from umbilical.engine.stepping import enter_step
from umbilical.plant import exogenous
from umbilical.plant.cable import PRESENT, TIP_VELOCITY
from umbilical.plant.exogenous import Inputs
from umbilical.plant.layout import integrate, positions, to_elements, to_nodal

DENSITY, MASS, GRAVITY, DAMPING, TIP_DAMPING = 2.0, 50.0, 10.0, 0.3, 5.0
GROWING, SHRINKING = 4.0, -4.0
UNTIL = 2.0


class Problem(NamedTuple):
    """The solution and what drives it, as functions of numpy arrays: ``(x, t)`` or ``(t,)``."""

    displacement: Any
    slope: Any
    velocity: Any
    load: Any
    force: Any
    world: Any
    """l, v, a, g - a, a'/(g - a), e, e' in the order of the engine's inputs."""


@cache
def problem(drift: float) -> Problem:
    """The problem whose length changes at ``drift`` on average, m/s."""
    x, t = sympy.symbols("x t", real=True)
    length = 60 + drift * t + sympy.sin(sympy.Rational(3, 2) * t)
    speed, acceleration, jerk = (sympy.diff(length, t, k) for k in (1, 2, 3))
    y = (1 + sympy.cos(2 * t) / 3) * sympy.sin(x / 7 + sympy.Rational(7, 10) + sympy.sin(t) / 2)
    tension = (MASS + DENSITY * (length - x)) * (GRAVITY - acceleration)

    def material(q: sympy.Expr) -> sympy.Expr:
        return sympy.diff(q, t) + speed * sympy.diff(q, x)

    velocity = material(y)
    load = DENSITY * material(velocity) - sympy.diff(tension * sympy.diff(y, x), x) + DAMPING * velocity
    force = MASS * material(velocity) + tension * sympy.diff(y, x) + TIP_DAMPING * velocity
    vessel = y.subs(x, 0)
    net = GRAVITY - acceleration
    world = [length, speed, acceleration, net, jerk / net, vessel, sympy.diff(vessel, t)]
    along = [sympy.lambdify((x, t), q, "numpy", cse=True) for q in (y, sympy.diff(y, x), velocity, load)]
    at_ends = [sympy.lambdify(t, q, "numpy", cse=True) for q in (force.subs(x, length), world)]
    return Problem(*along, *at_ends)


def solve(drift: float, elements: int, step: float) -> tuple[np.ndarray, np.ndarray]:
    """y and Dy/Dt at the nodes at t = UNTIL, by the engine's own steps."""
    world = _world(drift, elements)
    inputs = _inputs(drift, elements, step)
    enter_step(world.plant, world.state, inputs, 0)
    advance_period(world, inputs, 0, inputs.dt.size)
    slopes, velocities = world.state.blocks[PRESENT, :, :elements], world.state.blocks[PRESENT, :, elements:]
    velocity = to_nodal(velocities)
    velocity[-1] = world.state.ends[TIP_VELOCITY]
    return world.state.now[exogenous.VESSEL] + integrate(slopes), velocity


def exact(drift: float, elements: int, t: float = UNTIL) -> tuple[np.ndarray, np.ndarray]:
    """y and Dy/Dt at the nodes."""
    p = problem(drift)
    x = positions(elements) * p.world(t)[0]
    return p.displacement(x, t), p.velocity(x, t)


def _world(drift: float, elements: int) -> World:
    scenario = open_loop(
        winch__length=60.0, payload={"mass": MASS, "damping": TIP_DAMPING}, cable__damping=DAMPING, grid__step=1e-4,
        control__period=1e-4, grid__elements=elements,
    )  # fmt: skip
    world = set_up(scenario).world
    nodes = 4 * elements + 1
    cable = world.plant.cable._replace(profiles=np.ascontiguousarray(to_elements(np.eye(nodes))))
    state = world.state._replace(loads=np.zeros(nodes))
    displacement, velocity = exact(drift, elements, 0.0)
    slope = problem(drift).slope(positions(elements) * problem(drift).world(0.0)[0], 0.0)
    state.blocks[PRESENT, :, :elements] = to_elements(slope) * problem(drift).world(0.0)[0]
    state.blocks[PRESENT, :, elements:] = to_elements(velocity)
    state.ends[TIP_VELOCITY] = velocity[-1]
    state.now[exogenous.VESSEL] = displacement[0]
    return world._replace(plant=world.plant._replace(cable=cable), state=state)


def _inputs(drift: float, elements: int, step: float) -> Inputs:
    p, steps = problem(drift), round(UNTIL / step)
    t = np.arange(steps) * step + np.array([[0.0], [0.5], [1.0]]) * step
    world = np.array([*p.world(t), p.force(t)])
    x = positions(elements)[:, None, None] * world[exogenous.LENGTH]
    return Inputs(
        np.full(steps, step), np.zeros(steps, dtype=np.bool_), world, np.zeros((6, 0, 3, steps)), p.load(x, t + 0.0 * x)
    )
