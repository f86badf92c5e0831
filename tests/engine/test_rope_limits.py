"""Hard cases of the rope end with a status and a reason, in numbers that are finite."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from umbilical import Run, Status
from umbilical.engine.simulate import simulate
from umbilical.errors import ScenarioError
from umbilical.library import load

HEAVE = [{"kind": "sine", "amplitude": 2.0, "frequency": 0.785}]
SNAPPING = {
    "winch.length": 1000.0, "environment.sea": None, "environment.vessel_ramp": 20.0, "environment.vessel_heave": HEAVE,
    "duration": 60.0,
}  # fmt: skip
HAULED = {"law": "quintic", "start_length": 200.0, "end_length": 20.0, "duration": 55.0}
DEAD = [{"kind": "dead", "motor": motor, "start": 1.0} for motor in (1, 2)]
FAST = {"depths": [0.0, 300.0], "speeds": [2.0, 2.0]}


def ended(run: Run) -> Run:
    assert run.reason
    assert all(np.isfinite(run[str(name)].values).all() for name in run.data.data_vars)
    assert all(np.isfinite(value) for value in run.metrics.values())
    return run


def test_two_metres_of_heave_snap() -> None:
    run = ended(simulate(load("work-class-3000m", SNAPPING)))
    assert run.metrics["snaps"] >= 3
    assert run.metrics["top_tension_peak"] == pytest.approx(146e3, rel=0.1)


@pytest.mark.parametrize(
    ("preset", "changes", "pulled"),
    [
        ("paper", {"model": "rope", "winch": HAULED, "duration": 60.0, "cable.axial_stiffness": 2e6}, 0.0),
        ("observation-300m", {"payload.wet_weight": 240.0}, 0.1),
        ("observation-300m", {"payload.wet_weight": 20.0}, 1.0),
        ("observation-300m", {"environment.water.current": FAST}, 1.0),
        ("paper", {"model": "rope", "faults": DEAD}, 1e-3),
    ],
    ids=["hauled in to 20 m", "a heavy body", "a light body", "a cable drawn level", "all thrusters dead"],
)
def test_what_thrusters_cannot_hold_is_a_run(preset: str, changes: dict[str, Any], pulled: float) -> None:
    run = ended(simulate(load(preset, {"duration": 20.0} | changes)))
    assert run.status is Status.COMPLETED
    assert run.metrics["energy_balance_residual"] < 1e-6
    assert run.metrics["watch_radius"] > pulled


def between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False).map(lambda value: float(f"{value:.4g}"))


@pytest.mark.slow
@settings(max_examples=15, deadline=None, derandomize=True)
@given(
    ends=st.tuples(between(20.0, 400.0), between(20.0, 400.0)), heave=between(0.0, 4.0), period=between(2.0, 12.0),
    current=between(-2.0, 2.0), mass=between(20.0, 2000.0), stiffness=between(3e5, 1e8), elements=st.integers(2, 12),
    force=between(-3e3, 3e3), preset=st.sampled_from(["paper", "paper-adaptive", "crosscheck-proposed"]),
)  # fmt: skip
def test_any_rope_ends_with_a_status_and_a_reason(
    ends: tuple[float, float], heave: float, period: float, current: float, mass: float, stiffness: float,
    elements: int, force: float, preset: str,
) -> None:  # fmt: skip
    changes: dict[str, Any] = {
        "model": "rope", "duration": 10.0, "payload.mass": mass, "rope.elements": elements,
        "cable.axial_stiffness": stiffness, "cable.water": {"diameter": 0.02}, "cable.wet_line_density": 1.7,
        "payload.water": {"quadratic_drag": mass, "vertical_drag": mass}, "payload.wet_weight": 9.0 * mass,
        "winch": {"law": "quintic", "start_length": ends[0], "end_length": ends[1], "duration": 40.0},
        "environment.water": {"current": {
            "depths": [0.0, 500.0], "speeds": [current, current], "speeds_across": [0.5 * current, 0.5 * current],
        }},
        "environment.vessel_heave": [{"kind": "sine", "amplitude": heave, "frequency": 2.0 * np.pi / period}],
        "rope.force_up": [{"kind": "sine", "amplitude": force, "frequency": 1.0}], "environment.vessel_ramp": 2.0,
    }  # fmt: skip
    try:
        scenario = load(preset, changes)
    except ScenarioError:
        return
    run = ended(simulate(scenario))
    assert run.status is Status.COMPLETED or "parted" in run.reason or "finite" in run.reason
