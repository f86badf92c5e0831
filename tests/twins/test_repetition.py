"""The same scenario gives the same bytes, run again and however the run is cut into stretches."""

from __future__ import annotations

from pathlib import Path

import pytest
import xarray

import umbilical
from tests.support.scenarios import run, small
from umbilical import Scenario

BUSY = {
    "faults": [{"kind": "intermittent", "motor": 1, "start": 0.0213, "cycle": 0.01, "duty": 0.3}],
    "sensors.tip_displacement.noise": 1e-5,
    "sensors.tip_slope.dropout": 0.4,
    "sensors.motor_speed.latency": 0.004,
    "environment.payload_force": [{"kind": "pulse", "value": 50.0, "start": 0.0302, "end": 0.0307}],
    "grid.step": 5e-4,
}


def busy(**overrides: object) -> Scenario:
    return small("paper-adaptive", **overrides).replace(BUSY)


@pytest.mark.nojit
@pytest.mark.bounds
@pytest.mark.parametrize("steps", [1, 7, 60])
def test_stretches_do_not_matter(steps: int, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = run(busy())
    monkeypatch.setattr("umbilical.engine.schedule.STEPS_AT_ONCE", steps)
    cut = run(busy())
    xarray.testing.assert_identical(cut.data, whole.data)


@pytest.mark.nojit
def test_stretches_do_not_matter_with_a_python_controller(monkeypatch: pytest.MonkeyPatch) -> None:
    from umbilical.control.cascade import Cascade

    scenario = busy(duration=0.03)
    whole = run(scenario, Cascade(scenario))
    monkeypatch.setattr("umbilical.engine.schedule.STEPS_AT_ONCE", 5)
    xarray.testing.assert_identical(run(scenario, Cascade(scenario)).data, whole.data)


def test_same_bytes_again(tmp_path: Path) -> None:
    first, second = (run(busy()).save(tmp_path / f"{k}.nc").read_bytes() for k in (1, 2))
    assert first == second


def test_a_stored_run_runs_again(tmp_path: Path) -> None:
    path = run(busy()).save(tmp_path / "run.nc")
    again = run(umbilical.load(path)).save(tmp_path / "again.nc")
    assert again.read_bytes() == path.read_bytes()


@pytest.mark.nojit
def test_another_seed_is_another_run() -> None:
    one, other = run(busy(seed=1)), run(busy(seed=2))
    assert (one["motor_voltage"].values != other["motor_voltage"].values).any()


@pytest.mark.nojit
def test_storing_changes_nothing() -> None:
    """Every control sample is measured, whatever is stored."""
    often, rarely = run(busy(output__interval=0.002)), run(busy(output__interval=0.05))
    for name in set(often.metrics) - {"energy_balance_residual", "grid_loss"}:
        assert often.metrics[name] == rarely.metrics[name], name
