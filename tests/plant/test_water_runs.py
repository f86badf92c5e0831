"""Runs in water: the balance closes with every term at work."""

from __future__ import annotations

from typing import Any

import numpy as np

import umbilical
from tests.plant.test_water import SEA
from umbilical.verify.engine import open_loop, sine

MOVED: dict[str, Any] = {
    **SEA,
    "environment.water.current.variation": [sine(0.2, 0.7)],
    "environment.vessel_heave": [sine(0.5, 0.8)], "environment.vessel_motion": [sine(0.5, 0.6)],
    "environment.vessel_ramp": 3.0, "cable.damping": 0.05, "payload.damping": 10.0,
    "winch": {"law": "quintic", "start_length": 100.0, "end_length": 108.0, "duration": 10.0},
    "initial": {"shape": "equilibrium"},
}  # fmt: skip


def test_the_balance_closes_and_every_term_is_needed() -> None:
    run = umbilical.simulate(open_loop(duration=10.0, grid__elements=8, output__interval=0.01).replace(MOVED))
    closed = run.metrics["energy_balance_residual"]
    assert closed < 1e-6
    energy = run["energy"].values
    works = {str(name): run[str(name)].values for name in run.data if str(name).startswith("work_")}
    total = np.sum(list(works.values()), axis=0)
    scale = max(energy.max(), np.abs(np.diff(total)).sum())
    for name in ("work_drag", "work_body_drag", "work_current", "work_added_mass", "work_tension", "work_vessel"):
        opened = np.abs(energy - energy[0] - (total - works[name] + works[name][0])).max() / scale
        assert opened > 100.0 * closed, name
