"""What must hold between two runs of ours, whatever the answer is: no reference is needed, and no grid forgives it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.run import Run
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, close, same_channels, same_history
from umbilical.verify.engine import constant, dotted, open_loop, sine

CASES = Cases()
ROUND_OFF = (1e-9, "round-off of some thousand steps")
TWO_RUNS = "another run of ours"
INPUTS: list[dict[str, Any]] = [
    {"payload_force": [constant(100.0)]},
    {"cable_load": [{"profile": {"shape": "gaussian", "center": 0.3, "width": 0.2}, "signal": [sine(3.0, 2.0)]}]},
    {"vessel_motion": [sine(0.5, 1.3)]},
]
DEAD = [{"kind": "dead", "motor": motor, "start": 0.0} for motor in (1, 2)]
BENT = {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5}


def small(preset: str, **overrides: Any) -> Any:
    """A preset on 4 elements for 0.1 s, small enough to run without the compiler."""
    return load(preset, {"grid.elements": 4, "duration": 0.1, "output.interval": 0.01} | dotted(overrides))


def response(lengths: tuple[float, float], start: float, inputs: list[dict[str, Any]]) -> Run:
    """Five seconds of open loop with a moving winch, from a shape of ``start`` m, under some of the inputs."""
    environment = {f"environment.{name}": value for part in inputs for name, value in part.items()}
    scenario = open_loop(
        winch={"law": "quintic", "start_length": lengths[0], "end_length": lengths[1], "duration": 5.0},
        initial=BENT | {"amplitude": start}, duration=5.0, grid__elements=8,
        cable__damping=0.05, payload__damping=5.0,
        environment__vessel_ramp=2.0,  # in every part: forces are evaluated anew where it ends
    )  # fmt: skip
    return engine.finished(scenario.replace(environment))


@CASES.add("superposition, {}", "sum of four responses", "the open loop is linear",
           {"paying out": (100.0, 110.0), "hauling in": (110.0, 100.0)})  # fmt: skip
def _superposed(lengths: tuple[float, float]) -> Checks:
    """The response to a sum is the sum of the responses."""
    parts = [response(lengths, 0.7, []), *(response(lengths, 0.0, [part]) for part in INPUTS)]
    units = {"displacement": "m", "velocity": "m/s", "tip_slope": "1"}
    total = {name: sum(part[name] for part in parts) for name in units}
    yield from same_channels(response(lengths, 0.7, INPUTS), total, units, *ROUND_OFF)


def sum_missed(respond: Callable[[float, float], np.ndarray], one: float, other: float) -> float:
    """How far the response to two inputs is from the sum of the responses, over its peak."""
    whole, parts = respond(one, other), respond(one, 0.0) + respond(0.0, other)
    return float(np.abs(whole - parts).max() / np.abs(parts).max())


def mirrored(sign: float, preset: str) -> Run:
    """Every sideways input times ``sign``: loads, start, vessel, the motors' disturbances, stuck values."""
    scenario = small(preset)
    sideways: dict[str, Any] = {
        "environment.payload_force": [constant(100.0 * sign), sine(50.0 * sign, 0.7)],
        "environment.cable_load": [{"profile": {"shape": "sine", "half_waves": 3}, "signal": [sine(2.0 * sign, 9.0)]}],
        "environment.vessel_motion": [sine(0.3 * sign, 2.0)], "environment.vessel_ramp": 0.05,
        "initial": BENT | {"amplitude": 0.4 * sign},
    }  # fmt: skip
    for motor in range(1, len(scenario.motors) + 1):
        sideways[f"motors.{motor}.torque_disturbance"] = [sine(sign, 20.0)]
        sideways[f"motors.{motor}.voltage_disturbance"] = [sine(0.2 * sign, 20.0)]
        sideways["faults"] = [{"kind": "stuck", "motor": motor, "start": 0.05, "value": 100.0 * sign}]
    return engine.finished(scenario.replace(sideways))


@CASES.add("mirror image", TWO_RUNS, "(6)-(64) are odd in y")
def _mirror_image() -> Checks:
    """y -> -y, motors, adaptation and a fault included."""
    right, left = (mirrored(sign, "paper-adaptive") for sign in (1.0, -1.0))
    return same_channels(left, right, {"displacement": "m", "motor_voltage": "V"}, *ROUND_OFF, factor=-1.0)


def pulsed(begin: float, **overrides: Any) -> np.ndarray:
    """y(l,t), m, from half a second's push of 100 N on."""
    pulse = [{"kind": "pulse", "value": 100.0, "start": begin, "end": begin + 0.5}]
    common = {"duration": 6.0, "grid__elements": 8, "output__interval": 0.01, "environment__payload_force": pulse}
    run = engine.finished(open_loop(**common | overrides))
    return run["tip_displacement"].values[run["time"].values >= begin - 1e-9]


@CASES.add("shift in time", TWO_RUNS, "(6)-(8) with l fixed")
def _shifted() -> Checks:
    """A later push gives the same response later."""
    early, late = pulsed(1.0), pulsed(3.0)
    yield same_history("y(l,t), m", early[: late.size], late, *ROUND_OFF)


def hung(length: float, time: float, force: float) -> Run:
    """The same cable in units of ``length`` m, ``time`` s and ``force`` N; g = 10 m/s2 in each."""
    mass = force * time**2 / length
    return engine.finished(open_loop(
        environment__gravity=10.0 * length / time**2,
        cable={"line_density": 2.0 * mass / length, "damping": 0.1 * mass / length / time},
        payload={"mass": 100.0 * mass, "damping": 5.0 * mass / time},
        winch={"law": "quintic", "start_length": 80.0 * length, "end_length": 90.0 * length, "duration": 4.0 * time},
        initial={"shape": "sine", "amplitude": 0.5 * length},
        environment__payload_force=[constant(50.0 * force), sine(20.0 * force, 2.0 / time)],
        environment__cable_load=[{"profile": {"shape": "uniform"}, "signal": [sine(force / length, 1.0 / time)]}],
        duration=4.0 * time, control__period=1e-3 * time, grid={"elements": 8, "step": 1e-3 * time},
        output__interval=0.1 * time,
    ))  # fmt: skip


@CASES.add("other units", TWO_RUNS, "dimensional analysis")
def _in_other_units() -> Checks:
    """In units of 3 m, 1.7 s and 0.3 N the same numbers."""
    one, other = hung(1.0, 1.0, 1.0), hung(3.0, 1.7, 0.3)
    for name, unit in (("displacement", 3.0), ("velocity", 3.0 / 1.7), ("energy", 0.9)):
        yield same_history(name, other[name].values / unit, one[name].values, *ROUND_OFF)


@CASES.add("all motors dead", "a run without control", "(16) with rho_i = u_k = 0")
def _all_dead() -> Checks:
    """Whatever the controller tries."""
    dead, free = engine.finished(small("paper", faults=DEAD)), engine.finished(small("paper-none"))
    return same_channels(dead, free, {"displacement": "m"}, 1e-15, "no thrust")


@CASES.add("w -> 0 in T", "a run at constant tension", "T = m g + w (l - x)")
def _weightless() -> Checks:
    """T = m g + w (l - x): the distance to the cable of constant tension falls with the weight w in water."""
    limit, *near = (
        engine.finished(open_loop(duration=20.0, cable__wet_line_density=wet, grid__elements=8, initial=BENT))
        ["displacement"].values for wet in (0.0, 1e-2, 1e-4)
    )  # fmt: skip
    far, near = (float(np.abs(y - limit).max()) for y in near)
    yield close("distance at 1e-2 kg/m over that at 1e-4 kg/m", far / near, 100.0, 0.05, "the square of 1e-2 l/m")


@CASES.add("refinement", "a run on a grid twice as fine", "convergence")
def _refined() -> Checks:
    """The paper's scenario at the default grid, and with twice the elements and half the step."""
    default, fine = (engine.finished(load("paper", grid)) for grid in ({}, {"grid.elements": 128, "grid.step": 5e-4}))
    why = "the load starts with a jump, and the front of the wave it sends wants the finer grid"
    yield from same_channels(default, fine, {"tip_displacement": "m", "thrust": "N"}, 5e-3, why)
    for name in ("mid_peak", "mid_rms"):
        yield close(f"{name.replace('_', ' ')}, m", default.metrics[name], fine.metrics[name], 5e-3, why)
