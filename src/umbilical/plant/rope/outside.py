"""What acts on the rope from outside, sampled at the three stages of every step of a stretch."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from umbilical.plant import signals
from umbilical.plant.exogenous import END, MIDDLE, START, Inputs, Outside, Steps, current_at
from umbilical.plant.orbital import levels_of
from umbilical.plant.rope.records import STAGES, RopeOutside, WaterColumn, make_water
from umbilical.plant.seaway import sheave
from umbilical.plant.signals import Array, Side
from umbilical.plant.top import top_at, vessel_at
from umbilical.scenario.rope import Rope
from umbilical.scenario.scenario import Scenario

CALM = make_water(np.zeros(1), np.zeros((STAGES, 1, 6)))
"""Water at rest."""


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
    water: WaterColumn

    @property
    def refresh(self) -> Array:
        """Whether something jumped at the start of each step."""
        return self.plane.refresh


def vessel_in_space(scenario: Scenario, t: ArrayLike, side: Side = "right") -> tuple[Any, Any]:
    """Place, m, and velocity, m/s, of the sheave at instants of any shape: shape (..., 3)."""
    instants, rope, environment = np.asarray(t, dtype=float), scenario.rope or Rope(), scenario.environment
    along = vessel_at(environment, instants, side)
    waves = sheave(environment)
    others = [
        vessel_at(environment.model_copy(update={"vessel_motion": signal, "sea": None}), instants, side)
        for signal in (rope.vessel_across + waves.across, (environment.vessel_heave or ()) + waves.up)
    ]
    place, speed = (np.stack(parts, axis=-1) for parts in zip(along, *others, strict=True))
    return place, speed


def still_water(scenario: Scenario) -> WaterColumn:
    """The water for the kernels as it is at the start: the current, and the waves before they begin."""
    water, waves = scenario.environment.water, levels_of(scenario.environment)
    if water is None or water.current is None:
        return make_water(CALM.heights, CALM.flow, waves)
    current = water.current
    flow = np.zeros((STAGES, len(current.depths), 6))
    flow[:, :, 0] = current.speeds
    if current.speeds_across is not None:
        flow[:, :, 1] = current.speeds_across
    found = make_water(-np.array(current.depths), flow, waves)
    found.flow[:] *= current_at(scenario.environment, np.zeros(1))[0]
    return found


def forces_on_the_body(scenario: Scenario, t: ArrayLike, side: Side = "right") -> Any:
    """External force on the body at instants of any shape, N: shape (..., 3)."""
    rope = scenario.rope or Rope()
    given = (scenario.environment.payload_force, rope.force_across, rope.force_up)
    return np.stack([signals.evaluate(signal, np.asarray(t, dtype=float), side) for signal in given], axis=-1)


class RopeSampler:
    """Samples the outside world of a scenario, stretch by stretch."""

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario
        self._plane = Outside(scenario)
        self._water = still_water(scenario)

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
        out["current_factor"], out["current_rate"] = current_at(self._scenario.environment, t, side)
        out["body_force"] = forces_on_the_body(self._scenario, t, side)
