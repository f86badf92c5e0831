"""Checks of a scenario with ``model = "rope"``: stretch, weights, thrusters, and the steps it takes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import wraps

import numpy as np

from umbilical.errors import Problem
from umbilical.plant.checks.stretch import stretches_little
from umbilical.plant.checks.timeline import (
    MOST_STEPS,
    check_signal,
    refuses,
    shapes,
    signals_of_the_environment,
    tables_of_the_winch,
    vessel_does_not_jump,
)
from umbilical.plant.checks.water import table_of_the_current
from umbilical.plant.initial import slope_of_shape
from umbilical.plant.rope.assemble import at_rest, rope_of, rope_step, section, stiffness, weights_of
from umbilical.plant.rope.outside import still_water
from umbilical.plant.rope.statics import node_positions
from umbilical.plant.top import top_at
from umbilical.relations.instants import apart
from umbilical.scenario.environment import EquilibriumShape
from umbilical.scenario.findings import Finding, Notice
from umbilical.scenario.scenario import Scenario

_SECONDS = 2.5e-7
"""Of computing for a node in a step, roughly."""
_SECONDS_OF_WAVE = 2e-8
"""Of the vessel's motion in a wave during a step, likewise."""


def signals(scenario: Scenario) -> Iterator[Finding]:
    """Terms of the section's signals make sense and cover the run; a ship does not jump."""
    rope = section(scenario)
    for name in ("vessel_across", "force_across", "force_up"):
        yield from check_signal(f"rope.{name}", getattr(rope, name), scenario.duration)
    yield from vessel_does_not_jump("rope.vessel_across", rope.vessel_across)


def rope_stretch(scenario: Scenario) -> Iterator[Finding]:
    """The cable bears what hangs on it."""
    yield from stretches_little(stiffness(scenario), max(weights_of(scenario)))


def rope_weights(scenario: Scenario) -> Iterator[Finding]:
    """Something pulls all along the cable at the start, and what is said of weights agrees."""
    if not (least := min(weights_of(scenario))) > 0.0:
        yield Problem("payload.wet_weight", f"a static tension of {least:.4g} N", "above 0 all along the cable",
                      "a cable that lifts the body up has no shape to start from under the sheave",
                      "a heavier body (payload.wet_weight), a clump, or a cable that floats less")  # fmt: skip


def thrusters(scenario: Scenario) -> Iterator[Finding]:
    """Every motor has a direction; a direction that nothing pushes in is told."""
    rope, key, count = section(scenario), "rope.thrust_directions", len(scenario.motors)
    angles = rope.thrust_directions
    if angles is not None and len(angles) != count:
        yield Problem(key, f"{len(angles)} entries", f"{count}, one for each motor",
                      "each motor pushes in one direction",
                      "an angle in radians for each: 0 along x, 1.5708 along y")  # fmt: skip
    elif not scenario.ideal_thruster and count and scenario.control.law.kind != "none":
        sideways = rope.force_across or rope.vessel_across or still_water(scenario).flow[:, :, 1].any()
        if np.abs(np.sin(angles or (0.0,))).max() < 1e-9 and sideways:
            yield Notice(key, "no motor pushes along y, where something acts: nothing holds y")


def rope_start(scenario: Scenario) -> Iterator[Finding]:
    """There is a shape at rest to start from."""
    if any(refuses(check(scenario)) for check in (rope_weights, rope_stretch, signals)):
        return
    try:
        at_rest(scenario, rope_of(scenario), still_water(scenario))
    except ValueError as error:
        yield Problem("initial", f'"{scenario.initial.shape}"',
                      "a shape in which the cable hangs at rest in the current at the start", str(error),
                      "a weaker current, or a heavier body")  # fmt: skip


def seconds_of(scenario: Scenario) -> float:
    """Time the run will take, s, roughly: nodes and waves at every step."""
    count = scenario.duration / min(rope_step(scenario), scenario.control.period, scenario.grid.step)
    sea = scenario.environment.sea
    waves = sum(system.components for system in sea.systems) if sea else 0
    return (_SECONDS * 5 * section(scenario).elements + _SECONDS_OF_WAVE * waves) * count


def _lean(scenario: Scenario) -> Iterator[Finding]:
    """A shape at the start is no longer than its cable: a metre of it reaches less than a metre aside."""
    if refuses(shapes(scenario.environment, scenario.initial)) or refuses(rope_start(scenario)):
        return
    length, shape = float(top_at(scenario.winch, 0.0).length), scenario.initial
    steepest = float(np.abs(slope_of_shape(scenario, node_positions(section(scenario).elements))).max()) / length
    if not isinstance(shape, EquilibriumShape) and not steepest < 1.0:
        yield Problem("initial", f'"{shape.shape}", slopes up to {steepest:.3g}', "below 1",
                      "y_x is the sine of the angle, and no cable of this length has that shape",
                      "a smaller or a longer shape")  # fmt: skip


def steps(scenario: Scenario) -> Iterator[Finding]:
    """The run does not take absurdly many steps."""
    largest, duration, elements = rope_step(scenario), scenario.duration, section(scenario).elements
    if largest * MOST_STEPS < duration:
        count, hours = duration / largest, _SECONDS * 5 * elements * duration / largest / 3600.0
        shortest = float(np.min(top_at(scenario.winch, np.linspace(0.0, duration, 201)).length))
        yield Problem("rope.elements", str(elements),
                      f"{MOST_STEPS:g} steps, not {count:.3g}, which take {hours:.2g} hours or more",
                      f"a step is {apart(largest, duration)[0]} s: waves along the cable cross an element, "
                      f"{shortest:.4g} m of cable at the shortest, or the body gives its speed to the cable, in so "
                      "short a time",
                      "fewer rope.elements, a smaller cable.axial_stiffness, a heavier body, a shorter run"
                      )  # fmt: skip


def _once_tables_are_sound(check: Callable[[Scenario], Iterator[Finding]]) -> Callable[[Scenario], Iterator[Finding]]:
    """A check that computes with the tables of a scenario, which are refused by checks of their own."""

    @wraps(check)
    def able(scenario: Scenario) -> Iterator[Finding]:
        environment, duration = scenario.environment, scenario.duration
        tables = (
            table_of_the_current(environment),
            signals_of_the_environment(environment, duration),
            shapes(environment, scenario.initial),
            tables_of_the_winch(scenario.winch, duration),
        )
        if not any(map(refuses, tables)):
            yield from check(scenario)

    return able


CHECKS = (signals, *map(_once_tables_are_sound, (rope_stretch, rope_weights, thrusters, rope_start, _lean, steps)))
"""What only a scenario with ``model = "rope"`` is asked."""
