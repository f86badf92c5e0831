"""Everything a run needs before its first step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from umbilical.compile import announce
from umbilical.control import cascade
from umbilical.control.contract import make_decision, make_readings
from umbilical.engine import loop
from umbilical.engine.recording import make_log, make_tally
from umbilical.engine.schedule import Clock, make_clock
from umbilical.engine.sensing import NoiseSource, make_sensor_state, make_sensors
from umbilical.engine.stepping import make_plant, make_plant_state
from umbilical.plant import faults
from umbilical.plant.checks.sizes import check_memory
from umbilical.plant.checks.steps import chosen_step
from umbilical.plant.exogenous import published_jumps
from umbilical.plant.forces.table import is_wet
from umbilical.relations.instants import count_up
from umbilical.scenario.scenario import Scenario


class Setup(NamedTuple):
    """Everything a run needs, built from its scenario; ``settings`` and ``memory`` are of the built-in controller."""

    clock: Clock
    world: loop.World
    record: loop.RunRecord
    dice: NoiseSource
    settings: cascade.CascadeSettings
    memory: cascade.CascadeState


def loop_of(scenario: Scenario, *, held: bool = False) -> str:
    """Name of the compiled loop that runs a scenario; ``held``: under commands from outside."""
    if scenario.model == "rope":
        return "run_rope_steps"
    return "run_held" if held else "run_steps" if is_wet(scenario.environment) else "run_dry_steps"


def set_up(scenario: Scenario, *, stored: bool = True, held: bool = False) -> Setup:
    """The plant at rest with its sensors, record and controller, before the first step.

    With ``stored`` false the record holds the first and the last sample only, and no power is booked.
    ``held``: commands will come from outside.

    Raises:
        ScenarioError: the samples would not fit into this machine's memory.
    """
    if stored:
        check_memory(scenario)
    announce(loop_of(scenario, held=held))
    jumps = published_jumps(scenario)
    clock = make_clock(scenario.duration, scenario.control.period, chosen_step(scenario), jumps)
    motors, elements = len(scenario.motors), scenario.grid.elements
    sensors, readings = make_sensors(scenario), make_readings(motors)
    world = loop.World(
        make_plant(scenario, booked=stored),
        make_plant_state(scenario),
        sensors,
        make_sensor_state(sensors, readings),
        readings,
        make_decision(motors),
    )
    settings, memory = cascade.make_settings(scenario), cascade.make_state(scenario)
    record = make_record(scenario, clock, stored, make_log, make_tally(elements, scenario.motors), elements)
    return Setup(clock, world, record, NoiseSource(sensors, scenario.seed), settings, memory)


def make_record(
    scenario: Scenario, clock: Clock, stored: bool, make_log: Callable[..., Any], tally: Any, elements: int
) -> loop.RunRecord:
    """Room for the samples that are kept, the last one always; of the string's log or of the rope's."""
    every = max(1, round(scenario.output.interval / clock.period) if stored else clock.periods)
    samples = clock.periods // every + 1 + (clock.periods % every > 0)
    first = faults.first_fault(scenario.faults)
    fault_update = clock.periods + 1 if first is None else count_up(first, clock.period)
    log = make_log(samples, len(scenario.motors), elements)
    return loop.RunRecord(log, tally, every, fault_update, clock.periods, clock.period)
