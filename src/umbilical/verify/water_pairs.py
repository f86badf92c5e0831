"""What must hold between two runs of the string in water, and what must not: drag adds no responses up."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from umbilical.compile import plain
from umbilical.plant.equilibrium import equilibrium
from umbilical.plant.forces import drag
from umbilical.plant.layout import to_elements, to_nodal
from umbilical.plant.top import top_at
from umbilical.relations.water import line_inertia
from umbilical.run import Run
from umbilical.scenario.scenario import Scenario
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, at_least, history_close, small
from umbilical.verify.engine import constant, open_loop, sine
from umbilical.verify.invariance import ROUND_OFF, TWO_RUNS, WHY
from umbilical.verify.water import DISPLACED, LINE, MASS, SEA, string

SLIDES = {"law": "quintic", "start_length": 100.0, "end_length": 108.0, "duration": 10.0}
UNIFORM = {"depths": [0.0, 200.0], "speeds": [0.5, 0.5]}
CARRIED, TURNING = 0.3, 0.5
"""Size, m, and frequency, rad/s, of the frame ``s = a (1 - cos w t)^2``, which sets off gently."""
BODY_DISPLACED = 5000.0
SET_OFF = np.pi / 2.0
"""Phase of a sine that starts at rest."""


def _moved(**changes: Any) -> Run:
    """Ten seconds of that string with winch and heave at work, from a bent start."""
    base: dict[str, Any] = {
        "winch": SLIDES, "environment__vessel_heave": [constant(0.3), sine(-0.3, 0.8, np.pi / 2.0)],
        "initial": {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5},
        "grid__elements": 8, "duration": 10.0, "output__interval": 0.1,
    }  # fmt: skip
    return engine.completed(string(100.0, **base | changes))


def _moving_frame() -> Iterator[Check]:
    """Vessel, water and ROV carried along by s(t): y + s, where d'Alembert's force acts on what the water leaves.

    Added mass and Froude-Krylov force carry the water's share, so that is the mass less the displaced one.
    """
    a, w, quarter, speed = CARRIED, TURNING, np.pi / 2.0, 0.5
    frame = [constant(1.5 * a), sine(-2.0 * a, w, quarter), sine(0.5 * a, 2.0 * w, quarter)]
    rate = 2.0 * a * w / speed

    def pushed(mass: float) -> list[dict[str, Any]]:
        force = mass * (2.0 * a * w * w)
        return [sine(force, w, quarter), sine(-force, 2.0 * w, quarter)]

    body = SEA["payload.water"] | {"displaced_mass": BODY_DISPLACED}
    still = _moved(environment__water__current=UNIFORM, payload__water=body)
    carried = _moved(
        payload__water=body, environment__vessel_motion=frame,
        environment__water__current=UNIFORM | {"variation": [sine(rate, w), sine(-0.5 * rate, 2.0 * w)]},
        environment__payload_force=pushed(MASS - BODY_DISPLACED),
        environment__cable_load=[{"profile": {"shape": "uniform"}, "signal": pushed(LINE - DISPLACED)}],
    )  # fmt: skip
    t = still["time"].values[:, None]
    drift = a * (1.0 - np.cos(w * t)) ** 2
    faster = 2.0 * a * w * np.sin(w * t) * (1.0 - np.cos(w * t))
    why = "third order in the step of 1 ms, of a slow motion"
    for shown, name, added in (("y + s, m", "displacement", drift), ("Dy/Dt + s', m/s", "velocity", faster)):
        yield history_close(shown, carried[name].values, still[name].values + added, ROUND_OFF, why)


def _mirror_image() -> Iterator[Check]:
    """y -> -y, the current from the other side."""
    right, left = (
        _moved(
            environment__water__current={"depths": [0.0, 200.0], "speeds": [0.5 * sign, 0.1 * sign]},
            environment__vessel_motion=[constant(0.2 * sign), sine(-0.2 * sign, 1.1, SET_OFF)],
            environment__payload_force=[sine(500.0 * sign, 0.7)],
            initial={"shape": "sine", "amplitude": sign, "half_waves": 1.5},
        )["displacement"].values
        for sign in (1.0, -1.0)
    )
    yield history_close("y, m", left, -right, ROUND_OFF, WHY)


def _same_product() -> Iterator[Check]:
    """Twice the diameter at half the drag and a quarter of the added mass."""
    thin = _moved(cable__water={"diameter": 0.03, "normal_drag": 1.2, "tangential_drag": 0.02, "added_mass": 1.0})
    thick = _moved(cable__water={"diameter": 0.06, "normal_drag": 0.6, "tangential_drag": 0.01, "added_mass": 0.25},
                  cable__line_density=LINE)  # fmt: skip
    yield history_close("y, m", thick["displacement"].values, thin["displacement"].values, ROUND_OFF, WHY)


def _summed(normal: float, quadratic: float) -> float:
    """How far the response to two inputs is from the sum of the responses, over its peak; no current."""

    def respond(force: float, start: float) -> np.ndarray:
        return _moved(
            environment__water__current=None,
            cable__water={"diameter": 0.04, "normal_drag": normal, "tangential_drag": 0.01},
            payload__water=SEA["payload.water"] | {"quadratic_drag": quadratic},
            environment__payload_force=[sine(force, 0.7)],
            initial={"shape": "sine", "amplitude": start, "half_waves": 1.5},
        )["displacement"].values

    whole, parts = respond(2e3, 1.0), respond(2e3, 0.0) + respond(0.0, 1.0)
    return float(np.abs(whole - parts).max() / np.abs(parts).max())


def _superposed() -> Iterator[Check]:
    """Added mass is linear, and so is the lateral part of the drag along the cable; drag across is not."""
    without, dragged = _summed(0.0, 0.0), _summed(1.2, 3000.0)
    yield small("y of a sum less the sum of y, no drag across", without, ROUND_OFF, WHY)
    yield at_least("the same with drag", dragged, 1e-2, "|u_r| u_r is not linear: it must be at least 1e-2")


def _out_and_in() -> Iterator[Check]:
    """A cable paid out and hauled in again hangs where it hung."""
    there = string(100.0, grid__elements=8)
    law = {"law": "cosine", "start_length": 100.0, "amplitude": 4.0, "frequency": 2.0 * np.pi / 600.0}
    end = there.replace({
        "winch": law, "initial": {"shape": "equilibrium"}, "duration": 600.0, "output.interval": 600.0,
        "payload.damping": 2000.0,
    })  # fmt: skip
    found, exact = engine.completed(end), equilibrium(there)
    y = np.interp(found["sigma"].values, exact.sigma, exact.displacement)
    why = "what 4 cm/s of sliding leave behind"
    yield history_close("y after 600 s, m", found["displacement"].values[-1], y, 1e-3, why)


def _drag_in_still_water() -> Iterator[Check]:
    """Drag across brakes what moves through the water, at every node and sample, however the cable slides along.

    ``f_n (y_t + zeta' y_x) <= 0``: f_n of the kernel at states that its run reached, the velocity through the water
    from the run's channels. With Dy/Dt, another velocity where a winch runs, the sign does not hold.
    """
    run = _moved(environment__water__current=None, environment__vessel_motion=[constant(0.2), sine(-0.2, 1.1, SET_OFF)])
    slope, velocity, t = run["slope"].values, run["velocity"].values, run["time"].values
    heaves = 0.3 * 0.8 * np.sin(0.8 * t)
    through = velocity - (run["payout_speed"].values - heaves)[:, None] * slope
    force = np.array([_drag_across(run.scenario, *sample) for sample in zip(t, slope, velocity, strict=True)])
    peak = np.abs(force * through).max()
    why = "round-off"
    yield small("largest f_n (y_t + zeta' y_x), over its peak", max(np.max(force * through), 0.0) / peak, 1e-12, why)
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


def _water_that_does_nothing() -> Iterator[Check]:
    """No drag, no added mass, weights as in air: every number of the run in air, to the last bit."""
    dry = open_loop(
        duration=2.0, grid__elements=8, output__interval=0.01, environment__payload_force=[constant(100.0)],
        winch={"law": "quintic", "start_length": 100.0, "end_length": 104.0, "duration": 2.0},
    )  # fmt: skip
    nothing = {"diameter": 0.001, "normal_drag": 0.0, "tangential_drag": 0.0, "added_mass": 0.0}
    wet = dry.replace({
        "environment.water": {}, "cable.water": nothing, "payload.water": {},
        "cable.wet_line_density": dry.cable.line_density,
        "payload.wet_weight": dry.payload.mass * dry.environment.gravity,
    })  # fmt: skip
    before, after = engine.completed(dry), engine.completed(wet)
    for name in map(str, before.data.data_vars):
        apart = float(np.count_nonzero(before[name].values != after[name].values))
        yield small(f"{name}, values that differ", apart, 0.0, "the same arithmetic")


CASES = (
    Case("string in water, moving frame", TWO_RUNS, "Galilei and d'Alembert", _moving_frame),
    Case("string in water, mirror image", TWO_RUNS, "(A0) is odd in y and u", _mirror_image),
    Case("string in water, diameter for coefficients", TWO_RUNS, "only C d and C d^2 count", _same_product),
    Case("string in water, superposition", "sum of two responses", "linear without drag across", _superposed),
    Case("string in water, out and in", "statics", "T y_x = F + integral of f", _out_and_in),
    Case("string in water, drag in still water", "never above 0", "f_n brakes y_t + zeta' y_x", _drag_in_still_water),
    Case("string in water, water that does nothing", "a run in air", "(A0) with C_d = C_a = 0 and W = m g",
         _water_that_does_nothing),
)  # fmt: skip
