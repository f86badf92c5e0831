"""What must hold between two motions of the rope, and between the rope and the string.

Another frame or direction, the same products, there and back; and the presets of the string on the rope: what one key
changes, where slopes and stretch are small.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.plant.rope.model import BodyData, CableData, Motion, RopeModel, SteadyCurrent, fixed
from umbilical.scenario.scenario import Scenario
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, at_least, close, same_history, small
from umbilical.verify.invariance import TWO_RUNS, sum_missed
from umbilical.verify.rope import G, quintic_winch, recorded, steady, waving
from umbilical.verify.water_pairs import BOX, waves_on_ship

CASES = Cases()
Turn = Callable[[np.ndarray], np.ndarray]
"""Of vectors, any shape (..., 3)."""
LINE = CableData(2e6, 1.2, 8.0, 0.02, 1.2, 0.02)
BODY = BodyData(300.0, 1500.0, (100.0, 150.0, 200.0), (20.0, 30.0, 0.0), (200.0, 250.0, 300.0), 150.0)
SHEAR = np.array([(0.6, 0.1, 0.0), (0.3, -0.2, 0.0), (0.1, 0.1, 0.0)])
FORCE = np.array([100.0, -150.0, 50.0])
SWAYS = {0: (0.5, 0.7), 1: (0.8, 0.5), 2: (0.4, 0.9)}
ROUND_OFF = (1e-8, "round-off")
"""Share of the peak by which another order of sums may move a swing of 10 s."""


def _quarter_turn(vectors: np.ndarray) -> np.ndarray:
    """By 90 degrees about z."""
    return np.stack([-vectors[..., 1], vectors[..., 0], vectors[..., 2]], axis=-1)


def _mirrored(vectors: np.ndarray) -> np.ndarray:
    """In a mirror across y."""
    return vectors * np.array([1.0, -1.0, 1.0])


def _flow(velocities: np.ndarray) -> SteadyCurrent:
    """At three heights."""
    return SteadyCurrent((0.0, -60.0, -400.0), tuple(map(tuple, velocities.tolist())))


def _swinging(turn: Turn = lambda vectors: vectors, carried: float = 0.0, cable: CableData = LINE) -> np.ndarray:
    """Place of the cable at 11 instants, m, shape (11, nodes, 3): paid out in a sheared current by a vessel that moves.

    Args:
        turn: of every vector; the body's sizes stand where the axes are then.
        carried: velocity that vessel, water and cable have besides, in the direction x, m/s.
        cable: what is paid out.
    """
    sways, drift = waving(SWAYS, 2.0), np.array([carried, 0.0, 0.0])

    def vessel(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        place, speed = sways(t)
        return turn(place + np.multiply.outer(t, drift)), turn(speed + drift)

    sizes: Any = {name: np.abs(turn(np.array(getattr(BODY, name)))) for name in ("added_mass", "damping", "drag")}
    body, winch = replace(BODY, **sizes), quintic_winch(200.0, 215.0, 10.0)
    force: Any = turn(FORCE)
    start = Motion(winch, None if carried else sways)
    model = RopeModel(cable, body, start, _flow(turn(SHEAR)), elements=4, force=force)
    if carried:
        flow = _flow(turn(SHEAR + drift))
        model.water = RopeModel(cable, body, fixed(200.0), flow, elements=4, settled=False).water
        model.state.now[:, 12:24] += np.repeat(turn(drift), 4)
        model.state.body[0] += turn(drift)
    model.motion = Motion(winch, vessel)
    return np.array([model.position, *recorded(model, 1.0, 10, lambda: model.position)])


@CASES.add("rope, turned, mirrored and carried along", TWO_RUNS, "isotropy; Galilei")
def _frames() -> Checks:
    """Everything turned, mirrored, or carried along by the water: the motion is, too."""
    here, t = _swinging(), np.arange(11.0)[:, None, None]
    yield same_history("turned by 90 degrees: place, m", _swinging(_quarter_turn), _quarter_turn(here), *ROUND_OFF)
    yield same_history("in a mirror: place, m", _swinging(_mirrored), _mirrored(here), *ROUND_OFF)
    along = _swinging(carried=0.8) - t * np.array([0.8, 0.0, 0.0])
    yield same_history("carried along at 0.8 m/s: place, m", along, here, *ROUND_OFF)


@CASES.add("rope, diameter for coefficients", TWO_RUNS, "only C d and C d^2 count")
def _same_product() -> Checks:
    """Twice the diameter at half the drag and a quarter of the added mass, in water that does not accelerate."""
    thick = replace(LINE, diameter=0.04, normal_drag=0.6, tangential_drag=0.01, added_mass=0.25)
    yield same_history("place, m", _swinging(cable=thick), _swinging(), *ROUND_OFF)


@CASES.add("rope, superposition", "sum of two responses", "linear without drag")
def _superposed() -> Checks:
    """Small motions in water are linear with its added mass, and not with its drag."""

    def missed(normal: float, quadratic: float) -> float:
        cable, body = CableData(2e7, 1.2, 8.0, 0.02, normal, 0.0), BodyData(300.0, 1500.0, 100.0, drag=quadratic)

        def respond(force: float, sway: float) -> np.ndarray:
            model, rows = RopeModel(cable, body, Motion(steady(200.0), waving({0: (sway, 0.7)}, 2.0)), elements=4), []
            for k in range(40):
                model.step(0.25, force=(force * np.sin(0.175 * k), 0.0, 0.0))
                rows.append(model.position[:, 0])
            return np.array(rows)

        return sum_missed(respond, 5.0, 0.2)

    what = "x of a sum less the sum of x, no drag, over its peak"
    yield small(what, missed(0.0, 0.0), 1e-4, "slopes of 1e-2, squared")
    why = "|u_n| u_n is not linear: it must be at least 1e-2"
    yield at_least("the same with drag", missed(1.2, 300.0), 1e-2, why)


@CASES.add("rope, out and in", TWO_RUNS, "the shape at rest")
def _out_and_in() -> Checks:
    """A cable paid out and hauled in again hangs where it hung."""
    omega, force = 2.0 * np.pi / 1200.0, tuple(FORCE.tolist())
    law = Motion(lambda t: (204.0 - 4.0 * np.cos(omega * t), 4.0 * omega * np.sin(omega * t)))
    model = RopeModel(LINE, BODY, law, _flow(SHEAR), elements=4, force=force)
    before = model.position
    out, back = np.abs(recorded(model, 600.0, 2, lambda: model.position) - before).max(axis=(1, 2))
    yield small("place after 20 min, off over how far it was away", back / out, 1e-3, "what 2 cm/s of sliding leave")


@CASES.add("rope, drag in still water", "never above 0", "f.W <= 0")
def _drag_in_still_water() -> Checks:
    """Drag only takes energy in still water, however the cable slides along itself."""
    motion = Motion(quintic_winch(200.0, 212.0, 20.0), waving(SWAYS, 2.0))
    model = RopeModel(LINE, BODY, motion, elements=4, booked=True)
    drags = ("work_drag", "work_body_drag")
    taken = np.diff(recorded(model, 0.05, 400, lambda: [model.works[name] for name in drags]), axis=0, prepend=0.0)
    yield small("largest work of drag in 50 ms, over its peak", max(taken.max(), 0.0) / -taken.min(), 0.0, "f.W <= 0")


@CASES.add("rope, frequencies by added mass", "sqrt(rho/(rho + rho_a))", "closed form")
def _slowed() -> Checks:
    """Added mass slows the vibration of a cable whose body is held, and leaves it what it was along itself."""

    def modes(added: float) -> np.ndarray:
        line = CableData(2e7, 1.2, 1.2 * G, 0.02, 0.0, 0.0, added)
        return np.imag(RopeModel(line, BodyData(1e9, 5e3), fixed(200.0), elements=4).modes())

    free, wet = (found[found > 0.1][:4] for found in map(modes, (0.0, 1.0)))
    exact = free * np.sqrt(1.2 / (1.2 + 1025.0 * np.pi * 1e-4))
    yield close("frequencies across, rad/s", wet, exact, 1e-5, "sqrt(rho/(rho + rho_a))")


PRESETS = {
    "crosscheck": [f"crosscheck-{law}" for law in ("none", "no-observer", "pd", "proposed")],
    "paper": ["paper", "paper-none", "paper-pd", "paper-adaptive", "haul-in", "ringdown"],
    "faults": [f"paper-{fault}{law}" for fault in ("dead", "partial", "stuck") for law in ("", "-adaptive")],
    "current": ["work-class-1000m-current"],
}
"""Every preset of the string."""
SHARES = {"crosscheck-none": 0.1, "crosscheck-pd": 0.1, "paper-none": 0.1, "paper-pd": 0.1, "ringdown": 0.01}
"""The share of load and of shape at the start that is taken, if not all: slopes of 0.05 at full size leave second
orders of some 1e-3, of which a tenth is left of the tenth."""
SEAWAY: dict[str, Any] = {
    "duration": 60.0, "environment.vessel_ramp": 20.0, "control.law": {"kind": "none"},
    "environment.sea": waves_on_ship({"significant_height": 0.5}, vessel=BOX | {"sheave_forward": 10.0}, heave=True),
    "environment.water.current": {"depths": [0.0, 1100.0], "speeds": [0.5, 0.06],
                                  "variation": [engine.sine(0.2, 0.3)]},
}  # fmt: skip
"""Waves that move vessel and water, heave in the tension, a current that varies; a law would know the tension of the
rope, and not that of a string that heaves."""


SIZES = {"value", "amplitude"}


def _smaller(scenario: Scenario, share: float) -> dict[str, Any]:
    """What makes a scenario's force on the ROV and its shape at the start a share of what they are."""
    told = scenario.to_dict()
    terms = enumerate(told["environment"]["payload_force"], start=1)
    parts = {f"environment.payload_force.{number}": term for number, term in terms} | {"initial": told["initial"]}
    return {f"{key}.{name}": share * term[name] for key, term in parts.items() for name in term.keys() & SIZES}


def _beside(name: str, scenario: Scenario, why: str) -> Checks:
    """Displacement of tip and midpoint on string and rope: rms of the difference over the rms of the string's.

    On grids of 16 elements of both, so that both round off the fronts of a jump alike; 64 have the same differences.
    """
    grids = {"grid.elements": 16, "rope.elements": 16}
    runs = [engine.finished(scenario.replace({**grids, "model": model})) for model in ("string", "rope")]
    for place, sigma in (("tip", 1.0), ("midpoint", 0.5)):
        y, other = (run["displacement"].sel(sigma=sigma, method="nearest").values for run in runs)
        off = float(np.sqrt(((y - other) ** 2).mean() / (y**2).mean()))
        yield small(f"{name}, {place}: rms of the difference over that of y", off, 1e-3, why)


@CASES.add("rope beside the string, {}", TWO_RUNS, "small motions", tuple(PRESETS), quick=False)
def _presets(group: str) -> Checks:
    """One family of presets."""
    for name in PRESETS[group]:
        scenario, share = load(name), SHARES.get(name, 1.0)
        why = "stretch of 1e-4, second orders of the slope" + (f" at {share:g} of the load" if share < 1.0 else "")
        yield from _beside(name, scenario.replace(_smaller(scenario, share)), why)


@CASES.add("rope beside the string, waves and current", TWO_RUNS, "small motions", quick=False)
def _seaway() -> Checks:
    """A free ROV on 1000 m in waves and in a sheared current that varies."""
    scenario = load("work-class-1000m-current", SEAWAY)
    return _beside("waves and a varying current", scenario, "stretch of 1e-4, second orders of the slope")
