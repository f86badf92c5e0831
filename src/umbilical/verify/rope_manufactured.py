"""A manufactured solution of the rope in space, and the order of its steps in time."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from umbilical.analysis.convergence import Curve
from umbilical.plant.rope.model import BodyData, CableData, Motion, RopeModel, SteadyCurrent, make_rope, water_of
from umbilical.plant.rope.rates import evaluate_rope
from umbilical.plant.rope.records import RopeState, make_rope_state
from umbilical.plant.rope.statics import node_positions, unknowns
from umbilical.verify.cases import Case, Check, each, order_reached, small
from umbilical.verify.orders import ROPE_ORDER, TIME_ORDER
from umbilical.verify.references import manufactured_rope as exact
from umbilical.verify.references.manufactured_rope import RopeProblem
from umbilical.verify.rope import COMPUTED, quintic_winch, waving

UNTIL = 1.0
STEPS = (8e-3, 4e-3, 2e-3, 1e-3)
ELEMENTS = (4, 8, 16, 32)
STEP = 0.0256
"""s times elements: of the classical Runge-Kutta method, whose own error stays below the grid's."""


class _Driven:
    """The engine's rates with the loads of the manufactured solution, stepped by the classical Runge-Kutta method."""

    def __init__(self, problem: RopeProblem, elements: int) -> None:
        p = problem
        cable = CableData(p.stiffness, p.density, p.weight, p.diameter, p.normal, p.tangential, p.added_mass)
        body = BodyData(p.mass, p.body_weight, p.body_added, drag=p.body_drag)
        self.problem, self.elements = problem, elements
        self.rope, self.water = make_rope(cable, body, elements), water_of(SteadyCurrent(velocities=(p.current,)))
        self.state: RopeState = make_rope_state(elements)
        self.sigma = node_positions(elements)
        self.state.now[:], self.state.body[0] = self.exact(0.0)

    def exact(self, t: float) -> tuple[np.ndarray, np.ndarray]:
        """l r_x and W at the nodes as the state has them, and the body's velocity."""
        f = exact.fields(self.problem, self.sigma.ravel(), t)
        parts = np.concatenate([self.problem.winch(t)[0] * f.slope, f.velocity]).reshape(6, 5, self.elements)
        body = exact.fields(self.problem, np.ones(1), t).velocity[:, 0]
        return np.moveaxis(parts, 0, 1).reshape(5, -1), body

    def rates(self, t: float, values: np.ndarray) -> np.ndarray:
        """Rates of all unknowns."""
        state, outside, n = self.state, self.state.outside[0], self.elements
        outside.length, outside.payout_speed, _ = self.problem.winch(t)
        top = exact.fields(self.problem, np.zeros(1), t)
        outside.vessel_position[:] = top.place[:, 0]
        outside.vessel_speed[:] = top.velocity[:, 0] - outside.payout_speed * top.slope[:, 0]
        outside.body_force[:] = exact.body_force(self.problem, t)
        state.now[:] = values[: state.now.size].reshape(state.now.shape)
        state.body[0] = values[state.now.size :]
        evaluate_rope(self.rope, state, outside, np.zeros(0), self.water, 0, False)
        given = exact.acceleration_given(self.problem, self.sigma.ravel(), t).reshape(3, 5, n)
        state.rate[:, 3 * n :] += np.moveaxis(given, 0, 1).reshape(5, 3 * n)
        return np.concatenate([state.rate.ravel(), state.body[2]])

    def march(self) -> None:
        """To the end."""
        steps = round(UNTIL * self.elements / STEP)
        dt, y = UNTIL / steps, unknowns(self.state)
        for k in range(steps):
            t = k * dt
            k1 = self.rates(t, y)
            k2 = self.rates(t + 0.5 * dt, y + 0.5 * dt * k1)
            k3 = self.rates(t + 0.5 * dt, y + 0.5 * dt * k2)
            k4 = self.rates(t + dt, y + dt * k3)
            y = y + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        self.state.now[:] = y[: self.state.now.size].reshape(self.state.now.shape)
        self.state.body[0] = y[self.state.now.size :]

    def missed(self) -> tuple[float, float, float]:
        """Root mean squares of what r_x and W are off by, and the largest error of the body's velocity."""
        now, body = self.exact(UNTIL)
        off = (self.state.now - now).reshape(5, 6, -1)
        weights = np.array([1 / 10, 49 / 90, 32 / 45, 49 / 90, 1 / 10]) / (2.0 * self.elements)
        square = np.einsum("j,jie->i", weights, off**2)
        length = self.problem.winch(UNTIL)[0]
        slope, velocity = (float(np.sqrt(part.sum())) for part in (square[:3], square[3:]))
        return slope / length, velocity, float(np.abs(self.state.body[0] - body).max())


def _in_space(swing: float) -> Iterator[Check]:
    """Orders in the size of an element, and what is left on the finest grid."""
    rows = []
    for elements in ELEMENTS:
        driven = _Driven(RopeProblem(swing), elements)
        driven.march()
        rows.append(driven.missed())
    found, sizes = np.array(rows), tuple(60.0 / n for n in ELEMENTS)
    for row, name in zip(found.T, ("r_x", "Dr/Dt"), strict=False):
        yield order_reached(Curve(f"{name} of the rope", "the element, m", sizes, tuple(row), ROPE_ORDER), "stated")
    why = "half more than was found; a wave of 4.5 m/s on 32 elements"
    yield small("error of Dr/Dt on 32 elements, m/s", found[-1, 1], 3.75e-8, why)
    yield small("error of the body's velocity, m/s", found[-1, 2], 5e-9, "four times what was found")


def _in_time() -> Iterator[Check]:
    """The order in the step, from differences on one grid: paying out, the vessel in motion, in a current, taut."""
    cable = CableData(2e4, 2.0, 15.0, 0.04, 1.2)
    body = BodyData(40.0, 300.0, 20.0, drag=10.0)
    motion = Motion(quintic_winch(60.0, 61.0, 2.0), waving({0: (0.3, 2.0), 2: (0.1, 2.5)}, 1.0))
    found = []
    for step in STEPS:
        model = RopeModel(cable, body, motion, SteadyCurrent(velocities=((0.3, -0.4, 0.0),)), elements=4, step=step)
        model.step(2.0)
        found.append(np.concatenate([model.position.ravel(), model.velocity.ravel()]))
    changes = tuple(float(np.abs(b - a).max()) for a, b in pairwise(found))
    yield order_reached(Curve("r and Dr/Dt, change", "the step, s", STEPS[:-1], changes, TIME_ORDER), "stated")


REFERENCE = "r = a + b sigma + c sin(k sigma) + d cos(k sigma)"
CASES = (
    *each("rope, manufactured, l {}", REFERENCE, "derived by hand from docs/rope.md", _in_space,
          {"growing": 4.0, "shrinking": -4.0}),
    Case("rope, order in time", "differences of steps", COMPUTED, _in_time),
)  # fmt: skip
