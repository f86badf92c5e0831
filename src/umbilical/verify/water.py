"""The string in water without waves: added mass, drag and current against what is known in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.plant.equilibrium import equilibrium
from umbilical.relations import tension as law
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, close, same_history, small
from umbilical.verify.engine import open_loop
from umbilical.verify.hanging_string import BESSEL, CHAIN
from umbilical.verify.references.hanging_string import HangingString, frequencies
from umbilical.verify.references.water import Hung, Sliding

CASES = Cases()
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
