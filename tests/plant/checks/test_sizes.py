"""What a run takes is told when it is large, and refused above what the machine has."""

from __future__ import annotations

from pathlib import Path

import pytest

from umbilical import machine
from umbilical.engine.simulate import simulate
from umbilical.errors import ScenarioError
from umbilical.library import admit, load
from umbilical.plant.checks.sizes import check_memory, result_size

LARGE = {"grid.elements": 400, "output.interval": 1e-3}


def test_the_size_of_a_result_is_foretold(tmp_path: Path) -> None:
    scenario = load("paper", {"duration": 1.0, "output.interval": 1e-3})
    stored = simulate(scenario).save(tmp_path / "a.nc").stat().st_size
    assert stored == pytest.approx(result_size(scenario), rel=0.1)


def test_a_large_result_is_told_and_one_above_the_machine_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    scenario = load("paper", LARGE)
    assert "the result takes 1.9 GB on disk" in " ".join(map(str, admit(scenario)))
    assert not admit(load("paper"))
    monkeypatch.setattr(machine, "memory", lambda: 1e9)
    for refused in (check_memory, simulate):
        with pytest.raises(ScenarioError, match=r"1 GB of memory on this machine, not 6\.8 GB"):
            refused(scenario)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        (
            {"faults": [{"kind": "intermittent", "motor": 1, "start": 0.0, "cycle": 5e-5, "duty": 0.5}]},
            "faults.1.cycle",
        ),
        (
            {
                "environment.payload_force": [
                    {
                        "kind": "table",
                        "times": [50.0 * k / 100_001 for k in range(100_002)],
                        "values": [0.0] * 100_002,
                        "interpolation": "linear",
                    }
                ]
            },
            "environment.payload_force",
        ),
        (
            {
                "motors.1.torque_disturbance": [
                    {"kind": "pulse", "value": 1.0, "start": k * 1e-4, "end": k * 1e-4 + 5e-5} for k in range(50_001)
                ]
            },
            "motors.1.torque_disturbance",
        ),
    ],
)
def test_the_number_of_instants_at_which_something_jumps_is_bounded(changes, key) -> None:
    with pytest.raises(ScenarioError) as caught:
        load("paper", changes)
    assert [problem.key for problem in caught.value.problems] == [key]
    assert "100000" in caught.value.problems[0].bound or "1e+05" in caught.value.problems[0].bound
