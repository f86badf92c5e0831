"""The rope behind what simulate and Episode ask of a model."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt
from typing import Any

import numpy as np

from umbilical.compile import announce
from umbilical.control import cascade
from umbilical.control.allocation.table import Directions
from umbilical.control.cascade import CascadeSettings
from umbilical.control.contract import (
    Across,
    Measurement,
    MotorReadings,
    Readings,
    TipReadings,
    make_decision,
    make_readings,
    to_measurement,
)
from umbilical.engine.base import Model
from umbilical.engine.ending import base_metrics
from umbilical.engine.rope.loop import RopeControl, observe_once, run_rope_steps
from umbilical.engine.rope.recording import MOST_SNAPS, RopeTally, make_rope_log, make_rope_tally, rope_channels
from umbilical.engine.rope.world import RopeNow, RopePlant, RopePlantState, RopeWorld
from umbilical.engine.schedule import make_clock
from umbilical.engine.sensing import NoiseSource, SensorErrors, Side, make_sensor_state, make_sensors
from umbilical.engine.setup import loop_of, make_record
from umbilical.frames import numbers
from umbilical.plant.exogenous import published_jumps
from umbilical.plant.motors import MotorState, make_motors
from umbilical.plant.rope.assemble import initial_rope, rope_of, rope_step, section
from umbilical.plant.rope.energy import rope_energy
from umbilical.plant.rope.outside import RopeSampler, still_water
from umbilical.plant.rope.records import POWERS, STAGES, RopeConstants, RopeOutside
from umbilical.scenario.scenario import Scenario

DENSE = 0.5
"""|r_x| below which an element is too long for the loops of its slack cable."""


class SpatialModel(Model):
    """The rope, in space."""

    _works = POWERS

    def __init__(self, scenario: Scenario, *, stored: bool = True) -> None:
        announce(loop_of(scenario))
        self._scenario, self._elements, self._sampler = scenario, section(scenario).elements, RopeSampler(scenario)
        self._rope = rope_of(scenario)
        step = min(scenario.grid.step, rope_step(scenario))
        self.clock = make_clock(scenario.duration, scenario.control.period, step, published_jumps(scenario))
        self._world = self._make_world(stored)
        self.state, self._sides = self._world.state, (self._world.along, self._world.across)
        self._control = self._make_control()
        self._memories = self._control.along, self._control.across
        self._settings = cascade.with_known_factors(self._control.settings)
        self._record = make_record(scenario, self.clock, stored, make_rope_log, self._make_tally(), self._elements)
        seeds = scenario.seed, (scenario.seed, 1)
        self._dice = tuple(NoiseSource(side.sensors, seed) for side, seed in zip(self._sides, seeds, strict=True))

    def _make_world(self, stored: bool) -> RopeWorld:
        scenario, count = self._scenario, len(self._scenario.motors)
        sensors, readings, other = make_sensors(scenario), make_readings(count), make_readings(count)
        of_tip = sensors.errors[: len(TipReadings.fields)]
        across = SensorErrors(not any(any(numbers(error)) for error in of_tip), of_tip)
        tip_only = Readings(other.tip, other.winch, MotorReadings.many(0))
        rope = initial_rope(scenario, self._rope, still_water(scenario))
        state = RopePlantState(
            RopeNow.many(1), TipReadings.many(2), MotorState.many(count), rope, RopeOutside.many(STAGES)
        )
        motors, towards = make_motors(scenario.motors), directions(scenario)
        return RopeWorld(
            RopePlant(self._rope, motors, towards, scenario.ideal_thruster, stored),
            state,
            Side(sensors, make_sensor_state(sensors, readings), readings, make_decision(count)),
            Side(across, make_sensor_state(across, tip_only), other, make_decision(count)),
        )

    def _make_control(self) -> RopeControl:
        scenario, towards = self._scenario, directions(self._scenario)
        settings, across = cascade.make_settings(scenario), cascade.make_settings(scenario, across=True)
        memories = cascade.make_state(scenario), cascade.make_state(scenario)
        return RopeControl(settings, across, *memories, Directions(shares_of(settings, towards), towards))

    def _make_tally(self) -> RopeTally:
        rope = self.state.rope
        window = axial_period_of(self._rope, rope.outside[0].length)
        return make_rope_tally(self._elements, self._scenario.motors, window, rope.joints[:, -1])

    def run(self, inputs: Any, first: np.ndarray, noise: Any, begin: int) -> int:
        periods, decides = (0, first.size - 1), (True, False, False)
        return run_rope_steps(
            self._world, self._control, self._record, inputs, first, *noise, begin, periods, *decides
        )  # fmt: skip

    def observe(self, inputs: Any, first: np.ndarray, noise: Any, j: int) -> None:
        observe_once(self._world, inputs, first, *noise, j)

    def hold(
        self, inputs: Any, first: np.ndarray, noise: Any, begin: int, periods: tuple[int, int], driven: bool,
        decided: bool,
    ) -> int:  # fmt: skip
        control = self._control._replace(settings=self._settings)
        return run_rope_steps(
            self._world, control, self._record, inputs, first, *noise, begin, periods, False, driven, decided
        )

    def measurement(self) -> Measurement:
        found, ideal = super().measurement(), self._scenario.sensors.ideal_velocity
        other = to_measurement(self._sides[1].readings, ideal)
        across = Across(other.tip_displacement, other.tip_slope, other.tip_velocity, other.tip_slope_rate)
        return replace(found, across=across)

    def _cause(self) -> str:
        stretch = self.state.rope.stretch
        parted = np.isfinite(stretch).all() and stretch.max() > 1.0
        words = f"the cable was stretched to {float(stretch.max()):.3g} times its length: it has parted"
        return words if parted else ""

    def notices(self) -> tuple[str, ...]:
        tally, scenario, found = self._record.tally, self._scenario, list(super().notices())
        if scenario.ideal_thruster and scenario.control.law.closes_loop:
            peak = float(tally.measures[0].thrust.peak)
            found.append(
                f"ideal_thruster: thrusters without any limit gave up to {peak:.4g} N along x; whether yours can is "
                "not in this run: give [[motors]] with a voltage_limit"
            )
        if scenario.cable.axial_stiffness is None:
            found.append(
                f"cable.axial_stiffness: left out, {self._rope.stiffness:.4g} N assumed: ten thousand times the static "
                "tension at the vessel"
            )
        if tally.watch[0].smallest_stretch < DENSE:
            found.append(
                f"rope.elements: in slack |r_x| fell to {tally.watch[0].smallest_stretch:.2g}: loops of the cable are "
                "shorter than an element, and what happens in them is not resolved"
            )
        return tuple(found)

    def metrics(self) -> dict[str, float]:
        return {name: value for name, value in super().metrics().items() if np.isfinite(value)}

    def _measures(self) -> dict[str, float]:
        tally, watch = self._record.tally, self._record.tally.watch[0]
        found = base_metrics(tally, self.state.now[0].tip_displacement)
        found |= {name: getattr(watch, name) for name in ("top_tension_peak", "end_tension_peak", "lowest_tension")}
        found["slack_share"] = watch.slack_samples / max(int(tally.measures[0].samples), 1)
        found |= {name: getattr(watch, name) for name in ("snaps", "watch_radius", "smallest_stretch")}
        return found | ({"largest_snap": watch.largest_snap} if watch.snaps else {})

    def _channels(self, samples: int) -> dict[str, np.ndarray]:
        tally = self._record.tally
        self._snaps = tally.snaps[: min(int(tally.watch[0].snaps), MOST_SNAPS)]
        return rope_channels(self._record.log, samples, bool(self._scenario.motors), self._rope)

    def _energy(self, samples: int, named: dict[str, np.ndarray]) -> np.ndarray:
        return rope_energy(self._rope, self._record.log.nodes[:samples], named["body_velocity"], named["length"])


def directions(scenario: Scenario) -> np.ndarray:
    """Unit vectors of the motors' thrusts, shape (motors, 2); along x where nothing is said."""
    angles = section(scenario).thrust_directions or (0.0,) * len(scenario.motors)
    return np.array([[np.cos(angle), np.sin(angle)] for angle in angles]).reshape(-1, 2)


def shares_of(settings: CascadeSettings, towards: np.ndarray) -> np.ndarray:
    """Demand of each motor, before its sign, per newton wanted in x and y, shape (motors, 2).

    ``U_i = sgn(K_i) e_i . (sum_j |K_j| e_j e_j^T)^+ alpha``: with all motors along x the string's allocation.
    """
    factors = np.abs(settings.motors.nominal["thrust_coefficient"])
    together = np.einsum("i,ij,ik->jk", factors, towards, towards)
    return towards @ np.linalg.pinv(together, rcond=1e-9)


def axial_period_of(rope: RopeConstants, length: float) -> float:
    """Longest natural period of cable and body up and down, s, by Rayleigh's third of the cable."""
    mass = float(rope.inertia[2]) + rope.density * length / 3.0
    return 2.0 * pi * sqrt(mass * length / rope.stiffness)
