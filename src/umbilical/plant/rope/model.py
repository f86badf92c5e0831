"""The rope for Python: a cable with its body that is stepped, looked at and asked for its powers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np

from umbilical.plant.layout import integrate, to_nodal
from umbilical.plant.rope.energy import rope_energy
from umbilical.plant.rope.records import (
    POWERS,
    STAGES,
    RopeConstants,
    RopeOutside,
    WaterColumn,
    make_above,
    make_rope_state,
    make_water,
    vector_of,
)
from umbilical.plant.rope.statics import hanging_shape, jacobian, node_positions, put_shape, settle
from umbilical.plant.rope.step import largest_step, look_at_rope, run_rope
from umbilical.relations.water import line_in_water

Vector = float | tuple[float, float, float]
WATER_DENSITY = 1025.0


@dataclass(frozen=True)
class CableData:
    """The cable, SI units.

    Attributes:
        stiffness: EA, N.
        density: dry, kg/m.
        weight: in water, N/m.
        diameter: m; 0 is in vacuum.
        normal_drag, tangential_drag, added_mass: coefficients C_dn, C_dt, C_a.
        damping: linear, of the horizontal velocity, N s/m2.
        water_density: kg/m3.
    """

    stiffness: float
    density: float
    weight: float
    diameter: float = 0.0
    normal_drag: float = 0.0
    tangential_drag: float = 0.0
    added_mass: float = 1.0
    damping: float = 0.0
    water_density: float = WATER_DENSITY
    strumming: float = 0.0


@dataclass(frozen=True)
class BodyData:
    """The body, SI units; vectors are numbers for all axes or one for each.

    Attributes:
        mass: dry, kg.
        weight: in water, N.
        added_mass: kg.
        damping, drag: linear, N s/m, and quadratic, N s2/m2, of the velocity through the water.
        friction: linear, of the velocity over ground, N s/m.
        displaced: mass of the displaced water, kg, which follows waves.
    """

    mass: float
    weight: float
    added_mass: Vector = 0.0
    damping: Vector = 0.0
    drag: Vector = 0.0
    displaced: float = 0.0
    friction: Vector = 0.0


@dataclass(frozen=True)
class SteadyCurrent:
    """Steady water: velocities, m/s, shape (levels, 3), at heights, m, decreasing from the surface."""

    heights: tuple[float, ...] = (0.0,)
    velocities: tuple[tuple[float, float, float], ...] = ((0.0, 0.0, 0.0),)


@dataclass(frozen=True)
class Motion:
    """What the winch and the vessel do: functions of arrays of time, s.

    Attributes:
        length: gives l and v, m and m/s.
        vessel: gives position and velocity of the sheave, m and m/s, each of shape (..., 3).
    """

    length: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
    vessel: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]] | None = None


def fixed(length: float) -> Motion:
    """A winch that stands still on a vessel that does."""
    return Motion(lambda t: (np.full(np.shape(t), length), np.zeros(np.shape(t))))


def make_rope(
    cable: CableData, body: BodyData, elements: int, *, profiles: np.ndarray | None = None, moving: bool = False
) -> RopeConstants:
    """Constants for the kernels; ``profiles`` of loads along the cable of shape (loads, 5, n)."""
    above, faces = make_above(elements)
    line = line_in_water(
        cable.water_density, cable.diameter, cable.normal_drag, cable.tangential_drag, cable.added_mass,
        cable.strumming,
    )  # fmt: skip
    added, damping, drag = vector_of(body.added_mass), vector_of(body.damping), vector_of(body.drag)
    dragged = bool(line.added or line.normal or line.tangential)
    return RopeConstants(
        stiffness=cable.stiffness, density=cable.density, weight=cable.weight, added=line.added,
        displaced=line.displaced, normal_drag=line.normal, tangential_drag=line.tangential, damping=cable.damping,
        inertia=body.mass + added, moved_water=body.displaced + added, body_weight=body.weight, body_damping=damping,
        body_drag=drag, body_friction=vector_of(body.friction), above=above, above_faces=faces,
        profiles=np.zeros((0, 5, elements)) if profiles is None else profiles, wet=moving or dragged,
    )  # fmt: skip


class RopeModel:
    """A cable with its body, from rest in the shape in which it hangs.

    Args:
        cable, body: what hangs.
        motion: winch and vessel.
        current: steady water.
        elements: of degree 4 along the cable.
        force: on the body at the start, N, for the shape in which it hangs.
        step: s; the longest that is stable on the shortest length the winch reaches, by default.

    >>> model = RopeModel(CableData(2e7, 2.0, 19.62), BodyData(500.0, 4905.0), fixed(500.0), elements=4)
    >>> model.step(0.1)
    >>> model.time, bool(abs(model.tension[0] - 14715.0) < 1e-4), bool(abs(model.velocity).max() < 1e-9)
    (0.1, True, True)
    """

    def __init__(
        self, cable: CableData, body: BodyData, motion: Motion, current: SteadyCurrent | None = None, *,
        elements: int = 10, force: Vector = 0.0, step: float | None = None, booked: bool = False, settled: bool = True,
    ) -> None:  # fmt: skip
        self.motion, self.elements, self.time, self.booked = motion, elements, 0.0, booked
        current = current or SteadyCurrent()
        moving = bool(np.any(current.velocities))
        self.rope = make_rope(cable, body, elements, moving=moving or bool(np.any(body.drag) or np.any(body.damping)))
        self.water = water_of(current)
        self.largest_step = step
        self.state = make_rope_state(elements)
        self._force, self._thrust = vector_of(force), np.zeros(3)
        self.state.outside[0] = self._outside(np.zeros(1), 1)[0, 0]
        self._hang(settled)

    def _hang(self, settled: bool) -> None:
        outside = self.state.outside[0]
        sigma = node_positions(self.elements)
        found = hanging_shape(self.rope, self.water, outside.length, outside.vessel_position.copy(), self._force, sigma)
        put_shape(self.state, found.slopes, outside.length)
        if settled and outside.payout_speed == 0.0 and not outside.vessel_speed.any():
            settle(self.rope, self.state, np.zeros(0), self.water)
        look_at_rope(self.rope, self.state)

    def _outside(self, start: np.ndarray, dt: float) -> RopeOutside:
        """Winch and vessel at the start, end and middle of steps, shape (steps, 3)."""
        times = start[:, None] + dt * np.array([0.0, 1.0, 0.5])
        found = RopeOutside.many(start.size, STAGES)
        found["length"], found["payout_speed"] = self.motion.length(times)
        if self.motion.vessel is not None:
            found["vessel_position"], found["vessel_speed"] = self.motion.vessel(times)
        found["body_force"], found["body_thrust"] = self._force, self._thrust
        return found

    def step(self, duration: float, force: Any = None, thrust: Any = None) -> None:
        """Advance by ``duration``, s, in equal steps, with a force and a thrust on the body, N, held constant."""
        if force is not None:
            self._force = vector_of(force)
        if thrust is not None:
            self._thrust = vector_of(thrust)
        ends = self.motion.length(self.time + np.linspace(0.0, duration, 9))
        largest = self.largest_step or largest_step(
            self.rope, float(np.min(ends[0])), float(np.abs(ends[1]).max()), self.elements
        )
        count = max(1, ceil(duration / largest - 1e-9))
        dt = duration / count
        for begin in range(0, count, 20000):
            starts = self.time + dt * np.arange(begin, min(begin + 20000, count))
            loads = np.zeros((starts.size, STAGES, 0))
            run_rope(
                self.rope, self.state, self._outside(starts, dt), loads, self.water, np.full(starts.size, dt),
                self.booked,
            )  # fmt: skip
        self.time += duration

    @property
    def length(self) -> float:
        """Cable paid out, m."""
        return float(self.state.outside[0].length)

    @property
    def position(self) -> np.ndarray:
        """r at the nodes from sheave to body, m, shape (4 n + 1, 3)."""
        return self.state.outside[0].vessel_position + integrate(self._parts(0)).T

    @property
    def velocity(self) -> np.ndarray:
        """Dr/Dt at the nodes, m/s, shape (4 n + 1, 3)."""
        return to_nodal(self._parts(3)).T

    @property
    def tension(self) -> np.ndarray:
        """N at the nodes, N, shape (4 n + 1,); at the ends that of the waves which run into them."""
        found = to_nodal(np.maximum(self.state.stretch - 1.0, 0.0) * self.rope.stiffness)
        found[0], found[-1] = (np.sqrt((pull**2).sum()) for pull in (self.top_pull, self.end_pull))
        return found

    @property
    def top_pull(self) -> np.ndarray:
        """N t at the sheave, N, shape (3,)."""
        return self.state.ends[0].top_pull.copy()

    @property
    def end_pull(self) -> np.ndarray:
        """N t at the body, N, shape (3,)."""
        return self.state.ends[0].end_pull.copy()

    @property
    def body_velocity(self) -> np.ndarray:
        """Velocity of the body, m/s, shape (3,)."""
        return self.state.body[0].copy()

    @property
    def body_position(self) -> np.ndarray:
        """Position of the body, m, shape (3,)."""
        return self.position[-1]

    @property
    def energy(self) -> float:
        """Kinetic and elastic energy, J."""
        return float(rope_energy(self.rope, self.state.now[None], self.state.body[:1], np.array([self.length]))[0])

    @property
    def works(self) -> dict[str, float]:
        """Works since the start, J, of every term of the power balance."""
        return dict(zip(POWERS, self.state.work.tolist(), strict=True))

    def modes(self) -> np.ndarray:
        """Poles of small motions about the present state, 1/s, those above the real axis, slowest first."""
        found = np.linalg.eigvals(jacobian(self.rope, self.state, np.zeros(0), self.water))
        upper = found[found.imag > 1e-6]
        return upper[np.argsort(upper.imag)]

    def _parts(self, first: int) -> np.ndarray:
        """Three components at the nodes, shape (3, 5, n)."""
        n = self.elements
        columns = self.state.now[:, first * n : (first + 3) * n]
        return np.moveaxis(columns.reshape(5, 3, n), 1, 0)


def water_of(current: SteadyCurrent) -> WaterColumn:
    """Steady water for the kernels."""
    flow = np.zeros((STAGES, len(current.heights), 6))
    flow[:, :, :3] = np.array(current.velocities)
    return make_water(np.array(current.heights, dtype=float), flow)
