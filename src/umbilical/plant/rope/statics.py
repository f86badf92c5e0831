"""The rope at rest: its shape in a current, and the state of the grid that keeps still.

From the body upwards the tension vector G = N t is known: G(l) = drag of the body - W z, and with s = l - x

::

    G_s = f,   r_s = -(1 + |G|/EA) G/|G|

where f is drag less weight per metre; where water slides along a bent cable, its added mass takes part of the tension.
Only the depth of the body is unknown before the sheave is reached.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from umbilical.plant.elements import NODES
from umbilical.plant.rope.rates import evaluate_rope
from umbilical.plant.rope.records import RopeConstants, RopeState, WaterColumn
from umbilical.plant.rope.step import look_at_rope

_WIDEST = 1.5
"""The body is looked for between the sheave's height plus and minus this times the length."""


class Shape(NamedTuple):
    """A shape at rest: r_x at some places, shape (..., 3); where the body is, m, and the force on it, N, shape (3,)."""

    slopes: np.ndarray
    body: np.ndarray
    force: np.ndarray


def flow_in(water: WaterColumn, height: float) -> np.ndarray:
    """Velocity of the water at a height, m/s, shape (3,), at the first stage."""
    known = water.heights[::-1]
    return np.array([np.interp(height, known, water.flow[0, ::-1, i]) for i in range(3)])


def hanging_shape(
    rope: RopeConstants, water: WaterColumn, length: float, vessel: np.ndarray, force: np.ndarray, sigma: np.ndarray, *,
    load: Callable[[float], float] | None = None, held: np.ndarray | None = None,
) -> Shape:  # fmt: skip
    """Shape at rest under weight, current and a force on the body, N, shape (3,); at positions ``sigma``, any shape.

    ``load``: along x on a metre of cable, N/m, from x/l. ``held``: x and y at which a horizontal force, which is added
    to ``force``, holds the body, m.

    Raises:
        ValueError: nothing pulls at the lower end, or no depth of the body or no force meets the sheave.
    """
    from scipy.integrate import solve_ivp  # slow to import
    from scipy.optimize import brentq, root  # slow to import

    def along(s: float, y: np.ndarray) -> np.ndarray:
        pull = y[:3]
        size = float(np.sqrt(pull @ pull))
        t = pull / size
        u = flow_in(water, y[5])
        slide = u @ t
        across = u - slide * t
        drag = rope.normal_drag * np.sqrt(across @ across) * across + rope.tangential_drag * abs(slide) * slide * t
        force = drag - np.array([0.0, 0.0, rope.weight])
        if load is not None:
            force[0] += load(1.0 - s / length)
        normal = force - (force @ t) * t
        taken = rope.added * slide * slide / (1.0 + size / rope.stiffness)
        force = force + normal * taken / (size - taken)
        return np.concatenate([force, -(1.0 + size / rope.stiffness) * t])

    def from_depth(height: float, more: Any = (0.0, 0.0), **options: Any) -> Any:
        u = flow_in(water, height)
        pull = (rope.body_damping + rope.body_drag * np.abs(u)) * u + force - np.array([0.0, 0.0, rope.body_weight])
        pull[:2] += more
        if not pull.any():
            raise ValueError("nothing pulls at the lower end of the cable")
        start = np.concatenate([pull, [0.0, 0.0, height]])
        return solve_ivp(along, (0.0, length), start, method="DOP853", rtol=1e-11, atol=1e-9, **options)

    def miss(height: float) -> float:
        return float(from_depth(height).y[5, -1] - vessel[2])

    reach = _WIDEST * length
    height = vessel[2] + (from_depth(vessel[2]).y[5, 0] - from_depth(vessel[2]).y[5, -1])
    holds = np.zeros(2)
    if held is not None:

        def off(unknown: np.ndarray) -> np.ndarray:
            ends = from_depth(unknown[0], unknown[1:]).y[3:, -1]
            return np.array([*(held + ends[:2] - vessel[:2]), ends[2] - vessel[2]])

        solved: Any = root(off, np.array([height, 0.0, 0.0]), method="hybr", options={"xtol": 1e-12})
        if not np.abs(off(solved.x)).max() < 1e-6 * length:
            raise ValueError("no horizontal force holds the body there")
        height, holds = float(solved.x[0]), solved.x[1:]
    elif water.heights.size > 1:
        height = float(brentq(miss, vessel[2] - reach, vessel[2] + reach, xtol=1e-9))  # type: ignore[arg-type]
    found = from_depth(height, holds, dense_output=True)
    pull = found.sol(length * (1.0 - np.ravel(sigma)))[:3].T
    size = np.sqrt((pull**2).sum(axis=1, keepdims=True))
    slopes = (1.0 / size + 1.0 / rope.stiffness) * pull
    way = np.array([*(vessel[:2] - found.y[3:5, -1]), height])
    return Shape(slopes.reshape(*np.shape(sigma), 3), way, force + np.array([*holds, 0.0]))


def node_positions(elements: int) -> np.ndarray:
    """sigma at the nodes, shape (5, n)."""
    return (np.arange(elements) + (NODES[:, None] + 1.0) / 2.0) / elements


def put_shape(state: RopeState, slopes: np.ndarray, length: float) -> None:
    """Set l r_x from r_x at the nodes, shape (5, n, 3)."""
    n = slopes.shape[1]
    state.now[:, : 3 * n] = length * np.moveaxis(slopes, 2, 1).reshape(5, 3 * n)


def unknowns(state: RopeState) -> np.ndarray:
    """Everything that has a rate, shape (30 n + 3,)."""
    return np.concatenate([state.now.ravel(), state.body[0]])


def rates_at(
    rope: RopeConstants, state: RopeState, loads: np.ndarray, water: WaterColumn, values: np.ndarray
) -> np.ndarray:
    """Rates of :func:`unknowns` at these values; the state keeps them."""
    size = state.now.size
    state.now[:] = values[:size].reshape(state.now.shape)
    state.body[0] = values[size:]
    evaluate_rope(rope, state, state.outside[0], loads, water, 0, True)
    return np.concatenate([state.rate.ravel(), state.body[2]])


def jacobian(rope: RopeConstants, state: RopeState, loads: np.ndarray, water: WaterColumn) -> np.ndarray:
    """Derivative of the rates after the unknowns by central differences, shape (30 n + 3, 30 n + 3)."""
    at = unknowns(state).copy()
    columns = np.zeros((at.size, at.size))
    stretched = 1e-6 * state.outside[0].length * min(1.0, 1e3 * _load(rope) / rope.stiffness)
    half = state.now.shape[1] // 2
    places = np.arange(state.now.size) % state.now.shape[1] < half
    steps = np.append(np.where(places, stretched, 1e-4), np.full(3, 1e-4))
    for k, step in enumerate(steps):
        ends = [rates_at(rope, state, loads, water, at + sign * step * (np.arange(at.size) == k)) for sign in (1, -1)]
        columns[:, k] = (ends[0] - ends[1]) / (2.0 * step)
    rates_at(rope, state, loads, water, at)
    return columns


def _load(rope: RopeConstants) -> float:
    return abs(rope.body_weight) + rope.weight + 1.0


def settle(rope: RopeConstants, state: RopeState, loads: np.ndarray, water: WaterColumn, *, rounds: int = 8) -> float:
    """Newton's method for the state that keeps still, winch stopped; the largest rate that is left, SI units."""
    rest = np.inf
    for _ in range(rounds):
        at = unknowns(state).copy()
        rates = rates_at(rope, state, loads, water, at)
        size = float(np.abs(rates).max())
        if not size < 0.9 * rest or size == 0.0:
            break
        rest = size
        change = np.linalg.lstsq(jacobian(rope, state, loads, water), -rates, rcond=1e-13)[0]
        rates_at(rope, state, loads, water, at + change)
    look_at_rope(rope, state)
    return rest
