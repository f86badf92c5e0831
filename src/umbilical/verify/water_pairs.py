"""What must hold between two runs of the string in water and in waves, and what must not: drag adds no responses up."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from umbilical.compile import plain
from umbilical.plant.equilibrium import equilibrium
from umbilical.plant.forces import drag
from umbilical.plant.layout import to_elements, to_nodal
from umbilical.plant.seaway import sheave
from umbilical.plant.top import top_at
from umbilical.relations.water import line_inertia
from umbilical.run import Run
from umbilical.scenario.scenario import Scenario
from umbilical.sea import BoxVessel
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, at_least, close, same_history, small
from umbilical.verify.engine import constant, from_rest, gentle, open_loop, sine
from umbilical.verify.invariance import BENT, ROUND_OFF, TWO_RUNS, sum_missed
from umbilical.verify.references import sea as reference
from umbilical.verify.water import BODY, DIAMETER, DISPLACED, LINE, MASS, UNIFORM, string

CASES, SEA_CASES = Cases(), Cases()
BODY_DISPLACED = 5000.0
HEAVE = (0.3, 0.8)
"""m and rad/s."""


def _moved(**changes: Any) -> Run:
    """Ten seconds of that string with winch and heave at work, from a bent start."""
    base: dict[str, Any] = {
        "winch": {"law": "quintic", "start_length": 100.0, "end_length": 108.0, "duration": 10.0}, "initial": BENT,
        "environment__vessel_heave": from_rest(*HEAVE), "grid__elements": 8, "duration": 10.0, "output__interval": 0.1,
    }  # fmt: skip
    return engine.finished(string(100.0, **base | changes))


@CASES.add("string in water, moving frame", TWO_RUNS, "Galilei and d'Alembert")
def _moving_frame() -> Checks:
    """Vessel, water and ROV carried along by s(t): y + s, where d'Alembert's force acts on what the water leaves.

    Added mass and Froude-Krylov force carry the water's share, so that is the mass less the displaced one. The frame
    ``s = a (1 - cos w t)^2`` sets off gently.
    """
    a, w, quarter, speed = 0.3, 0.5, np.pi / 2.0, 0.5
    rate, body = 2.0 * a * w / speed, BODY | {"displaced_mass": BODY_DISPLACED}

    def pushed(mass: float) -> list[dict[str, Any]]:
        force = mass * (2.0 * a * w * w)
        return [sine(force, w, quarter), sine(-force, 2.0 * w, quarter)]

    still = _moved(environment__water__current=UNIFORM, payload__water=body)
    carried = _moved(
        payload__water=body, environment__vessel_motion=gentle(a, w),
        environment__water__current=UNIFORM | {"variation": [sine(rate, w), sine(-0.5 * rate, 2.0 * w)]},
        environment__payload_force=pushed(MASS - BODY_DISPLACED),
        environment__cable_load=[{"profile": {"shape": "uniform"}, "signal": pushed(LINE - DISPLACED)}],
    )  # fmt: skip
    t, why = still["time"].values[:, None], "third order in the step of 1 ms, of a slow motion"
    drift = a * (1.0 - np.cos(w * t)) ** 2
    faster = 2.0 * a * w * np.sin(w * t) * (1.0 - np.cos(w * t))
    for shown, name, added in (("y + s, m", "displacement", drift), ("Dy/Dt + s', m/s", "velocity", faster)):
        yield same_history(shown, carried[name].values, still[name].values + added, ROUND_OFF[0], why)


@CASES.add("string in water, mirror image", TWO_RUNS, "(A0) is odd in y and u")
def _mirror_image() -> Checks:
    """y -> -y, the current from the other side."""
    right, left = (
        _moved(
            environment__water__current={"depths": [0.0, 200.0], "speeds": [0.5 * sign, 0.1 * sign]},
            environment__vessel_motion=from_rest(0.2 * sign, 1.1),
            environment__payload_force=[sine(500.0 * sign, 0.7)], initial=BENT | {"amplitude": sign},
        )["displacement"].values
        for sign in (1.0, -1.0)
    )  # fmt: skip
    yield same_history("y, m", left, -right, *ROUND_OFF)


@CASES.add("string in water, diameter for coefficients", TWO_RUNS, "only C d and C d^2 count")
def _same_product() -> Checks:
    """Twice the diameter at half the drag and a quarter of the added mass."""
    thin, thick = (
        _moved(cable__line_density=LINE, cable__water={
            "diameter": 0.03 * n, "normal_drag": 1.2 / n, "tangential_drag": 0.02 / n, "added_mass": 1.0 / n**2})
        for n in (1, 2)
    )  # fmt: skip
    yield same_history("y, m", thick["displacement"].values, thin["displacement"].values, *ROUND_OFF)


@CASES.add("string in water, superposition", "sum of two responses", "linear without drag across")
def _superposed() -> Checks:
    """Added mass is linear, and so is the lateral part of the drag along the cable; drag across is not."""

    def missed(normal: float, quadratic: float) -> float:
        return sum_missed(lambda force, start: _moved(
            environment__water__current=None, environment__payload_force=[sine(force, 0.7)],
            cable__water={"diameter": 0.04, "normal_drag": normal, "tangential_drag": 0.01},
            payload__water=BODY | {"quadratic_drag": quadratic}, initial=BENT | {"amplitude": start},
        )["displacement"].values, 2e3, 1.0)  # fmt: skip

    yield small("y of a sum less the sum of y, no drag across", missed(0.0, 0.0), *ROUND_OFF)
    why = "|u_r| u_r is not linear: it must be at least 1e-2"
    yield at_least("the same with drag", missed(1.2, 3000.0), 1e-2, why)


@CASES.add("string in water, out and in", "statics", "T y_x = F + integral of f")
def _out_and_in() -> Checks:
    """A cable paid out and hauled in again hangs where it hung."""
    there = string(100.0, grid__elements=8)
    law = {"law": "cosine", "start_length": 100.0, "amplitude": 4.0, "frequency": 2.0 * np.pi / 600.0}
    found, exact = engine.finished(there.replace({
        "winch": law, "initial": {"shape": "equilibrium"}, "duration": 600.0, "output.interval": 600.0,
        "payload.damping": 2000.0,
    })), equilibrium(there)  # fmt: skip
    y = np.interp(found["sigma"].values, exact.sigma, exact.displacement)
    why = "what 4 cm/s of sliding leave behind"
    yield same_history("y after 600 s, m", found["displacement"].values[-1], y, 1e-3, why)


@CASES.add("string in water, drag in still water", "never above 0", "f_n brakes y_t + zeta' y_x")
def _drag_in_still_water() -> Checks:
    """Drag across brakes what moves through the water, at every node and sample, however the cable slides along.

    ``f_n (y_t + zeta' y_x) <= 0``: f_n of the kernel at states that its run reached, the velocity through the water
    from the run's channels. With Dy/Dt, another velocity where a winch runs, the sign does not hold.
    """
    run = _moved(environment__water__current=None, environment__vessel_motion=from_rest(0.2, 1.1))
    slope, velocity, t = run["slope"].values, run["velocity"].values, run["time"].values
    heaves = HEAVE[0] * HEAVE[1] * np.sin(HEAVE[1] * t)
    through = velocity - (run["payout_speed"].values - heaves)[:, None] * slope
    force = np.array([_drag_across(run.scenario, *sample) for sample in zip(t, slope, velocity, strict=True)])
    driven = max(np.max(force * through), 0.0) / np.abs(force * through).max()
    yield small("largest f_n (y_t + zeta' y_x), over its peak", driven, 1e-12, "round-off")
    share = float(np.mean(force * velocity > 0.0))
    why = "the material velocity is not the one through the water: it must be at least 1e-3"
    yield at_least("share of nodes and samples at which f_n Dy/Dt drives", share, 1e-3, why)


def _drag_across(scenario: Scenario, time: float, slope: np.ndarray, velocity: np.ndarray) -> Any:
    """f_n of the kernel in still water at y_x and Dy/Dt along the cable, N/m, without its part along; same shape."""
    inertia = line_inertia(scenario.cable, scenario.payload, scenario.environment)
    top = top_at(scenario.winch, time, environment=scenario.environment)
    length, sinks = float(top.length), float(top.sink_speed)
    slip = DISPLACED * sinks / inertia
    state = np.ascontiguousarray(np.hstack([to_elements(length * slope), to_elements(velocity - slip * slope)]))
    rate, still = np.zeros_like(state), np.zeros((5, state.shape[1] // 2))
    across = drag.make(scenario)._replace(tangential=0.0)
    plain(drag.add)(across, inertia, state, rate, still, length, sinks, slip)
    return to_nodal(inertia * rate[:, still.shape[1] :])


@CASES.add("string in water, water that does nothing", "a run in air", "(A0) with C_d = C_a = 0 and W = m g")
def _water_that_does_nothing() -> Checks:
    """No drag, no added mass, weights as in air: every number of the run in air, to the last bit."""
    dry = open_loop(
        duration=2.0, grid__elements=8, output__interval=0.01, environment__payload_force=[constant(100.0)],
        winch={"law": "quintic", "start_length": 100.0, "end_length": 104.0, "duration": 2.0},
    )  # fmt: skip
    before, after = engine.finished(dry), engine.finished(dry.replace({
        "environment.water": {}, "payload.water": {}, "cable.wet_line_density": dry.cable.line_density,
        "cable.water": {"diameter": 0.001, "normal_drag": 0.0, "tangential_drag": 0.0, "added_mass": 0.0},
        "payload.wet_weight": dry.payload.mass * dry.environment.gravity,
    }))  # fmt: skip
    for name in map(str, before.data.data_vars):
        apart = float(np.count_nonzero(before[name].values != after[name].values))
        yield small(f"{name}, values that differ", apart, 0.0, "the same arithmetic")


SHEAVE = {"sheave_forward": 10.0, "sheave_up": 8.0}
BOX = {"kind": "box", "length": 93.0, "breadth": 20.0, "draught": 6.6, "block_coefficient": 0.75}
SYSTEM = {"significant_height": 1.0, "peak_period": 8.0, "heading": 2.0, "components": 40}
TMS = BODY | {"displaced_mass": 5400.0}
LINEAR: dict[str, Any] = {
    "cable__water": {"diameter": DIAMETER, "normal_drag": 0.0, "tangential_drag": 0.0},
    "payload__water": TMS | {"quadratic_drag": 0.0, "vertical_drag": 0.0},
}
"""Nothing that goes with the square of a speed."""
CALMED: dict[str, Any] = {"cable__damping": 3.0, "payload__damping": 8000.0, "cable__axial_stiffness": 2.6e7}
"""What makes a run of the work-class umbilical forget its start within two minutes."""
ELASTIC: dict[str, Any] = {"cable__axial_stiffness": 2.6e7}
LIKE = "nothing has changed but words"


def waves_on_ship(system: dict[str, Any] | None = None, **changes: Any) -> dict[str, Any]:
    """A sea with changes of its one system, and of itself."""
    base = {"systems": [SYSTEM | (system or {})], "vessel": BOX | SHEAVE, "plane": 2.0, "orbital_below": 6.6}
    return base | changes


def _in_waves(state: dict[str, Any] | None, **changes: Any) -> Scenario:
    """A string of 100 m in still water under a sea."""
    base = {"environment__vessel_ramp": 5.0, "environment__water__current": None, "environment__sea": state,
            "payload__water": TMS, "grid__elements": 6, "duration": 10.0, "output__interval": 0.2}  # fmt: skip
    return string(100.0, **base | changes)


def _values(name: str, state: dict[str, Any] | None, **changes: Any) -> np.ndarray:
    """A channel of that string."""
    return engine.finished(_in_waves(state, **changes))[name].values


def _displaced(state: dict[str, Any] | None, **changes: Any) -> np.ndarray:
    """Displacement y of that string, m, shape (samples, nodes)."""
    return _values("displacement", state, **changes)


@SEA_CASES.add("sea, string and rope in waves", TWO_RUNS, "small motions of a stiff rope")
def _moved_by_waves() -> Checks:
    """What the orbital motion of a small sea makes of a string, and of a stiff rope."""
    low, stiff = {"significant_height": 1e-3}, {"cable__axial_stiffness": 1e9, "model": "rope", "rope__elements": 6}
    waves, none = waves_on_ship(low), waves_on_ship(low, orbital_below=None)
    one, other = (_displaced(waves, **model) - _displaced(none, **model) for model in ({}, stiff))
    gap = float(abs(one - other).max() / abs(one).max())
    yield small("y that the waves in the water add, share of its largest", gap, 1e-3, "the rope's stretch and heave")


@SEA_CASES.add("sea, waves of later", TWO_RUNS, "no instant is before others")
def _later() -> Checks:
    """The waves of a seed, and the same waves as they are 20 s later, given as numbers: in y and in the tension."""
    heaving = waves_on_ship({"significant_height": 2.5}, seed=5, orbital_below=None, heave=True)
    here, delay = _in_waves(heaving, duration=170.0, **CALMED), 20.0
    waves = sheave(here.environment)
    first, second = engine.finished(here), engine.finished(here.replace({
        "environment.sea": None, "duration": 170.0 - delay,
        "environment.vessel_motion": [*_ahead(waves.along, delay)],
        "environment.vessel_heave": [*_ahead(waves.up, delay)],
    }))  # fmt: skip
    late = second["time"].values > 120.0
    for name in ("tip_displacement", "top_tension"):
        found, exact = second[name].values[late], first[name].values[-late.sum() :]
        yield same_history(name, found, exact, 1e-5, "what two minutes leave of the start")


def _ahead(terms: Any, time: float) -> Iterator[dict[str, Any]]:
    """Regular waves as they are some time later."""
    for told in (term.model_dump(mode="json") for term in terms):
        yield told | {"phases": [p + w * time for p, w in zip(told["phases"], told["frequencies"], strict=True)]}


@SEA_CASES.add("sea, waves twice as high", TWO_RUNS, "linear without drag")
def _twice_as_high() -> Checks:
    """Twice the height doubles y of a string without drag, and the tension that heave adds."""
    still, low, high = ({"significant_height": height} for height in (0.0, 1.0, 2.0))
    once, twice = (_displaced(waves_on_ship(height), **LINEAR) for height in (low, high))
    yield same_history("y, m", twice, 2.0 * once, *ROUND_OFF)
    seas = (waves_on_ship(height, heave=True) for height in (still, low, high))
    zero, one, two = (_values("top_tension", state, **ELASTIC, **LINEAR) for state in seas)
    yield same_history("tension at the sheave, N", two - zero, 2.0 * (one - zero), *ROUND_OFF)


@SEA_CASES.add("sea, twice as many waves", TWO_RUNS, "one spectrum", quick=False)
def _twice_as_many() -> Checks:
    """Twice the components change no statistics."""
    rows = []
    for count in (200, 400):
        state = waves_on_ship({"significant_height": 2.5, "components": count}, heave=True)
        run = engine.finished(_in_waves(
            state, grid__elements=4, grid__step=0.02, control__period=0.02, duration=10800.0, **CALMED))  # fmt: skip
        late = run["time"].values > 200.0
        rows.append([run[name].values[late].std() for name in ("tip_velocity", "top_tension")])
    yield close("rms of Dy/Dt(l) and of the tension at the sheave", rows[1], rows[0], 0.02, "three hours of 8 s")


@SEA_CASES.add("sea, ship without an answer", "a run without a sea", LIKE)
def _no_response() -> Checks:
    """A vessel that answers none of the waves that are there is one that lies still."""
    table = {
        "kind": "rao", "phase": "lag", "axes": "port_up", "waves": "towards", **SHEAVE,
        "heading": np.radians(np.repeat(np.arange(0.0, 181.0, 30.0), 4)).tolist(),
        "frequency": [0.1, 0.2, 0.3, 6.0] * 7, "heave": [1.0, 1.0, 0.0, 0.0] * 7, "heave_phase": [0.0] * 28,
    }  # fmt: skip
    pushed = {"environment__payload_force": [sine(500.0, 0.7)]}
    still = waves_on_ship(vessel=table, orbital_below=None, heave=True)
    found, exact = _displaced(still, **ELASTIC, **pushed), _displaced(None, **pushed)
    yield same_history("y, m", found, exact, 1e-12, "the same arithmetic")
    stirred = _displaced(waves_on_ship(vessel=table), **pushed)
    share = float(abs(stirred - exact).max() / abs(exact).max())
    yield at_least("what waves in the water add, share of y", share, 1e-3, "must be at least 1e-3")


@SEA_CASES.add("sea, headings a full turn apart", TWO_RUNS, LIKE)
def _full_turn() -> Checks:
    """Headings a full turn apart."""
    spread = {"spreading": 4.0, "directions": 3, "components": 20}
    for name, more in {"long-crested": {}, "spread": spread}.items():
        here, there = (_displaced(waves_on_ship({"heading": angle} | more)) for angle in (2.0, 2.0 - 2.0 * np.pi))
        yield same_history(f"y, {name}, m", there, here, *ROUND_OFF)


@SEA_CASES.add("sea, one vessel in two conventions", TWO_RUNS, LIKE)
def _other_conventions() -> Checks:
    """One vessel by tables of two conventions: lag and lead, headings towards and from, axes up and down."""
    ship, conventions = BoxVessel(93.0, 20.0, 6.6, 0.75), [*reference.CONVENTIONS.values()][:2]
    lag, lead = (_displaced(waves_on_ship(vessel=reference.rao_rows(ship, told) | SHEAVE)) for told in conventions)
    yield same_history("y by lead for y by lag, m", lead, lag, 1e-7, "round-off in the tables' ninth digit")
