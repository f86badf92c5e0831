"""What drag does to a string shaken at the ROV: the linear loop of ``margins`` against runs at three amplitudes.

At a current `margins` takes drag with its slope there, in still water none. A run has all of it, and answers as its
equivalent linearisation at its own amplitude says, but for the higher harmonics.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse

from umbilical.engine.linear import linearise_plant
from umbilical.scenario.scenario import Scenario
from umbilical.stability.impedance import hanging_cable, payload_stiffness, waves_at_rov
from umbilical.tables import markdown
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, at_least
from umbilical.verify.engine import sine
from umbilical.verify.references.drag import Shaken
from umbilical.verify.water import DENSITY, DIAMETER, DISPLACED, GRAVITY, LINE, WET, string

LENGTH, STEP, SETTLED, KEPT = 200.0, 5e-3, 200.0, 30.0
FREQUENCIES = (0.3, 0.6, 1.1, 2.0)
"""rad/s; the ROV swings at 0.2 rad/s by itself, and the cable's waves at 0.6, 1.2, 1.8."""
BODY: dict[str, Any] = {"added_mass": 1000.0, "quadratic_drag": 1500.0}
MASS, WEIGHT = 2000.0, 10e3


class _Water(NamedTuple):
    """A current at sheave and ROV, m/s, linear damping, N s/m2 and N s/m, and velocities of the ROV to try, m/s."""

    top: float
    bottom: float
    line_linear: float
    linear: float
    velocities: tuple[float, float, float]


CURRENT = _Water(0.5, 0.2, 0.0, 0.0, (0.02, 0.2, 0.8))
STILL = _Water(0.0, 0.0, 1.0, 300.0, (0.001, 0.05, 0.8))


class _Answer(NamedTuple):
    """Displacement of the ROV per force on it, m/N, by margins, by a run and by equivalent linearisation."""

    linear: complex
    run: complex
    equivalent: complex


def _shaken(water: _Water, force: float = 1.0, frequency: float = 1.0) -> Scenario:
    """A light ROV on 200 m, at rest in the current until a force shakes it, N and rad/s."""
    return string(
        LENGTH, cable__damping=water.line_linear, payload__mass=MASS, payload__wet_weight=WEIGHT,
        payload__water=BODY | {"linear_drag": water.linear}, environment__payload_force=[sine(force, frequency)],
        environment__water__current={"depths": [0.0, LENGTH], "speeds": [water.top, water.bottom]},
        initial={"shape": "equilibrium"}, grid={"elements": 8, "step": STEP}, control__period=STEP, duration=SETTLED,
        output__interval=10.0 * STEP,
    )  # fmt: skip


def _by_margins(water: _Water, frequency: float) -> complex:
    """Of the exact cable with drag as `margins` takes it, m/N."""
    cable, p = hanging_cable(_shaken(water), LENGTH), np.array([1j * frequency])
    met = waves_at_rov(cable, p)
    pull = -(met.up + met.echo * met.down) / (1.0 + met.echo)
    return complex((1.0 / (payload_stiffness(cable, p) + pull))[0])


def _by_run(water: _Water, force: float, frequency: float) -> complex:
    """The part of a run at the frequency of the force, after it has settled, m/N."""
    tip = engine.completed(_shaken(water, force, frequency))["tip_displacement"]
    t, y = tip["time"].values, tip.values
    late = t > t[-1] - max(8.0 * np.pi / frequency, KEPT)
    turns = np.outer(t[late] * frequency, np.arange(1, 4))
    parts = np.hstack([np.ones((turns.shape[0], 1)), np.sin(turns), np.cos(turns)])
    found = np.linalg.lstsq(parts, y[late], rcond=None)[0]
    return complex(found[1], found[4]) / force


def _by_equivalent_linearisation(water: _Water, force: float, frequency: float) -> complex:
    """Of the finite differences, m/N."""
    line = LINE + DISPLACED, WET * GRAVITY, water.line_linear, 0.5 * DENSITY * 1.2 * DIAMETER
    body = MASS + BODY["added_mass"], WEIGHT, water.linear, BODY["quadratic_drag"]
    return Shaken(LENGTH, *line, *body, water.top, water.bottom).response(force, frequency)


def _answers(water: _Water, velocity: float) -> list[_Answer]:
    """At every frequency, under the force that would move the ROV at this velocity by `margins`, m/s."""
    found = []
    for frequency in FREQUENCIES:
        linear = _by_margins(water, frequency)
        force = velocity / (frequency * abs(linear))
        equivalent = _by_equivalent_linearisation(water, force, frequency)
        found.append(_Answer(linear, _by_run(water, force, frequency), equivalent))
    return found


def _by_the_grid(water: _Water, frequency: float) -> complex:
    """Of the engine's own rates, linearised where the cable rests, m/N."""
    plant = linearise_plant(_shaken(water))
    shifted = 1j * frequency * sparse.eye_array(plant.a.shape[0]) - plant.a
    return complex(plant.c[0] @ sparse.linalg.spsolve(sparse.csc_array(shifted), plant.b[:, 0]))


def _apart(quantity: str, found: list[complex], exact: list[complex], tolerance: float, why: str) -> Check:
    """Complex numbers, each relative to its own; the size of the worst is shown."""
    off = np.abs(np.array(found) - exact) / np.abs(exact)
    worst = int(np.argmax(off))
    return Check(quantity, abs(found[worst]), abs(exact[worst]), float(off[worst]), tolerance, why)


def _judged(water: _Water, linear: float, allowed: tuple[float, float, float], why: str) -> Iterator[Check]:
    """`margins` at the smallest velocity, equivalent linearisation at all, and that they part at the largest."""
    found = {velocity: _answers(water, velocity) for velocity in water.velocities}
    smallest, *_, largest = found
    exact = [_by_margins(water, frequency) for frequency in FREQUENCIES]
    grid = [_by_the_grid(water, frequency) for frequency in FREQUENCIES]
    what = "Y/F of the grid's matrices and of the exact cable, m/N"
    yield _apart(what, grid, exact, 1e-3, "drag that is even in each of 40 pieces")
    for velocity, tolerance in zip(found, allowed, strict=True):
        run = [answer.run for answer in found[velocity]]
        if velocity == smallest:
            yield _apart(f"Y/F by margins, a run at {velocity:g} m/s, m/N", exact, run, linear, why)
        equal = [answer.equivalent for answer in found[velocity]]
        quantity = f"Y/F by equivalent linearisation, a run at {velocity:g} m/s, m/N"
        yield _apart(quantity, equal, run, tolerance, "harmonics, which it leaves out")
    departure = min(abs(answer.linear / answer.run - 1.0) for answer in found[largest])
    why = "margins know nothing of the amplitude: it must be at least 5e-2"
    yield at_least(f"least distance of margins from a run at {largest:g} m/s", departure, 5e-2, why)


def answers_table() -> str:
    """What docs/validation.md shows: size of Y/F in runs, and how far both linear answers are from it."""
    head = ["current at sheave and ROV, m/s", "ROV, m/s", *(f"{frequency:g} rad/s" for frequency in FREQUENCIES)]
    rows = [head]
    for water in (CURRENT, STILL):
        for velocity in water.velocities:
            cells = [
                f"{1e3 * abs(a.run):.3g} ({_off(a.linear, a.run)}, {_off(a.equivalent, a.run)})"
                for a in _answers(water, velocity)
            ]
            rows.append([f"{water.top:g}, {water.bottom:g}", f"{velocity:g}", *cells])
    return markdown(rows)


def _off(found: complex, exact: complex) -> str:
    """Distance in per cent."""
    off = 100.0 * abs(found / exact - 1.0)
    return f"{off:.0f} %" if off >= 10.0 else f"{off:.2g} %"


EQUIVALENT = "finite differences with 2 k |u| or 8/(3 pi) k V for k |u_r| u_r"
CASES = (
    Case("string in water, shaken in a current", EQUIVALENT, "equivalent linearisation for a sinusoid",
         lambda: _judged(CURRENT, 2e-3, (2e-3, 0.06, 0.1), "of second order in the velocity")),
    Case("string in water, shaken in still water", EQUIVALENT, "equivalent linearisation for a sinusoid",
         lambda: _judged(STILL, 1e-2, (1e-3, 5e-3, 0.04), "the drag of a millimetre per second")),
)  # fmt: skip
