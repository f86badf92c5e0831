"""Checks of a scenario with ``model = "rope"``: stretch, weights, thrusters, and the steps it takes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.errors import Problem
from umbilical.plant.checks.timeline import MOST_STEPS, check_signal, shapes
from umbilical.plant.initial import slope_of_shape
from umbilical.plant.rope.assemble import at_rest, rope_of, rope_step, section, stiffness, weights_of
from umbilical.plant.rope.outside import still_water
from umbilical.plant.rope.statics import node_positions
from umbilical.plant.top import top_at
from umbilical.relations.instants import apart
from umbilical.scenario.environment import EquilibriumShape
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.rope import Rope
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.signals import Pulse, Signal, Step

_STIFF, _WEAK = 100.0, 10.0
"""EA over the largest static load: below the first a stretch of 1 % is told, below the second refused."""
_SECONDS = 2.5e-7
"""Of computing for a node in a step, roughly."""
_SECONDS_OF_WAVE = 2e-8
"""Of the vessel's motion in a wave during a step, likewise."""


def signals_of(rope: Rope) -> Iterator[tuple[str, Signal, str]]:
    """Signals of the section with their keys and units."""
    yield "rope.vessel_across", rope.vessel_across, "m"
    yield "rope.force_across", rope.force_across, "N"
    yield "rope.force_up", rope.force_up, "N"


def signals(scenario: Scenario) -> Iterator[Finding]:
    """Terms of the section's signals make sense and cover the run; a ship does not jump."""
    for key, signal, _ in signals_of(section(scenario)):
        yield from check_signal(key, signal, scenario.duration)
        for number, term in enumerate(signal, start=1):
            if "vessel" in key and isinstance(term, Step | Pulse):
                yield Problem(
                    f"{key}.{number}.kind",
                    f'"{term.kind}"',
                    "constant, sine, bell or table",
                    "a jump of the vessel would tear the cable's end to another place at once",
                    "a table of the motion, or a bell",
                )


def rope_stretch(scenario: Scenario) -> Iterator[Finding]:
    """The cable bears what hangs on it."""
    given, load = stiffness(scenario), max(weights_of(scenario))
    if given < _WEAK * load:
        yield Problem(
            "cable.axial_stiffness",
            amount(given, "N"),
            f"above {_WEAK * load:.4g} N, ten times the static tension",
            "the cable would stretch by more than a tenth, where no material is linear",
            "the force over strain of the whole cable, EA, in newton",
        )
    elif given < _STIFF * load:
        yield Notice("cable.axial_stiffness", f"{given:.4g} N: the static stretch reaches {load / given:.2%}")


def rope_weights(scenario: Scenario) -> Iterator[Finding]:
    """Something pulls all along the cable at the start, and what is said of weights agrees."""
    end, top = weights_of(scenario)
    if not min(end, top) > 0.0:
        yield Problem(
            "payload.wet_weight",
            f"a static tension of {min(end, top):.4g} N",
            "above 0 all along the cable",
            "a cable that lifts the body up has no shape to start from under the sheave",
            "a heavier body (payload.wet_weight), a clump, or a cable that floats less",
        )


def thrusters(scenario: Scenario) -> Iterator[Finding]:
    """Every motor has a direction; a direction that nothing pushes in is told."""
    angles = section(scenario).thrust_directions
    if angles is not None and len(angles) != len(scenario.motors):
        yield Problem(
            "rope.thrust_directions",
            f"{len(angles)} entries",
            f"{len(scenario.motors)}, one for each motor",
            "each motor pushes in one direction",
            "an angle in radians for each: 0 along x, 1.5708 along y",
        )
    elif not scenario.ideal_thruster and scenario.motors and scenario.control.law.kind != "none":
        towards = np.abs(np.sin(angles or (0.0,)))
        rope, sideways = section(scenario), still_water(scenario).flow[:, :, 1].any()
        if towards.max() < 1e-9 and (rope.force_across or rope.vessel_across or sideways):
            yield Notice("rope.thrust_directions", "no motor pushes along y, where something acts: nothing holds y")


def rope_start(scenario: Scenario) -> Iterator[Finding]:
    """There is a shape at rest to start from."""
    if any(isinstance(found, Problem) for check in (rope_weights, rope_stretch, signals) for found in check(scenario)):
        return
    try:
        at_rest(scenario, rope_of(scenario), still_water(scenario))
    except ValueError as error:
        yield Problem(
            "initial",
            f'"{scenario.initial.shape}"',
            "a shape in which the cable hangs at rest in the current at the start",
            str(error),
            "a weaker current, or a heavier body",
        )


def seconds_of(scenario: Scenario) -> float:
    """Time the run will take, s, roughly: nodes and waves at every step."""
    count = scenario.duration / min(rope_step(scenario), scenario.control.period, scenario.grid.step)
    sea = scenario.environment.sea
    waves = sum(system.components for system in sea.systems) if sea else 0
    return (_SECONDS * 5 * section(scenario).elements + _SECONDS_OF_WAVE * waves) * count


def _lean(scenario: Scenario) -> Iterator[Finding]:
    """A shape at the start is no longer than its cable: a metre of it reaches less than a metre aside."""
    if any(True for _ in shapes(scenario.environment, scenario.initial)) or any(True for _ in rope_start(scenario)):
        return
    length = float(top_at(scenario.winch, 0.0).length)
    steepest = float(np.abs(slope_of_shape(scenario, node_positions(section(scenario).elements))).max()) / length
    if not isinstance(scenario.initial, EquilibriumShape) and not steepest < 1.0:
        yield Problem(
            "initial",
            f'"{scenario.initial.shape}", slopes up to {steepest:.3g}',
            "below 1",
            "y_x is the sine of the angle, and no cable of this length has that shape",
            "a smaller or a longer shape",
        )


def steps(scenario: Scenario) -> Iterator[Finding]:
    """The run does not take absurdly many steps."""
    largest, duration = rope_step(scenario), scenario.duration
    if largest * MOST_STEPS < duration:
        count, nodes = duration / largest, 5 * section(scenario).elements
        shortest = float(np.min(top_at(scenario.winch, np.linspace(0.0, duration, 201)).length))
        yield Problem(
            "rope.elements",
            str(section(scenario).elements),
            f"{MOST_STEPS:g} steps, not {count:.3g}, which take {_SECONDS * nodes * count / 3600.0:.2g} hours or more",
            f"a step is {apart(largest, duration)[0]} s: waves along the cable cross an element, {shortest:.4g} m of "
            "cable at the shortest, or the body gives its speed to the cable, in so short a time",
            "fewer rope.elements, a smaller cable.axial_stiffness, a heavier body, a shorter run",
        )


CHECKS = (signals, rope_stretch, rope_weights, thrusters, rope_start, _lean, steps)
"""What only a scenario with ``model = "rope"`` is asked."""
