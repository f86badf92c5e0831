"""The built-in controller behind the Python contract gives the bits of the compiled loop."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.scenarios import run, small
from umbilical import Command, Measurement, Scenario
from umbilical.control.cascade import Cascade
from umbilical.engine.loop import run_dry_steps

INSIDE = {
    "boundary_error", "tip_velocity_estimate", "tip_slope_rate_estimate", "disturbance_estimate", "kappa", "demand",
    "speed_reference", "motor_disturbance_estimate",
}  # fmt: skip
"""What a controller of the user keeps to itself."""

NOISY = {
    "sensors.tip_displacement.noise": 1e-5,
    "sensors.tip_slope.bias": 1e-6,
    "sensors.tip_slope.resolution": 1e-7,
    "sensors.motor_speed.latency": 0.003,
    "sensors.motor_current.dropout": 0.3,
    "sensors.motor_current.noise": 0.1,
}
ONE_MOTOR = {"motors": [{
    "inertia": 0.5, "viscous_friction": 0.015, "torque_constant": 4.0, "load_coefficient": 1.0, "resistance": 0.08,
    "inductance": 0.002, "back_emf_constant": 0.5, "thrust_coefficient": -1.5, "voltage_limit": 3.0,
}]}  # fmt: skip
THREE_MOTORS = {"motors": [ONE_MOTOR["motors"][0] | {"thrust_coefficient": k} for k in (1.2, -0.8, 0.5)]}
FAULTS = {"faults": [
    {"kind": "stuck", "motor": 2, "start": 0.03, "end": 0.06, "value": 100.0},
    {"kind": "ramp", "motor": 1, "target": "voltage", "start": 0.0205, "over": 0.04, "effectiveness": 0.5},
]}  # fmt: skip
ADAPTIVE = {"control.allocation": {
    "method": "adaptive", "rates": [0.1, 100.0, 100.0, 100.0], "leak": 1e-3, "initial": [0.25, 0.0, 0.0, 0.0],
}}  # fmt: skip

CASES: dict[str, tuple[str, dict[str, Any]]] = {
    "paper": ("paper", {}),
    "adaptive": ("paper-adaptive", {}),
    "faults": ("paper-adaptive", FAULTS),
    "hauling in": ("haul-in", {}),
    "noisy sensors": ("paper", NOISY),
    "slower outer loop": ("paper-adaptive", {"control.outer_period": 0.002}),
    "substeps": ("paper", {"control.period": 0.001, "grid.step": 0.0004}),
    "one motor": ("paper", ONE_MOTOR),
    "three motors": ("paper", THREE_MOTORS | ADAPTIVE),
    "observed pd": ("paper-pd", {}),
    "ideal thruster": ("crosscheck-proposed", {}),
    "ideal pd": ("crosscheck-pd", {}),
    "no control": ("paper-none", {}),
}


@pytest.mark.nojit
@pytest.mark.bounds
@pytest.mark.parametrize(("preset", "changes"), CASES.values(), ids=CASES)
def test_python_loop_is_the_compiled_loop(preset: str, changes: dict[str, Any]) -> None:
    scenario = small(preset).replace(changes)
    compiled, python = run(scenario), run(scenario, Cascade(scenario))
    names = {str(name) for name in compiled.data.data_vars}
    assert names == {str(name) for name in python.data.data_vars}
    for name in sorted(names - INSIDE):
        np.testing.assert_array_equal(python[name].values, compiled[name].values, name)
    assert np.abs(compiled["tip_displacement"].values).max() > 0.0


@pytest.mark.skipif(not hasattr(run_dry_steps, "signatures"), reason="nothing is compiled")
def test_numbers_of_motors_and_of_loads_compile_nothing() -> None:
    """Lengths of arrays only: the loop that is compiled for two motors and no load runs them all."""
    run(small("paper"))
    before = set(run_dry_steps.signatures)
    load = {"profile": {"shape": "sine"}, "signal": [{"kind": "constant", "value": 0.1}]}
    changes = ONE_MOTOR, THREE_MOTORS, ADAPTIVE | THREE_MOTORS, {"environment.cable_load": [load]}, NOISY
    for change in changes:
        run(small("paper").replace(change))
    run(small("crosscheck-pd"))
    assert set(run_dry_steps.signatures) == before


class OuterOnly:
    """The built-in controller, saying its thrust alone: allocation and motor loops are left to the engine."""

    def __init__(self, scenario: Scenario, period: float) -> None:
        self.period = period
        self._inside = Cascade(scenario.replace({"control.period": period, "control.outer_period": None}))

    def start(self, measurement: Measurement) -> Any:
        return self._inside.start(measurement)

    def update(self, t: float, measurement: Measurement, state: Any) -> tuple[Command, Any]:
        command, state = self._inside.update(t, measurement, state)
        return Command(thrust=command.thrust), state


@pytest.mark.nojit
@pytest.mark.parametrize("period", [0.001, 0.002])
def test_thrust_alone_goes_through_the_same_motor_loops(period: float) -> None:
    scenario = small("paper", control__outer_period=period)
    compiled, python = run(scenario), run(scenario, OuterOnly(scenario, period))
    for name in ("displacement", "motor_voltage", "demand", "speed_reference", "motor_disturbance_estimate", "thrust"):
        np.testing.assert_array_equal(python[name].values, compiled[name].values, name)


def test_longer_run_with_everything() -> None:
    scenario = small("paper-adaptive", duration=3.0).replace(FAULTS | NOISY | {"control.outer_period": 0.002})
    compiled, python = run(scenario), run(scenario, Cascade(scenario))
    for name in sorted({str(name) for name in compiled.data.data_vars} - INSIDE):
        np.testing.assert_array_equal(python[name].values, compiled[name].values, name)
