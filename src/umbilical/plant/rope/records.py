"""Constants and state of the rope. Axes: x and y horizontal, z up from the water's surface.

Arrays along the cable lie as in ``plant/layout.py``: row j holds node j of every element, and the columns are
components one after the other, each of them n elements long.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.frames import Frame, real, vector
from umbilical.plant.layout import positions, to_elements
from umbilical.plant.orbital import LEVELS, NONE, Levels

AXES = 3
STAGES = 3
"""Of the step, at its start, its end and its middle (``plant/rope/step.py``)."""
POWERS = (
    "work_thrust", "work_payload_force", "work_payload_damping", "work_vessel", "work_cable_damping", "work_cable_load",
    "work_weight", "work_drag", "work_body_drag", "work_added_mass", "work_grid",
)  # fmt: skip
"""Terms of the power balance, in the order of ``RopeState.power``."""
THRUST, FORCE, FRICTION, VESSEL, DAMPING, LOAD, WEIGHT, DRAG, BODY_DRAG, ADDED, GRID = range(11)


class RopeConstants(NamedTuple):
    """Constants of cable and body, SI units; vectors have the shape (3,).

    Attributes:
        stiffness: EA, N.
        density: dry, flooded water included, kg/m.
        weight: in water, N/m; below 0 it floats.
        added: added mass across the cable rho_a, kg/m.
        displaced: water that the cable displaces, kg/m.
        normal_drag, tangential_drag: drag per metre over the square of the speed, N s2/m3.
        damping: linear damping of the horizontal velocity, N s/m2.
        inertia: m + A of the body along each axis, kg.
        moved_water: A and the displaced mass, which follow the water's acceleration, kg.
        body_weight: in water, N.
        body_damping, body_drag: linear, N s/m, and quadratic, N s2/m2, along each axis, through the water.
        body_friction: linear, over ground, N s/m.
        above: 1 - sigma at the nodes, shape (5, n).
        above_faces: 1 - sigma where elements meet, both ends included, shape (n + 1,).
        profiles: of the loads along the cable, shape (loads, 5, n).
        wet: whether the water moves, drags or is moved.
    """

    stiffness: float
    density: float
    weight: float
    added: float
    displaced: float
    normal_drag: float
    tangential_drag: float
    damping: float
    inertia: np.ndarray
    moved_water: np.ndarray
    body_weight: float
    body_damping: np.ndarray
    body_drag: np.ndarray
    body_friction: np.ndarray
    above: np.ndarray
    above_faces: np.ndarray
    profiles: np.ndarray
    wet: bool


class RopeOutside(Frame):
    """What winch, vessel and loads do at an instant."""

    length = real()
    payout_speed = real()
    vessel_position = vector(3)
    vessel_speed = vector(3)
    current_factor = real()
    current_rate = real()
    body_force = vector(3)
    body_thrust = vector(3)


class RopeEnds(Frame):
    """Both ends of the cable: r_x that enters at the vessel, and the tension vectors at vessel and body."""

    entering_stretch = vector(3)
    top_velocity = vector(3)
    top_pull = vector(3)
    end_pull = vector(3)


class WaterColumn(NamedTuple):
    """Velocity and acceleration of the water at some heights, at the stages of one step, and the waves' on top.

    Attributes:
        heights: m, decreasing from the surface, shape (levels,); beyond them the outermost values hold.
        flow: velocity, m/s, and acceleration, m/s2, shape (stages, levels, 6).
        profile: of the current, m/s, which a factor of time makes the flow, shape (levels, 3).
        waves: levels of the waves' orbital motion, below the sheave's mean height.
        orbit: velocity and rate there, along x, y and z, shape (stages, 2, 3, levels).
    """

    heights: np.ndarray
    flow: np.ndarray
    profile: np.ndarray
    waves: Levels
    orbit: np.ndarray


def make_water(heights: np.ndarray, flow: np.ndarray, waves: Levels = NONE) -> WaterColumn:
    """Water whose waves have not begun."""
    return WaterColumn(heights, flow, flow[0, :, :AXES].copy(), waves, np.zeros((STAGES, 2, AXES, LEVELS)))


class RopeState(NamedTuple):
    """Everything that moves, and room to work in.

    Attributes:
        now: l r_x and the velocity W = Dr/Dt at the nodes, shape (5, 6 n).
        base: the same at the start of the step.
        rate: their rates, shape (5, 6 n).
        pull: N t at the nodes, N, shape (5, 3 n).
        stretch: |r_x| at the nodes, shape (5, n).
        gradient: d/dsigma of l r_x, W and N t, shape (5, 9 n).
        star: W and N t where elements meet, shape (6, n + 1).
        flow: velocity and acceleration of the water at the nodes, shape (5, 6 n).
        joints: r where elements meet, m, shape (3, n + 1).
        height: z at the nodes, m, shape (5, n).
        body: velocity of the body, the same at the start of the step, and its rate, shape (3, 3).
        body_flow: velocity and acceleration of the water at the body, shape (6,).
        outside: the present instant, one record.
        ends: one record.
        power, work: terms of the power balance, W and J, in the order of :data:`POWERS`.
    """

    now: np.ndarray
    base: np.ndarray
    rate: np.ndarray
    pull: np.ndarray
    stretch: np.ndarray
    gradient: np.ndarray
    star: np.ndarray
    flow: np.ndarray
    joints: np.ndarray
    height: np.ndarray
    body: np.ndarray
    body_flow: np.ndarray
    outside: RopeOutside
    ends: RopeEnds
    power: np.ndarray
    work: np.ndarray


def make_rope_state(elements: int) -> RopeState:
    """A rope of no length at rest."""
    n, terms = elements, len(POWERS)
    return RopeState(
        now=np.zeros((5, 6 * n)), base=np.zeros((5, 6 * n)), rate=np.zeros((5, 6 * n)), pull=np.zeros((5, 3 * n)),
        stretch=np.zeros((5, n)), gradient=np.zeros((5, 9 * n)), star=np.zeros((6, n + 1)), flow=np.zeros((5, 6 * n)),
        joints=np.zeros((3, n + 1)), height=np.zeros((5, n)), body=np.zeros((3, 3)), body_flow=np.zeros(6),
        outside=RopeOutside.many(1), ends=RopeEnds.many(1), power=np.zeros(terms), work=np.zeros(terms),
    )  # fmt: skip


def make_above(elements: int) -> tuple[np.ndarray, np.ndarray]:
    """1 - sigma at the nodes, shape (5, n), and where elements meet, shape (n + 1,)."""
    above = 1.0 - positions(elements)
    return np.ascontiguousarray(to_elements(above)), np.ascontiguousarray(above[::4])


def vector_of(value: float | np.ndarray | tuple[float, ...]) -> np.ndarray:
    """A number for all axes, or one for each, as an array of shape (3,)."""
    return np.ascontiguousarray(np.broadcast_to(np.asarray(value, dtype=float), (AXES,)))
