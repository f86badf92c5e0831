"""The string in water without waves: added mass, drag and current against what is known in closed form, and what drag
does to a string shaken at the ROV: the linear loop of ``margins`` against runs at three amplitudes.

At a current `margins` takes drag with its slope there, in still water none. A run has all of it, and answers as its
equivalent linearisation at its own amplitude says, but for the higher harmonics.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy import sparse

from umbilical.engine.linear import linearise_plant
from umbilical.library import load
from umbilical.plant.equilibrium import equilibrium
from umbilical.relations import tension as law
from umbilical.scenario.scenario import Scenario
from umbilical.stability.impedance import hanging_cable, payload_stiffness, waves_at_rov
from umbilical.tables import markdown
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Check, Checks, at_least, close, same_history, small
from umbilical.verify.engine import open_loop, sine
from umbilical.verify.hanging_string import BESSEL, CHAIN
from umbilical.verify.references.drag import Shaken
from umbilical.verify.references.hanging_string import HangingString, frequencies
from umbilical.verify.references.water import Hung, Sliding

CASES, SHAKEN = Cases(), Cases()
DENSITY, GRAVITY, DIAMETER = 1025.0, 9.81, 0.04
DISPLACED = DENSITY * np.pi * DIAMETER**2 / 4.0
"""1.288 kg/m."""
LINE, WET, MASS, WEIGHT = 5.412, 4.124, 9000.0, 35e3
BODY: dict[str, Any] = {
    "added_mass": 8000.0, "vertical_added_mass": 8000.0, "quadratic_drag": 3000.0, "vertical_drag": 4500.0,
}  # fmt: skip
UNIFORM = {"depths": [0.0, 1000.0], "speeds": [0.5, 0.5]}
SEA: dict[str, Any] = {
    "environment.gravity": GRAVITY, "cable.line_density": LINE, "cable.wet_line_density": WET,
    "environment.water": {"density": DENSITY, "current": {"depths": [0.0, 200.0], "speeds": [0.5, 0.1]}},
    "cable.water": {"diameter": DIAMETER}, "payload.mass": MASS, "payload.wet_weight": WEIGHT, "payload.water": BODY,
}  # fmt: skip
"""A TMS with its ROV on an umbilical of 40 mm in a sheared current."""
HANGS = Hung(WET * GRAVITY, WEIGHT, 0.5 * DENSITY * 1.2 * DIAMETER * 0.25, 3000.0 * 0.25, 1000.0)
"""1000 m of it in 0.5 m/s."""
ALONE = HANGS._replace(force=0.0)
"""The same with a body that nothing drags."""
CLOSED, DIGITS = "closed form", (1e-4, "four digits")


def string(length: float, **changes: Any) -> Any:
    """That string in open loop at a constant length, m."""
    hung = open_loop(winch={"law": "constant", "length": length})
    return hung.replace(SEA | engine.UNDAMPED | engine.dotted(changes))


@CASES.add("string in water, sheave at {:+g} m/s", "(S - rho v)/(S + rho v), waves of d'Alembert",
           "constant tension and speed", (1.0, 20.0, -20.0))  # fmt: skip
def _returned(speed: float) -> Checks:
    """A bump meets the sheave while the cable slides through it."""
    exact, until = Sliding(60e3, 5.408, DISPLACED, speed), 5.0
    run = engine.finished(string(
        1000.0, winch={"law": "speed", "start_length": 1000.0, "speed": speed},
        initial={"shape": "gaussian", "amplitude": 1.0, "distance": 1000.0 - exact.center, "width": exact.width},
        cable__line_density=exact.line_density, cable__wet_line_density=0.0,
        cable__water={"diameter": DIAMETER, "normal_drag": 0.0, "tangential_drag": 0.0},
        environment__water__current=None, payload__wet_weight=exact.tension,
        payload__water=BODY | {"quadratic_drag": 0.0, "vertical_drag": 0.0},
        grid__elements=120, grid__step=5e-4, duration=until, output__interval=until,
    ))  # fmt: skip
    went, came, returned = exact.parts(run["sigma"].values * (1000.0 + speed * until), until)
    y, slope, rate = (sum(fields) for fields in zip(went, came, returned, strict=True))
    for name, found in (("displacement", y), ("slope", slope), ("velocity", rate + speed * slope)):
        what = f"{name} after {until:g} s"
        yield same_history(what, run[name].values[-1], found, 5e-4, "what 120 elements leave of it")
    shape = returned[1] / exact.reflection
    ratio = float((run["slope"].values[-1] - went[1] - came[1]) @ shape / (shape @ shape))
    why = "with the added mass sliding along it misses by 4e-3 at 1 m/s, without any by 2e-3"
    yield close(f"slope returned over slope that came, {speed:g} m/s", ratio, exact.reflection, 1e-4, why)


@CASES.add("string in water, tension", CLOSED, "axial balance of what hangs and sinks")
def _tensions() -> Checks:
    """Buoyancy bears weight and accelerates nothing."""
    s, a, limit = np.linspace(0.0, 700.0, 50), 0.3, (1e-12, "round-off")
    light = law.hanging(500.0, 2.0, GRAVITY, 4000.0, 0.0)
    found = law.tension(s, GRAVITY - a, light)
    yield close("T of a cable without weight, N", found, 4000.0 - (500.0 + 2.0 * s) * a, *limit)
    drags = law.across(law.sinking(light, law.AxialDrag(50.0, 0.5), -2.0), 0.4, -2.0)
    exact = 4000.0 + 4.0 * (50.0 + 0.5 * s) - 0.4 * 4.0
    yield close("Tt while it is hauled in at 2 m/s, N", law.tension(s, GRAVITY, drags), exact, *limit)


@CASES.add("string in water, statics", "q l/w + (F - q W/w)/w ln(1 + w l/W)", "T y_x = F + q (l - x)")
def _statics() -> Checks:
    """The offset in a uniform current, what holds it back, and a run that starts there and stays."""
    scenario = string(1000.0, environment__water__current=UNIFORM, grid__elements=16)
    free, held = equilibrium(scenario), equilibrium(scenario, tip=0.0)
    yield close("y(l) in 0.5 m/s, m", free.displacement[-1], HANGS.offset(), *DIGITS)
    yield close("force that holds it, N", held.thrust, HANGS.holding(), *DIGITS)
    changes = {"initial": {"shape": "equilibrium"}, "duration": 100.0, "output.interval": 10.0}
    y = engine.finished(scenario.replace(changes))["displacement"]
    there = np.interp(y["sigma"].values, free.sigma, free.displacement)
    yield same_history("y over 100 s from there, m", y.values, np.broadcast_to(there, y.shape), *DIGITS)


@CASES.add("string in water, frequencies", BESSEL, CHAIN)
def _scaled() -> Checks:
    """Added mass slows the waves: the hanging chain with M in place of rho and m + A_h in place of m."""
    for name, body in (("body free", MASS), ("body held", 1e9)):
        scenario = string(1000.0, payload__mass=body, environment__water__current=None, grid__elements=32)
        inertia, moved = LINE + DISPLACED, body + BODY["added_mass"]
        wet = HangingString(inertia, moved, 1000.0, GRAVITY, WEIGHT / (moved * GRAVITY), WET / inertia)
        found = np.imag(engine.modes(scenario, 3)[0])
        yield close(f"w1, w2, w3, {name}, rad/s", found, frequencies(wet, 3), *DIGITS)


@CASES.add("string in water, frequencies by added mass", "sqrt(rho/(rho + rho_a))", "an independent computation")
def _slowed() -> Checks:
    """Added mass of the cable against none: sqrt(rho/M) where the body is held, less where it swings along."""

    def frequencies_with(added: float, mass: float) -> np.ndarray:
        found = string(
            1000.0, payload__mass=mass, payload__water=BODY | {"added_mass": 0.0}, grid__elements=32,
            environment__water__current=None, cable__water={"diameter": DIAMETER, "added_mass": added},
        )  # fmt: skip
        return np.imag(engine.modes(found, 4)[0])

    held, free = (frequencies_with(1.0, mass) / frequencies_with(0.0, mass) for mass in (1e9, MASS))
    exact = np.full(3, np.sqrt(LINE / (LINE + DISPLACED)))
    why = "modes 2 to 4, of the cable alone: a body of a million tons hardly moves"
    yield close("frequencies over those without added mass, body held", held[1:], exact, 1e-6, why)
    known = [0.983, 0.908, 0.901]
    yield close("the same with a body of 9 t, modes 1 to 3", free[:3], known, 5e-4 / 0.9, "three digits are known")


STATION = {"station_gain": 0.1, "washout_time": 120.0}


@CASES.add("string in water, law with a station", "rest at the station", CLOSED, [(STATION, 0.0, ALONE.holding())])
@CASES.add("string in water, law without a station", "rest where y_x(l) = 0", CLOSED, [({}, ALONE.offset(), 0.0)])
def _station(rest: tuple[dict[str, float], float, float]) -> Checks:
    """The boundary law with all it wants to know, for 3000 s; options, and place and thrust at the end."""
    options, place, thrust = rest
    run = engine.finished(load("paper", {
        **SEA, "environment.water": {"current": UNIFORM}, "payload.water": {}, "environment.payload_force": [],
        "control.law": {"kind": "boundary", "damping_gain": 1e4, "slope_gain": 5.0, "rates": "sensor", **options},
        "winch": {"law": "constant", "length": 1000.0}, "motors": [], "ideal_thruster": True,
        "sensors.ideal_velocity": True, "control.velocity_observer": None, "control.slope_observer": None,
        "control.motor_loop": None, "control.disturbance_observer.gain": 1.0, "control.period": 5e-3,
        "grid.step": 5e-3, "grid.elements": 16, "duration": 3000.0, "output.interval": 1.0,
    }))  # fmt: skip
    tip, last, why = run["tip_displacement"].values[-1], run["thrust"].values[-1], "what has not settled in 3000 s"
    yield small("y(l) less where it rests, over 51 m", (tip - place) / ALONE.offset(), 1e-3, why)
    yield small("thrust less what holds it there, over 2685 N", (last - thrust) / ALONE.holding(), 1e-3, why)


SHORT, STEP, SETTLED, KEPT = 200.0, 5e-3, 200.0, 30.0
FREQUENCIES = (0.3, 0.6, 1.1, 2.0)
"""rad/s; the ROV swings at 0.2 rad/s by itself, and the cable's waves at 0.6, 1.2, 1.8."""
LIGHT: dict[str, Any] = {"added_mass": 1000.0, "quadratic_drag": 1500.0}
LIGHT_MASS, LIGHT_WEIGHT = 2000.0, 10e3


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
        SHORT, cable__damping=water.line_linear, payload__mass=LIGHT_MASS, payload__wet_weight=LIGHT_WEIGHT,
        payload__water=LIGHT | {"linear_drag": water.linear}, environment__payload_force=[sine(force, frequency)],
        environment__water__current={"depths": [0.0, SHORT], "speeds": [water.top, water.bottom]},
        initial={"shape": "equilibrium"}, grid={"elements": 8, "step": STEP}, control__period=STEP, duration=SETTLED,
        output__interval=10.0 * STEP,
    )  # fmt: skip


def _by_margins(water: _Water) -> np.ndarray:
    """Displacement of the ROV per force on it, m/N, of the exact cable with drag as `margins` takes it."""
    cable, p = hanging_cable(_shaken(water), SHORT), 1j * np.array(FREQUENCIES)
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
    body = LIGHT_MASS + LIGHT["added_mass"], LIGHT_WEIGHT, water.linear, LIGHT["quadratic_drag"]
    equivalent, linear = Shaken(SHORT, line, body, (water.top, water.bottom)), _by_margins(water)
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


@SHAKEN.add("string in water, shaken in {}", "finite differences with 2 k |u| or 8/(3 pi) k V for k |u_r| u_r",
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
