"""With every motor dead from the start, nothing is left of the control, whatever it does."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.scenarios import run, small
from umbilical.verify.invariance import DEAD

CABLE = ("displacement", "velocity", "tip_slope", "energy", "work_payload_force", "work_tension", "thrust")


@pytest.mark.nojit
@pytest.mark.bounds
@pytest.mark.parametrize("preset", ["paper", "paper-adaptive", "paper-pd"])
def test_dead_motors_are_no_control(preset: str) -> None:
    dead, free = run(small(preset, faults=DEAD)), run(small("paper-none"))
    for name in CABLE:
        np.testing.assert_array_equal(dead[name].values, free[name].values)
    assert np.abs(dead["motor_voltage"].values).max() > 1e-3, "the controller still tries"


@pytest.mark.parametrize(
    "kind", [{"kind": "dead"}, {"kind": "stuck", "value": 0.0}, {"kind": "partial", "effectiveness": 0.0}]
)
def test_dead_is_stuck_at_nothing_is_all_effectiveness_lost(kind: dict[str, Any]) -> None:
    other = [kind | {"motor": motor, "start": 0.0} for motor in (1, 2)]
    a, b = run(small("paper", faults=DEAD)), run(small("paper", faults=other))
    np.testing.assert_array_equal(a["displacement"].values, b["displacement"].values)


def test_motors_without_supply_stand_still() -> None:
    cut = [fault | {"target": "voltage"} for fault in DEAD]
    quiet = {f"motors__{k}__{name}_disturbance": [] for k in (1, 2) for name in ("torque", "voltage")}
    dead = run(small("paper", faults=cut, **quiet))
    assert not dead["motor_speed"].values.any()
    np.testing.assert_array_equal(dead["displacement"].values, run(small("paper-none"))["displacement"].values)
