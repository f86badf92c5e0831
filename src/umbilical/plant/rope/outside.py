"""What acts on the rope from outside, sampled at the three stages of every step of a stretch."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from umbilical.plant import signals
from umbilical.plant.exogenous import END, MIDDLE, START, Inputs, Outside, Steps
from umbilical.plant.rope.records import STAGES, RopeOutside, Water
from umbilical.plant.seaway import sheave
from umbilical.plant.signals import Array, Side
from umbilical.plant.top import top_at, vessel_at
from umbilical.scenario.rope import Rope
from umbilical.scenario.scenario import Scenario


class RopeInputs(NamedTuple):
    """What acts from outside, step by step.

    Attributes:
        plane: as the string gets it: motors, winch and loads in the direction x.
        world: records at start, end and middle of each step, shape (steps, 3).
        loads: of the loads along the cable, N/m, shape (steps, 3, loads).
        water: the same at all steps.
    """

    plane: Inputs
    world: RopeOutside
    loads: Array
    water: Water


def vessel_in_space(scenario: Scenario, t: ArrayLike, side: Side = "right") -> tuple[Any, Any]:
    """Place, m, and velocity, m/s, of the sheave at instants of any shape: shape (..., 3)."""
    instants, rope, environment = np.asarray(t, dtype=float), scenario.rope or Rope(), scenario.environment
    along = vessel_at(environment, instants, side)
    waves = sheave(environment)
    others = [
        vessel_at(environment.model_copy(update={"vessel_motion": signal, "sea": None}), instants, side)
        for signal in (rope.vessel_across + waves.across, rope.vessel_heave + waves.up)
    ]
    place, speed = (np.stack(parts, axis=-1) for parts in zip(along, *others, strict=True))
    return place, speed


def still_water(rope: Rope) -> Water:
    """The water for the kernels: the current, which does not change in time."""
    levels = sorted(rope.current, key=lambda level: -level.height)
    flow = np.zeros((STAGES, max(len(levels), 1), 6))
    for k, level in enumerate(levels):
        flow[:, k, :2] = level.x, level.y
    return Water(np.array([level.height for level in levels] or [0.0]), flow)


class RopeSampler:
    """Samples the outside world of a scenario, stretch by stretch."""

    def __init__(self, scenario: Scenario) -> None:
        self._scenario, self._rope = scenario, scenario.rope or Rope()
        self._plane = Outside(scenario)
        self._water = still_water(self._rope)

    def sample(self, steps: Steps) -> RopeInputs:
        """All inputs at the given steps."""
        plane = self._plane.sample(steps)
        world = RopeOutside.many(steps.start.size, STAGES)
        middle = 0.5 * (steps.start + steps.end)
        self._fill(world[:, START], steps.start, "right")
        self._fill(world[:, END], steps.end, "left")
        self._fill(world[:, MIDDLE], middle, "right")
        ends = plane.loads
        loads = np.stack([ends[:, :, 0], ends[:, :, 1], 0.5 * (ends[:, :, 0] + ends[:, :, 1])], axis=1)
        return RopeInputs(plane, world, np.ascontiguousarray(loads), self._water)

    def _fill(self, out: RopeOutside, t: Array, side: Side) -> None:
        top = top_at(self._scenario.winch, t, side)
        out["length"], out["payout_speed"] = top.length, top.speed
        out["vessel_position"], out["vessel_speed"] = vessel_in_space(self._scenario, t, side)
        forces = (self._scenario.environment.payload_force, self._rope.force_across, self._rope.force_up)
        for i, signal in enumerate(forces):
            out["body_force"][:, i] = signals.evaluate(signal, t, side)
