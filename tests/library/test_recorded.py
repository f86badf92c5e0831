"""Tables from files: read beside the scenario, kept in the result, refused with everything that is wrong."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import umbilical
from umbilical.errors import ScenarioError
from umbilical.library.recorded import files_of

SINES = ((0.5, 0.5, 0.0), (0.3, 0.8, 1.0), (0.1, 1.3, 2.0))
TOML = """extends = "ringdown"
name = "recorded"
duration = 20.0
[environment]
vessel_ramp = 5.0
vessel_motion = [{{ kind = "table", file = {} }}]
"""


def motion(t: np.ndarray) -> np.ndarray:
    return np.sum([a * np.sin(w * t + p) for a, w, p in SINES], axis=0)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A record of 6000 samples at 10 Hz as a spreadsheet with decimal commas writes it, and a scenario beside it."""
    time = np.arange(6000) * 0.1
    rows = "".join(f"{t:.1f};{1e3 * y:.9f};0\r\n" for t, y in zip(time, motion(time), strict=True))
    text = "Zeit [s];Querbewegung [mm];Bemerkung [-]\r\n" + rows.replace(".", ",")
    (tmp_path / "log.csv").write_text(text, encoding="utf-8-sig")
    (tmp_path / "my.toml").write_text(TOML.format('{ name = "log.csv", value = "Querbewegung" }'))
    return tmp_path


def test_a_file_of_three_sines_is_the_run_of_three_sines(folder: Path) -> None:
    recorded = umbilical.load(folder / "my.toml")
    sines = [{"kind": "sine", "amplitude": a, "frequency": w, "phase": p} for a, w, p in SINES]
    exact = umbilical.load(folder / "my.toml", {"environment.vessel_motion": sines})
    runs = [umbilical.simulate(scenario) for scenario in (recorded, exact)]
    for name in ("vessel_displacement", "tip_displacement", "tip_velocity", "tip_slope"):
        found, expected = (run[name].values for run in runs)
        assert abs(found - expected).max() < 1e-6, name


def test_a_result_reruns_without_the_file(folder: Path) -> None:
    first = umbilical.simulate(umbilical.load(folder / "my.toml", {"duration": 2.0, "grid.elements": 4}))
    first.save(folder / "my.nc")
    (folder / "log.csv").unlink()
    again = umbilical.load(folder / "my.nc")
    assert again == first.scenario
    assert files_of(again)["environment.vessel_motion.1"].sha256
    assert umbilical.simulate(again).data.identical(first.data)


def test_another_file_or_other_numbers_by_override(folder: Path) -> None:
    (folder / "short.csv").write_text("t [s],y [m]\n0,0\n5,0.1\n10,0.2\n20,0.1\n30,0\n")
    key = "environment.vessel_motion.1"
    stored = folder / "stored.toml"
    stored.write_text(umbilical.load(folder / "my.toml").to_toml())
    term: Any = umbilical.load(stored, {f"{key}.file": "short.csv"}).environment.vessel_motion[0]
    assert term.times == (0.0, 5.0, 10.0, 20.0, 30.0)
    term = umbilical.load(stored, {f"{key}.file.drift": "mean"}).environment.vessel_motion[0]
    assert abs(np.mean(term.values)) < 1e-2
    given = {f"{key}.times": [0.0, 10.0, 20.0], f"{key}.values": [0.0, 0.1, 0.0]}
    term = umbilical.load(stored, given).environment.vessel_motion[0]
    assert term.file is None


@pytest.mark.parametrize(
    ("file", "keys", "words"),
    [
        ('"none.csv"', ["name"], "no such file"),
        ('"log.csv"', ["value"], "Querbewegung"),
        ('{ name = "log.csv", value = "Querbewegun" }', ["value"], "Querbewegung"),
        ('{ name = "log.csv", value = "Querbewegung", drift = "median" }', ["drift"], "mean"),
        ('{ name = "log.csv", value = "Querbewegung", units = "m" }', ["units"], "unit"),
        ('"log.csv", times = [0.0, 1.0]', [""], "beside"),
    ],
)
def test_what_is_wrong_with_a_file_is_said_at_its_key(folder: Path, file: str, keys: list[str], words: str) -> None:
    (folder / "my.toml").write_text(TOML.format(file))
    with pytest.raises(ScenarioError, match=words) as refused:
        umbilical.load(folder / "my.toml")
    found = [problem.key for problem in refused.value.problems]
    assert found == [f"environment.vessel_motion.1.file.{key}".rstrip(".") for key in keys]


def test_every_kind_of_table_can_come_from_a_file(tmp_path: Path) -> None:
    (tmp_path / "winch.csv").write_text("t [min],l [km]\n0,0.45\n0.1,0.452\n0.2,0.46\n0.3,0.468\n0.4,0.47\n")
    (tmp_path / "profile.csv").write_text("x/l [-],share [%]\n0,100\n0.5,20\n1,0\n")
    (tmp_path / "shape.csv").write_text("x/l [-],y [cm]\n0,0\n0.25,7\n0.5,10\n0.75,7\n1,0\n")
    (tmp_path / "force.csv").write_text("t [s],F [kN]\n0,0\n1,0.5\n1,0.2\n30,0.2\n")
    (tmp_path / "my.toml").write_text(
        """extends = "ringdown"
name = "files"
duration = 20.0
winch = { law = "table", file = "winch.csv" }
initial = { shape = "table", file = "shape.csv" }
[environment]
payload_force = [{ kind = "table", file = "force.csv", interpolation = "linear" }]
cable_load = [{ profile = { shape = "table", file = "profile.csv" }, signal = [{ kind = "constant", value = 1.0 }] }]
"""
    )
    loaded: Any = umbilical.load(tmp_path / "my.toml")
    assert loaded.winch.times[1] == pytest.approx(6.0)
    assert loaded.winch.lengths[0] == 450.0
    assert loaded.initial.displacements[1] == pytest.approx(0.07)
    assert loaded.environment.cable_load[0].profile.values == (1.0, 0.2, 0.0)
    assert loaded.environment.payload_force[0].values == (0.0, 500.0, 200.0, 200.0)
    assert set(files_of(loaded)) == {
        "winch", "initial", "environment.payload_force.1", "environment.cable_load.1.profile",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (200.0 * np.sin(0.02 * np.arange(100)), "standard deviation"),
        (4.0 * np.sin(2.0 * np.arange(100)), "speed of no ship"),
        (2.0 * np.sin(2.4 * np.arange(100)), "acceleration of no ship"),
    ],
)
def test_a_motion_that_no_ship_has_is_refused(values: np.ndarray, words: str) -> None:
    motion = [{"kind": "table", "times": np.arange(100.0).tolist(), "values": values.tolist()}]
    with pytest.raises(ScenarioError, match=words):
        umbilical.load("ringdown", {"environment.vessel_motion": motion, "environment.vessel_ramp": 5.0})
