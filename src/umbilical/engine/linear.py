"""The engine's own step as matrices: what frequencies, margins and spectra are read from.

Differences of the rates of cable and ROV about a cable at rest in the current give their Jacobian there: no second
discretisation that could differ from the one that runs, and a force that is not linear counts with its slope at that
point, a quadratic drag with that of the current and in still water with none. With the winch stopped no rate depends
on the shape in which the cable rests, so a straight one stands for all. The state lists the slopes and velocities of a
block (5, 2 n) as they lie in memory (``plant/layout.py``), then the ROV's velocity: 10 n + 1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from umbilical.control.contract import TipReadings
from umbilical.engine.linearise import Linear, Names, differences
from umbilical.engine.loop import World
from umbilical.engine.sensing import read_truth
from umbilical.engine.setup import set_up
from umbilical.engine.stepping import enter_step, find_rates
from umbilical.frames import numbers
from umbilical.plant.cable import PRESENT, RATES
from umbilical.plant.elements import DEGREE, WEIGHTS
from umbilical.plant.exogenous import Outside, Steps, current_at, variation_of
from umbilical.plant.multistep import EXPLICIT
from umbilical.plant.top import top_at
from umbilical.relations.water import payload_inertia
from umbilical.scenario.scenario import Scenario

SAMPLES = tuple(TipReadings.fields)


@dataclass(frozen=True)
class LinearPlant(Linear):
    """Cable and ROV with the winch stopped, as the engine sees them: ``x' = a x + b F``, ``z = c x``.

    Attributes:
        a: sparse, shape (10 n + 1, 10 n + 1), 1/s.
        b: rate per newton of force on the ROV, shape (10 n + 1, 1).
        c: y(l,t), y_x(l,t), Dy/Dt(l,t) and D(y_x)/Dt(l,t) from the state, shape (4, 10 n + 1).
        d: zero, shape (4, 1).
        step: step of the plant, s. The engine advances the rates by the third-order Adams-Bashforth weights
            ``w = (23, -16, 5)/12``, so with a force F that is held for the step, in terms of the shift z by one step,
            ``x = ((z - 1) I - step (w0 + w1/z + w2/z^2) a)^-1 step b F``.
    """

    step: float = 0.0


def linearise_plant(scenario: Scenario, time: float = 0.0) -> LinearPlant:
    """Rates of cable and ROV with the winch stopped, no load, no heave and no thrust, eqs. (6)-(8), at rest.

    Args:
        scenario: its cable, ROV, gravity, current, grid and step are used; loads, vessel and controller are left out.
        time: the winch stops at the length it has then, s, and the current is as it is then.

    >>> import umbilical
    >>> linearise_plant(umbilical.load("paper", {"grid.elements": 4})).a.shape
    (41, 41)
    """
    still = _stopped(scenario, time)
    setup = set_up(still)
    world, step = setup.world, setup.clock.period / setup.clock.substeps
    enter_step(world.plant, world.state, Outside(still).sample(Steps(np.zeros(1), np.full(1, step), np.zeros(0))), 0)
    size = world.state.blocks[PRESENT].size + 1
    entries, samples = [], np.zeros((len(SAMPLES), size))
    samples[0, :-1].reshape(5, -1)[:, : still.grid.elements] = WEIGHTS[:, None] / (2 * still.grid.elements)
    directions = list(_independent(still.grid.elements))
    moved = differences(lambda state: _rates_and_samples(world, state), np.zeros(size), directions)
    for columns, change in zip(directions, moved, strict=True):
        entries.append(_entries(change[:size], columns, still.grid.elements))
        # The ROV feels and the sensors see the last element and the ROV only; the displacement is the sum above.
        samples[1:, columns[-1]] = change[size + 1 :]
    rows, columns, values = (np.concatenate(part) for part in zip(*entries, strict=True))
    push = np.zeros((size, 1))
    push[-1] = 1.0 / payload_inertia(still.payload)
    rates = sparse.csc_array((values, (rows, columns)), shape=(size, size))
    names = Names(inputs=("thrust",), outputs=SAMPLES)
    return LinearPlant(rates, push, samples, np.zeros((len(SAMPLES), 1)), names, step)


def _independent(elements: int) -> Iterator[np.ndarray]:
    """Places of the state that no rate depends on together: every third element, as neighbours only meet; the ROV."""
    for node in range(DEGREE + 1):
        for half in (0, elements):
            for first in range(min(3, elements)):
                yield 2 * elements * node + half + np.arange((elements - 1 - first) % 3, elements, 3)
    yield np.array([2 * elements * (DEGREE + 1)])


def _entries(rate: np.ndarray, columns: np.ndarray, elements: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows, columns and values of the Jacobian from the rates at several unit vectors at once."""
    size = rate.size
    element = np.full(size, elements - 1)
    element[:-1] = np.tile(np.arange(elements), 2 * (DEGREE + 1))
    of = np.full(1, elements - 1) if columns[0] == size - 1 else columns % elements
    row, which = np.nonzero(np.abs(element[:, None] - of) <= 1)
    felt = (row < size - 1) | (of[which] == elements - 1)
    row, which = row[felt], which[felt]
    return row, columns[which], rate[row]


def step_matrix(scenario: Scenario, time: float = 0.0) -> np.ndarray:
    """One step from the state and its last two rates to the same one step later, shape (30 n + 3, 30 n + 3).

    Arguments as for :func:`linearise_plant`.

    >>> import umbilical
    >>> step_matrix(umbilical.load("paper", {"grid.elements": 4})).shape
    (123, 123)
    """
    plant = linearise_plant(scenario, time)
    rates, (now, last, before) = plant.a.toarray(), plant.step * EXPLICIT[2]
    one, none = np.eye(rates.shape[0]), np.zeros_like(rates)
    return np.block([[one + now * rates, last * one, before * one], [rates, none, none], [none, one, none]])


def _stopped(scenario: Scenario, time: float) -> Scenario:
    """The scenario with its winch stopped and nothing that acts from outside."""
    quiet = {"payload_force": [], "cable_load": [], "vessel_motion": [], "sea": None, "vessel_heave": None}
    if variation_of(scenario.environment):
        factor = float(current_at(scenario.environment, np.array(time))[0])
        quiet["water.current.variation"] = [{"kind": "constant", "value": factor - 1.0}]
    return scenario.replace(
        {
            "winch": {"law": "constant", "length": float(top_at(scenario.winch, time).length)},
            "initial": {"shape": "straight"},
            "motors": [],
            "faults": [],
            "ideal_thruster": True,
            "control": {"period": scenario.control.period, "law": {"kind": "none"}},
        }
        | {f"environment.{name}": value for name, value in quiet.items()}
    )


def _rates_and_samples(world: World, values: np.ndarray) -> np.ndarray:
    """Rates at a state, then what the sensors at the ROV read."""
    state = world.state
    block, ends = state.blocks[PRESENT], state.now[0].ends
    block.flat[:], ends.tip_velocity = values[:-1], values[-1]
    find_rates(world.plant, state)
    read_truth(state, world.readings)
    return np.concatenate([state.blocks[RATES].ravel(), ends.tip_rates[:1], numbers(world.readings.tip[0])])
