"""Random scenarios: what winches, loads and vessels do, within and outside of what is admitted."""

from __future__ import annotations

from typing import Any

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from tests.support.scenarios import constant, sine

few = settings(
    max_examples=12, deadline=None, derandomize=True, database=None, suppress_health_check=[HealthCheck.too_slow]
)


def between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_subnormal=False)


waves = st.builds(sine, between(-1.0, 1.0), between(0.2, 3.0), between(-3.0, 3.0))
quintic = st.builds(
    lambda start, way: {"law": "quintic", "start_length": start, "end_length": start + way, "duration": 5.0},
    between(90.0, 150.0),
    between(-12.0, 12.0),
)
steady = st.builds(
    lambda start, v: {"law": "speed", "start_length": start, "speed": v}, between(90.0, 150.0), between(-4.0, 4.0)
)
to_and_fro = st.builds(
    lambda start, amplitude, w: {"law": "cosine", "start_length": start, "amplitude": amplitude, "frequency": w},
    between(90.0, 150.0),
    between(-3.0, 3.0),
    between(0.2, 1.0),
)
winches = st.one_of(quintic, steady, to_and_fro)


def _sideways(force: dict[str, Any], load: dict[str, Any], vessel: dict[str, Any], shape: float) -> dict[str, Any]:
    return {
        "environment.payload_force": [force | {"amplitude": 100.0 * force["amplitude"]}],
        "environment.cable_load": [{"profile": {"shape": "sine", "half_waves": 2}, "signal": [load]}],
        "environment.vessel_motion": [vessel | {"amplitude": 0.3 * vessel["amplitude"]}],
        "environment.vessel_ramp": 1.0,
        "initial": {"shape": "sine", "amplitude": shape, "half_waves": 1.5},
    }


inputs = st.builds(_sideways, waves, waves, waves, between(-1.0, 1.0))
"""Everything that moves the cable sideways."""
cables = st.fixed_dictionaries({
    "payload.mass": between(50.0, 1000.0), "payload.damping": between(0.0, 50.0), "cable.damping": between(0.0, 0.2),
})  # fmt: skip


trapezoid = st.builds(
    lambda way, speed: {
        "law": "trapezoid", "start_length": 120.0, "end_length": 120.0 + way, "top_speed": speed, "acceleration": 2.0,
    },
    st.one_of(between(-20.0, -6.0), between(6.0, 20.0)),
    between(0.5, 3.0),
)  # fmt: skip
moving_winches = st.one_of(winches, trapezoid)


def _fault(kind: str, motor: int, start: float, share: float) -> dict[str, Any]:
    more = {"partial": {"effectiveness": share}, "stuck": {"value": 100.0 * share}, "dead": {}}[kind]
    return {"kind": kind, "motor": motor, "start": start} | more


failing = st.lists(
    st.builds(
        _fault, st.sampled_from(["dead", "stuck", "partial"]), st.integers(1, 2), between(0.5, 2.5), between(0, 1)
    ),
    max_size=2,
    unique_by=lambda fault: fault["motor"],
)
"""Faults of two motors, none to both."""


Refused = tuple[dict[str, Any], tuple[str, ...]]
"""Overrides, and the keys one of which the refusal must name."""


def key(name: str, values: st.SearchStrategy[Any], *others: str) -> st.SearchStrategy[Refused]:
    """One key with a value it cannot have; ``others`` may be named in its place."""
    return values.map(lambda value: ({name: value}, (name, *others)))


def winch_law(named: str, values: st.SearchStrategy[float], **law: Any) -> st.SearchStrategy[Refused]:
    """A winch law from 400 m, one of whose values breaks the run."""
    fixed = {"start_length": 400.0} | law
    return values.map(lambda value: ({"winch": fixed | {named: value}}, (f"winch.{named}",)))


def fault(named: str, values: st.SearchStrategy[Any], **more: Any) -> st.SearchStrategy[Refused]:
    """A fault of motor 1 from 5 s on, one of whose values makes no sense."""
    fixed = {"kind": "dead", "motor": 1, "start": 5.0} | more
    return values.map(lambda value: ({"faults": [fixed | {named: value}]}, (f"faults.1.{named}",)))


inadmissible: st.SearchStrategy[Refused] = st.one_of(
    winch_law("speed", st.one_of(between(60.0, 1e4), between(-1e4, -60.0)), law="speed"),
    winch_law("amplitude", between(-1e4, -200.0), law="cosine", frequency=0.1),
    winch_law("acceleration", between(10.0, 1e3), law="trapezoid", end_length=450.0, top_speed=5.0),
    key("grid.elements", st.one_of(st.integers(4097, 10**9), st.integers(-9, 3))),
    key("control.outer_period", between(1.1e-3, 1.9e-3)),
    key("output.interval", between(1e-6, 9e-4)),
    key("payload.damping", between(6e5, 1e9)),
    key("environment.vessel_motion", between(0.1, 50.0).map(lambda e: [constant(e)])),
    key("control.motor_loop.current_gain", between(2e3, 1e6)),
    key("control.velocity_observer.time_constant", between(1e-7, 1e-5)),
    fault("motor", st.integers(3, 100)),
    fault("end", between(0.1, 4.9)),
    fault("effectiveness", between(1.1, 9.0), kind="partial"),
)
"""Scenarios that each break one rule, of fields or between fields."""
