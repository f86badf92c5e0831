"""The rope behind what simulate and Episode ask of a model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import pi, sqrt
from typing import Any

import numpy as np

from umbilical.compile import announce
from umbilical.control import cascade
from umbilical.control.allocation.table import Directions
from umbilical.control.cascade import CascadeSettings
from umbilical.control.contract import (
    Across,
    Command,
    Measurement,
    MotorReadings,
    Readings,
    TipReadings,
    make_decision,
    make_readings,
    to_measurement,
)
from umbilical.engine import loop
from umbilical.engine.ending import Ending, base_metrics, closed, held_values, only_measured, stored_times
from umbilical.engine.model import arrays_of
from umbilical.engine.rope.loop import RopeControl, RopeRecord, observe_once, run_rope_steps
from umbilical.engine.rope.recording import MOST_SNAPS, make_rope_log, make_rope_tally, rope_channels
from umbilical.engine.rope.world import RopeNow, RopePlant, RopePlantState, RopeWorld, Side
from umbilical.engine.saturation import saturation, saturation_notices
from umbilical.engine.schedule import Stretch, make_clock
from umbilical.engine.sensing import NoiseSource, SensorErrors, make_sensor_state, make_sensors
from umbilical.engine.setup import loop_of
from umbilical.frames import numbers
from umbilical.plant import faults
from umbilical.plant.exogenous import published_jumps
from umbilical.plant.layout import positions
from umbilical.plant.motors import MotorState, make_motors
from umbilical.plant.rope.assemble import initial_rope, rope_of, rope_step, section
from umbilical.plant.rope.energy import rope_energy
from umbilical.plant.rope.outside import RopeSampler, still_water
from umbilical.plant.rope.records import POWERS, STAGES, RopeConstants, RopeOutside
from umbilical.relations.instants import count_up
from umbilical.run import Run, Status, assemble
from umbilical.scenario.scenario import Scenario

DENSE = 0.5
"""|r_x| below which an element is too long for the loops of its slack cable."""


class SpatialModel:
    """The rope, in space."""

    def __init__(self, scenario: Scenario, *, stored: bool = True) -> None:
        announce(loop_of(scenario))
        self._scenario, self._stored = scenario, stored
        self._rope, self._water = rope_of(scenario), still_water(scenario)
        step = min(scenario.grid.step, rope_step(scenario))
        self.clock = make_clock(scenario.duration, scenario.control.period, step, published_jumps(scenario))
        self._world, self._control = self._make_world(), self._make_control()
        self._held = self._control._replace(settings=cascade.with_known_factors(self._control.settings))
        self._record = self._make_record()
        self.every = self._record.every
        self._sampler = RopeSampler(scenario)
        self._dice = (
            NoiseSource(self._world.along.sensors, scenario.seed),
            NoiseSource(self._world.across.sensors, (scenario.seed, 1)),
        )

    def _make_world(self) -> RopeWorld:
        scenario, count = self._scenario, len(self._scenario.motors)
        sensors, readings, other = make_sensors(scenario), make_readings(count), make_readings(count)
        of_tip = sensors.errors[: len(TipReadings.fields)]
        across = SensorErrors(not any(any(numbers(error)) for error in of_tip), of_tip)
        tip_only = Readings(other.tip, other.winch, MotorReadings.many(0))
        state = RopePlantState(
            RopeNow.many(1),
            TipReadings.many(2),
            MotorState.many(count),
            initial_rope(scenario, self._rope, self._water),
            RopeOutside.many(STAGES),
        )
        plant = RopePlant(
            self._rope, make_motors(scenario.motors), directions(scenario), scenario.ideal_thruster, self._stored
        )
        return RopeWorld(
            plant,
            state,
            Side(sensors, make_sensor_state(sensors, readings), readings, make_decision(count)),
            Side(across, make_sensor_state(across, tip_only), other, make_decision(count)),
        )

    def _make_control(self) -> RopeControl:
        scenario = self._scenario
        settings = cascade.make_settings(scenario)
        along, across = cascade.make_state(scenario), cascade.make_state(scenario)
        return RopeControl(
            settings, cascade.make_settings(scenario, across=True), along, across,
            Directions(shares_of(settings, directions(scenario)), directions(scenario)),
        )  # fmt: skip

    def _make_record(self) -> RopeRecord:
        scenario, clock = self._scenario, self.clock
        every = max(1, round(scenario.output.interval / clock.period) if self._stored else clock.periods)
        samples = clock.periods // every + 1 + (clock.periods % every > 0)
        first = faults.first_fault(scenario.faults)
        elements, state = section(scenario).elements, self._world.state.rope
        return RopeRecord(
            make_rope_log(samples, len(scenario.motors), elements),
            make_rope_tally(
                elements, scenario.motors, axial_period_of(self._rope, state.outside[0].length), state.joints[:, -1]
            ),
            every,
            clock.periods + 1 if first is None else count_up(first, clock.period),
            clock.periods,
            clock.period,
        )

    def sample(self, part: Stretch) -> Any:
        inputs = self._sampler.sample(part.steps)
        inputs.plane.refresh[0] |= part.steps.start[0] == 0.0
        return inputs

    def draw(self, updates: int) -> Any:
        return tuple(dice.draw(updates) for dice in self._dice)

    def run(self, inputs: Any, first: np.ndarray, noise: Any, begin: int) -> int:
        return run_rope_steps(
            self._world, self._control, self._record, inputs, first, *noise, begin, (0, first.size - 1), True, False,
            False,
        )  # fmt: skip

    def observe(self, inputs: Any, first: np.ndarray, noise: Any, j: int) -> None:
        observe_once(self._world, inputs, first, *noise, j)

    def hold(
        self, inputs: Any, first: np.ndarray, noise: Any, begin: int, periods: tuple[int, int], driven: bool,
        decided: bool,
    ) -> int:  # fmt: skip
        return run_rope_steps(
            self._world, self._held, self._record, inputs, first, *noise, begin, periods, False, driven, decided
        )

    def start(self) -> None:
        cascade.start(self._held.settings, self._held.along, self._world.along.readings)

    def take(self, command: Command, t: float) -> bool:
        plant, decision = self._world.plant, self._world.along.decision
        loop.check_command(command, plant.ideal, decision, t, can_drive=self._held.settings.motors.driven)
        loop.put_command(command, decision)
        self._world.across.decision.outer[0].thrust_command = command.thrust_across
        return command.voltage is None and not plant.ideal

    def measurement(self) -> Measurement:
        ideal = self._scenario.sensors.ideal_velocity
        found, other = (to_measurement(side.readings, ideal) for side in (self._world.along, self._world.across))
        across = Across(other.tip_displacement, other.tip_slope, other.tip_velocity, other.tip_slope_rate)
        return Measurement(
            found.tip_displacement, found.tip_slope, found.motor_speed, found.motor_current, found.length,
            found.payout_speed, found.payout_acceleration, found.tip_velocity, found.tip_slope_rate,
            found.tip_tension, across,
        )  # fmt: skip

    def changing(self, rows: int) -> Iterator[np.ndarray]:
        world, control = self._world, self._control
        sides = [part for side in (world.along, world.across) for part in side[1:]]
        state = (world.state, *sides, control.along, control.across, self._record.tally)
        yield from (array for part in state for array in arrays_of(part))
        yield from (array[:rows] for array in arrays_of(self._record.log))

    def dice(self) -> tuple[Any, ...]:
        return tuple(dice.save() for dice in self._dice)

    def restore_dice(self, mark: tuple[Any, ...]) -> None:
        for dice, saved in zip(self._dice, mark, strict=True):
            dice.restore(saved)

    def so_far(self) -> tuple[int, float]:
        updates = int(self._record.tally.measures[0].samples)
        return updates, max(updates - 1, 0) * self.clock.period

    def diverged(self, update: int) -> Ending:
        time = update * self.clock.period
        stretch = self._world.state.rope.stretch
        if np.isfinite(stretch).all() and stretch.max() > 1.0:
            why = f"the cable was stretched to {float(stretch.max()):.3g} times its length: it has parted"
        else:
            why = "a state or a voltage is no longer finite"
        return Ending(Status.DIVERGED, f"at t = {time:g} s {why}", update, time)

    def notices(self) -> tuple[str, ...]:
        tally, scenario = self._record.tally, self._scenario
        found = [str(notice) for notice in saturation_notices(scenario, tally)]
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
        scenario, tally, now = self._scenario, self._record.tally, self._world.state.now[0]
        watch, count = tally.watch[0], max(int(tally.measures[0].samples), 1)
        found = base_metrics(tally, float(now.tip_displacement)) | {
            "top_tension_peak": watch.top_tension_peak,
            "end_tension_peak": watch.end_tension_peak,
            "lowest_tension": watch.lowest_tension,
            "slack_share": watch.slack_samples / count,
            "snaps": watch.snaps,
            "watch_radius": watch.watch_radius,
            "smallest_stretch": watch.smallest_stretch,
        }
        if watch.snaps:
            found["largest_snap"] = watch.largest_snap
        found = only_measured(scenario, found) | saturation(scenario, tally)
        return {name: float(value) for name, value in found.items() if np.isfinite(value)}

    def assemble(
        self, ending: Ending, notices: tuple[str, ...], timing: dict[str, float],
        logged: Sequence[tuple[int, Mapping[str, float]]] = (),
    ) -> Run:  # fmt: skip
        every, scenario, log = self.every, self._scenario, self._record.log
        times = stored_times(scenario, ending, self.clock, every, log.now.size)
        named, metrics = rope_channels(log, times.size, bool(scenario.motors), self._rope), self.metrics()
        if times.size:
            metrics |= self._balance(times.size, named)
        updates = np.minimum(np.arange(times.size) * every, self.clock.periods)
        return assemble(
            scenario, named, time=times, **ending.told(), metrics=metrics, timing=timing, notices=notices,
            sigma=positions(section(scenario).elements), logged=held_values(logged, updates),
            snaps=self._record.tally.snaps[: min(int(self._record.tally.watch[0].snaps), MOST_SNAPS)],
        )  # fmt: skip

    def _balance(self, samples: int, named: dict[str, np.ndarray]) -> dict[str, float]:
        """As ``closed``, with the energy."""
        works = np.stack([named[name] for name in POWERS], axis=1)
        named["energy"] = rope_energy(
            self._rope, self._record.log.nodes[:samples], named["body_velocity"], named["length"]
        )
        return closed(named, works)


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
