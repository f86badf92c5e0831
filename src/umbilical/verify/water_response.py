"""What drag does to a string shaken at the ROV: the linear loop of ``margins`` against runs at three amplitudes.

At a current `margins` takes drag with its slope there, in still water none. A run has all of it, and answers as its
equivalent linearisation at its own amplitude says, but for the higher harmonics.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy import sparse

from umbilical.engine.linear import linearise_plant
from umbilical.scenario.scenario import Scenario
from umbilical.stability.impedance import hanging_cable, payload_stiffness, waves_at_rov
from umbilical.tables import markdown
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Check, Checks, at_least
from umbilical.verify.engine import sine
from umbilical.verify.references.drag import Shaken
from umbilical.verify.water import DENSITY, DIAMETER, DISPLACED, GRAVITY, LINE, WET, string

CASES = Cases()
LENGTH, STEP, SETTLED, KEPT = 200.0, 5e-3, 200.0, 30.0
FREQUENCIES = (0.3, 0.6, 1.1, 2.0)
"""rad/s; the ROV swings at 0.2 rad/s by itself, and the cable's waves at 0.6, 1.2, 1.8."""
BODY: dict[str, Any] = {"added_mass": 1000.0, "quadratic_drag": 1500.0}
MASS, WEIGHT = 2000.0, 10e3


class _Water(NamedTuple):
    """A current at sheave and ROV, m/s, linear damping, N s/m2 and N s/m, and velocities of the ROV to try, m/s;
    tolerance of margins at the smallest and why, and those of equivalent linearisation at each."""

    top: float
    bottom: float
    line_linear: float
    linear: float
    velocities: tuple[float, float, float]
    limit: tuple[float, str]
    allowed: tuple[float, float, float]


CURRENT = _Water(0.5, 0.2, 0.0, 0.0, (0.02, 0.2, 0.8), (2e-3, "of second order in the velocity"), (2e-3, 0.06, 0.1))
STILL = _Water(
    0.0, 0.0, 1.0, 300.0, (0.001, 0.05, 0.8), (1e-2, "the drag of a millimetre per second"), (1e-3, 5e-3, 0.04)
)


def _shaken(water: _Water, force: float = 1.0, frequency: float = 1.0) -> Scenario:
    """A light ROV on 200 m, at rest in the current until a force shakes it, N and rad/s."""
    return string(
        LENGTH, cable__damping=water.line_linear, payload__mass=MASS, payload__wet_weight=WEIGHT,
        payload__water=BODY | {"linear_drag": water.linear}, environment__payload_force=[sine(force, frequency)],
        environment__water__current={"depths": [0.0, LENGTH], "speeds": [water.top, water.bottom]},
        initial={"shape": "equilibrium"}, grid={"elements": 8, "step": STEP}, control__period=STEP, duration=SETTLED,
        output__interval=10.0 * STEP,
    )  # fmt: skip


def _by_margins(water: _Water) -> np.ndarray:
    """Displacement of the ROV per force on it, m/N, of the exact cable with drag as `margins` takes it."""
    cable, p = hanging_cable(_shaken(water), LENGTH), 1j * np.array(FREQUENCIES)
    met = waves_at_rov(cable, p)
    return 1.0 / (payload_stiffness(cable, p) - (met.up + met.echo * met.down) / (1.0 + met.echo))


def _by_run(water: _Water, force: float, frequency: float) -> complex:
    """The part of a run at the frequency of the force, after it has settled, m/N."""
    tip = engine.finished(_shaken(water, force, frequency))["tip_displacement"]
    t, y = tip["time"].values, tip.values
    late = t > t[-1] - max(8.0 * np.pi / frequency, KEPT)
    turns = np.outer(t[late] * frequency, np.arange(1, 4))
    parts = np.hstack([np.ones((turns.shape[0], 1)), np.sin(turns), np.cos(turns)])
    found = np.linalg.lstsq(parts, y[late], rcond=None)[0]
    return complex(found[1], found[4]) / force


def _answers(water: _Water) -> np.ndarray:
    """By margins, by a run and by equivalent linearisation, m/N, of shape (velocities, 3, frequencies).

    Under the force that would move the ROV at the velocity by margins.
    """
    line = LINE + DISPLACED, WET * GRAVITY, water.line_linear, 0.5 * DENSITY * 1.2 * DIAMETER
    body = MASS + BODY["added_mass"], WEIGHT, water.linear, BODY["quadratic_drag"]
    equivalent, linear = Shaken(LENGTH, *line, *body, water.top, water.bottom), _by_margins(water)
    rows = []
    for velocity in water.velocities:
        driven = list(zip(velocity / (np.array(FREQUENCIES) * np.abs(linear)), FREQUENCIES, strict=True))
        rows.append([linear, [_by_run(water, *at) for at in driven], [equivalent.response(*at) for at in driven]])
    return np.array(rows)


def _apart(quantity: str, found: Any, exact: Any, tolerance: float, why: str) -> Check:
    """Complex numbers, each relative to its own; the size of the worst is shown."""
    off = np.abs(found - exact) / np.abs(exact)
    worst = int(np.argmax(off))
    return Check(quantity, abs(found[worst]), abs(exact[worst]), float(off[worst]), tolerance, why)


@CASES.add("string in water, shaken in {}", "finite differences with 2 k |u| or 8/(3 pi) k V for k |u_r| u_r",
           "equivalent linearisation for a sinusoid", {"a current": CURRENT, "still water": STILL})  # fmt: skip
def _judged(water: _Water) -> Checks:
    """`margins` at the smallest velocity, equivalent linearisation at all, and that they part at the largest."""
    plant, exact, answers = linearise_plant(_shaken(water)), _by_margins(water), _answers(water)
    shifted = (sparse.csc_array(1j * w * sparse.eye_array(plant.a.shape[0]) - plant.a) for w in FREQUENCIES)
    grid = np.array([plant.c[0] @ sparse.linalg.spsolve(matrix, plant.b[:, 0]) for matrix in shifted])
    what = "Y/F of the grid's matrices and of the exact cable, m/N"
    yield _apart(what, grid, exact, 1e-3, "drag that is even in each of 40 pieces")
    for velocity, tolerance, (linear, run, equal) in zip(water.velocities, water.allowed, answers, strict=True):
        if velocity == min(water.velocities):
            yield _apart(f"Y/F by margins, a run at {velocity:g} m/s, m/N", linear, run, *water.limit)
        quantity = f"Y/F by equivalent linearisation, a run at {velocity:g} m/s, m/N"
        yield _apart(quantity, equal, run, tolerance, "harmonics, which it leaves out")
    departure = float(np.abs(answers[-1, 0] / answers[-1, 1] - 1.0).min())
    why = "margins know nothing of the amplitude: it must be at least 5e-2"
    yield at_least(f"least distance of margins from a run at {water.velocities[-1]:g} m/s", departure, 5e-2, why)


def answers_table() -> str:
    """What docs/validation.md shows: size of Y/F in runs, and how far both linear answers are from it."""
    rows = [["current at sheave and ROV, m/s", "ROV, m/s", *(f"{frequency:g} rad/s" for frequency in FREQUENCIES)]]
    for water in (CURRENT, STILL):
        for velocity, answers in zip(water.velocities, _answers(water), strict=True):
            cells = (f"{1e3 * abs(run):.3g} ({_off(line, run)}, {_off(equal, run)})" for line, run, equal in answers.T)
            rows.append([f"{water.top:g}, {water.bottom:g}", f"{velocity:g}", *cells])
    return markdown(rows)


def _off(found: complex, exact: complex) -> str:
    """Distance in per cent."""
    off = 100.0 * abs(found / exact - 1.0)
    return f"{off:.0f} %" if off >= 10.0 else f"{off:.2g} %"
