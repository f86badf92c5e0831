"""What must hold between two runs of ours, whatever the answer is: no reference is needed, and no grid forgives it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.run import Run
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, channels_close, close, each, history_close
from umbilical.verify.engine import constant, dotted, open_loop, sine

ROUND_OFF = 1e-9
WHY = "round-off of some thousand steps"
INPUTS: list[dict[str, Any]] = [
    {"payload_force": [constant(100.0)]},
    {"cable_load": [{"profile": {"shape": "gaussian", "center": 0.3, "width": 0.2}, "signal": [sine(3.0, 2.0)]}]},
    {"vessel_motion": [sine(0.5, 1.3)]},
]
DEAD = [{"kind": "dead", "motor": motor, "start": 0.0} for motor in (1, 2)]
WAYS = {"paying out": (100.0, 110.0), "hauling in": (110.0, 100.0)}


def small(preset: str, **overrides: Any) -> Any:
    """A preset on 4 elements for 0.1 s, small enough to run without the compiler."""
    return load(preset, {"grid.elements": 4, "duration": 0.1, "output.interval": 0.01} | dotted(overrides))


def response(lengths: tuple[float, float], start: float, inputs: list[dict[str, Any]]) -> Run:
    """Five seconds of open loop with a moving winch, from a shape of ``start`` m, under some of the inputs."""
    environment = {f"environment.{name}": value for part in inputs for name, value in part.items()}
    scenario = open_loop(
        winch={"law": "quintic", "start_length": lengths[0], "end_length": lengths[1], "duration": 5.0},
        initial={"shape": "sine", "amplitude": start, "half_waves": 1.5}, duration=5.0, grid__elements=8,
        cable__damping=0.05, payload__damping=5.0,
        environment__vessel_ramp=2.0,  # in every part: forces are evaluated anew where it ends
    )  # fmt: skip
    return engine.completed(scenario.replace(environment))


def _superposed(lengths: tuple[float, float]) -> Iterator[Check]:
    """The response to a sum is the sum of the responses."""
    parts = [response(lengths, 0.7, []), *(response(lengths, 0.0, [part]) for part in INPUTS)]
    whole = response(lengths, 0.7, INPUTS)
    for name, unit in (("displacement", "m"), ("velocity", "m/s"), ("tip_slope", "1")):
        total = np.sum([part[name].values for part in parts], axis=0)
        yield history_close(f"{name.replace('_', ' ')}, {unit}", whole[name].values, total, ROUND_OFF, WHY)


def mirrored(sign: float, preset: str) -> Run:
    """Every sideways input times ``sign``: loads, start, vessel, the motors' disturbances, stuck values."""
    sideways: dict[str, Any] = {
        "environment.payload_force": [constant(100.0 * sign), sine(50.0 * sign, 0.7)],
        "environment.cable_load": [{"profile": {"shape": "sine", "half_waves": 3}, "signal": [sine(2.0 * sign, 9.0)]}],
        "environment.vessel_motion": [sine(0.3 * sign, 2.0)],
        "environment.vessel_ramp": 0.05,
        "initial": {"shape": "sine", "amplitude": 0.4 * sign, "half_waves": 1.5},
    }
    scenario = small(preset)
    for motor in range(1, len(scenario.motors) + 1):
        sideways[f"motors.{motor}.torque_disturbance"] = [sine(sign, 20.0)]
        sideways[f"motors.{motor}.voltage_disturbance"] = [sine(0.2 * sign, 20.0)]
        sideways["faults"] = [{"kind": "stuck", "motor": motor, "start": 0.05, "value": 100.0 * sign}]
    return engine.completed(scenario.replace(sideways))


def _mirror_image() -> Iterator[Check]:
    """y -> -y, motors, adaptation and a fault included."""
    right, left = mirrored(1.0, "paper-adaptive"), mirrored(-1.0, "paper-adaptive")
    yield from channels_close(left, right, {"displacement": "m", "motor_voltage": "V"}, ROUND_OFF, WHY, factor=-1.0)


def pulsed(begin: float, **overrides: Any) -> np.ndarray:
    """y(l,t), m, from half a second's push of 100 N on."""
    pulse = [{"kind": "pulse", "value": 100.0, "start": begin, "end": begin + 0.5}]
    common = {"duration": 6.0, "grid__elements": 8, "output__interval": 0.01, "environment__payload_force": pulse}
    run = engine.completed(open_loop(**common | overrides))
    return run["tip_displacement"].values[run["time"].values >= begin - 1e-9]


def _shifted() -> Iterator[Check]:
    """A later push gives the same response later."""
    early, late = pulsed(1.0), pulsed(3.0)
    yield history_close("y(l,t), m", early[: late.size], late, ROUND_OFF, WHY)


def hung(length: float, time: float, force: float) -> Run:
    """The same cable in units of ``length`` m, ``time`` s and ``force`` N; g = 10 m/s2 in each."""
    mass = force * time**2 / length
    return engine.completed(open_loop(
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


def _in_other_units() -> Iterator[Check]:
    """In units of 3 m, 1.7 s and 0.3 N the same numbers."""
    one, other = hung(1.0, 1.0, 1.0), hung(3.0, 1.7, 0.3)
    for name, unit in (("displacement", 3.0), ("velocity", 3.0 / 1.7), ("energy", 0.9)):
        yield history_close(name, other[name].values / unit, one[name].values, ROUND_OFF, WHY)


def _all_dead() -> Iterator[Check]:
    """Whatever the controller tries."""
    dead, free = engine.completed(small("paper", faults=DEAD)), engine.completed(small("paper-none"))
    yield from channels_close(dead, free, {"displacement": "m"}, 1e-15, "no thrust")


def _weightless() -> Iterator[Check]:
    """T = m g + w (l - x): the distance to the cable of constant tension falls with the weight w in water."""

    def along(wet: float) -> np.ndarray:
        start = {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5}
        scenario = open_loop(duration=20.0, cable__wet_line_density=wet, grid__elements=8, initial=start)
        return engine.completed(scenario)["displacement"].values

    limit = along(0.0)
    far, near = (float(np.abs(along(wet) - limit).max()) for wet in (1e-2, 1e-4))
    yield close("distance at 1e-2 kg/m over that at 1e-4 kg/m", far / near, 100.0, 0.05, "the square of 1e-2 l/m")


def _refined() -> Iterator[Check]:
    """The paper's scenario at the default grid, and with twice the elements and half the step."""
    default = engine.completed(load("paper"))
    fine = engine.completed(load("paper", {"grid.elements": 128, "grid.step": 5e-4}))
    why = "the load starts with a jump, and the front of the wave it sends wants the finer grid"
    yield from channels_close(default, fine, {"tip_displacement": "m", "thrust": "N"}, 5e-3, why)
    for name in ("mid_peak", "mid_rms"):
        yield close(f"{name.replace('_', ' ')}, m", default.metrics[name], fine.metrics[name], 5e-3, why)


TWO_RUNS = "another run of ours"
CASES = (
    *each("superposition, {}", "sum of four responses", "the open loop is linear", _superposed, WAYS),
    Case("mirror image", TWO_RUNS, "(6)-(64) are odd in y", _mirror_image),
    Case("shift in time", TWO_RUNS, "(6)-(8) with l fixed", _shifted),
    Case("other units", TWO_RUNS, "dimensional analysis", _in_other_units),
    Case("all motors dead", "a run without control", "(16) with rho_i = u_k = 0", _all_dead),
    Case("w -> 0 in T", "a run at constant tension", "T = m g + w (l - x)", _weightless),
    Case("refinement", "a run on a grid twice as fine", "convergence", _refined),
)
