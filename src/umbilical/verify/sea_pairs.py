"""What must hold between two runs in waves: of the string and the rope, and of two descriptions of one sea."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from umbilical.plant.seaway import sheave
from umbilical.scenario.scenario import Scenario
from umbilical.sea import BoxVessel
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, at_least, each_close, history_close, small
from umbilical.verify.invariance import ROUND_OFF, TWO_RUNS, WHY
from umbilical.verify.references import sea as reference
from umbilical.verify.water import BODY, DIAMETER, string

SHIP: dict[str, Any] = {"kind": "box", "length": 93.0, "breadth": 20.0, "draught": 6.6, "block_coefficient": 0.75}
SHEAVE = {"sheave_forward": 10.0, "sheave_up": 8.0}
SYSTEM: dict[str, Any] = {"significant_height": 1.0, "peak_period": 8.0, "heading": 2.0, "components": 40}
SEA: dict[str, Any] = {"systems": [SYSTEM], "vessel": SHIP | SHEAVE, "plane": 2.0, "orbital_below": 6.6}
TMS: dict[str, Any] = BODY | {"displaced_mass": 5400.0}
LINEAR: dict[str, Any] = {
    "cable__water": {"diameter": DIAMETER, "normal_drag": 0.0, "tangential_drag": 0.0},
    "payload__water": TMS | {"quadratic_drag": 0.0, "vertical_drag": 0.0},
}
"""Nothing that goes with the square of a speed."""
CALMED: dict[str, Any] = {"cable__damping": 3.0, "payload__damping": 8000.0}
"""What makes a run forget its start within two minutes."""
STIFF, ELASTIC = 1e9, 2.6e7
"""EA, N, of a rope that is nearly a string, and of the work-class umbilical."""


def sea(system: dict[str, Any] | None = None, **changes: Any) -> dict[str, Any]:
    """That sea with changes of its one system, and of itself."""
    return SEA | {"systems": [SYSTEM | (system or {})]} | changes


def _in_waves(state: dict[str, Any] | None, **changes: Any) -> Scenario:
    """A string of 100 m in still water under a sea."""
    base = {"environment__vessel_ramp": 5.0, "environment__water__current": None, "environment__sea": state,
            "payload__water": TMS, "grid__elements": 6, "duration": 10.0, "output__interval": 0.2}  # fmt: skip
    return string(100.0, **base | changes)


def _displaced(state: dict[str, Any] | None, **changes: Any) -> np.ndarray:
    """Displacement y of that string, m, shape (samples, nodes)."""
    return engine.completed(_in_waves(state, **changes))["displacement"].values


def _moved_by_waves() -> Iterator[Check]:
    """What the orbital motion of a small sea makes of a string, and of a stiff rope."""
    low, rope = {"significant_height": 1e-3}, {"cable.axial_stiffness": STIFF, "model": "rope", "rope.elements": 6}
    rows = []
    for change in ({}, rope):
        with_waves, without = (
            engine.completed(_in_waves(sea(low, orbital_below=depth)).replace(change))["displacement"].values
            for depth in (6.6, None)
        )
        rows.append(with_waves - without)
    gap = float(abs(rows[0] - rows[1]).max() / abs(rows[0]).max())
    yield small("y that the waves in the water add, share of its largest", gap, 1e-3, "the rope's stretch and heave")


def _later() -> Iterator[Check]:
    """The waves of a seed, and the same waves as they are 20 s later, given as numbers: in y and in the tension."""
    heaving = sea({"significant_height": 2.5}, seed=5, orbital_below=None, heave=True)
    here = _in_waves(heaving, cable__axial_stiffness=ELASTIC, duration=170.0, **CALMED)
    waves, delay = sheave(here.environment), 20.0
    there = here.replace({"environment.sea": None, "duration": 170.0 - delay, "environment.vessel_motion": [
        _ahead(term, delay) for term in waves.along], "environment.vessel_heave": [
        _ahead(term, delay) for term in waves.up]})  # fmt: skip
    first, second = engine.completed(here), engine.completed(there)
    late = second["time"].values > 120.0
    for name in ("tip_displacement", "top_tension"):
        found, exact = second[name].values[late], first[name].values[-late.sum() :]
        yield history_close(name, found, exact, 1e-5, "what two minutes leave of the start")


def _ahead(term: Any, time: float) -> dict[str, Any]:
    """Regular waves as they are some time later."""
    told = term.model_dump(mode="json")
    phases = [phase + omega * time for phase, omega in zip(told["phases"], told["frequencies"], strict=True)]
    return told | {"phases": phases}


def _twice_as_high() -> Iterator[Check]:
    """Twice the height doubles y of a string without drag, and the tension that heave adds."""
    double = {"significant_height": 2.0}
    once, twice = (_displaced(sea(height), **LINEAR) for height in ({}, double))
    yield history_close("y, m", twice, 2.0 * once, ROUND_OFF, WHY)
    heaving = {"cable__axial_stiffness": ELASTIC, **LINEAR}
    still, low, high = (
        engine.completed(_in_waves(state, **heaving))["top_tension"].values
        for state in (sea({"significant_height": 0.0}, heave=True), sea(heave=True), sea(double, heave=True))
    )
    yield history_close("tension at the sheave, N", high - still, 2.0 * (low - still), ROUND_OFF, WHY)


def _twice_as_many() -> Iterator[Check]:
    """Twice the components change no statistics."""
    rows = []
    for count in (200, 400):
        state = sea({"significant_height": 2.5, "components": count}, heave=True)
        run = engine.completed(_in_waves(
            state, cable__axial_stiffness=ELASTIC, grid__elements=4, grid__step=0.02, control__period=0.02,
            duration=10800.0, **CALMED))  # fmt: skip
        late = run["time"].values > 200.0
        rows.append([run[name].values[late].std() for name in ("tip_velocity", "top_tension")])
    yield each_close("rms of Dy/Dt(l) and of the tension at the sheave", rows[1], rows[0], 0.02, "three hours of 8 s")


def _no_response() -> Iterator[Check]:
    """A vessel that answers none of the waves that are there is one that lies still."""
    degrees = np.repeat(np.arange(0.0, 181.0, 30.0), 4)
    rows = {"heading": np.radians(degrees).tolist(), "frequency": [0.1, 0.2, 0.3, 6.0] * 7,
            "heave": [1.0, 1.0, 0.0, 0.0] * 7, "heave_phase": [0.0] * 28}  # fmt: skip
    table = {"kind": "rao", "phase": "lag", "axes": "port_up", "waves": "towards", **SHEAVE, **rows}
    heaving, pushed = {"cable__axial_stiffness": ELASTIC}, {"environment__payload_force": [engine.sine(500.0, 0.7)]}
    still = sea(vessel=table, orbital_below=None, heave=True)
    found, exact = _displaced(still, **heaving, **pushed), _displaced(None, **pushed)
    yield history_close("y, m", found, exact, 1e-12, "the same arithmetic")
    stirred = _displaced(sea(vessel=table), **pushed)
    share = float(abs(stirred - exact).max() / abs(exact).max())
    yield at_least("what waves in the water add, share of y", share, 1e-3, "must be at least 1e-3")


def _full_turn() -> Iterator[Check]:
    """Headings a full turn apart."""
    spread = {"spreading": 4.0, "directions": 3, "components": 20}
    for name, more in {"long-crested": {}, "spread": spread}.items():
        here, there = (_displaced(sea({"heading": angle} | more)) for angle in (2.0, 2.0 - 2.0 * np.pi))
        yield history_close(f"y, {name}, m", there, here, ROUND_OFF, WHY)


def _other_conventions() -> Iterator[Check]:
    """One vessel by tables of two conventions: lag and lead, headings towards and from, axes up and down."""
    ship = BoxVessel(93.0, 20.0, 6.6, 0.75)
    runs = [_displaced(sea(vessel=reference.rao_rows(ship, convention) | SHEAVE)) for convention in CONVENTIONS]
    yield history_close("y by lead for y by lag, m", runs[1], runs[0], 1e-7, "round-off in the tables' ninth digit")


CONVENTIONS = tuple(reference.CONVENTIONS.values())[:2]
SMALL, LIKE = "small motions of a stiff rope", "nothing has changed but words"
CASES = (
    Case("sea, string and rope in waves", TWO_RUNS, SMALL, _moved_by_waves),
    Case("sea, waves of later", TWO_RUNS, "no instant is before others", _later),
    Case("sea, waves twice as high", TWO_RUNS, "linear without drag", _twice_as_high),
    Case("sea, twice as many waves", TWO_RUNS, "one spectrum", _twice_as_many, quick=False),
    Case("sea, ship without an answer", "a run without a sea", LIKE, _no_response),
    Case("sea, headings a full turn apart", TWO_RUNS, LIKE, _full_turn),
    Case("sea, one vessel in two conventions", TWO_RUNS, LIKE, _other_conventions),
)
