"""Tables of RAOs: conventions are declared and checked, and what a table does not know is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from umbilical import load, load_operation, operate, simulate
from umbilical.errors import ScenarioError
from umbilical.scenario.ship import MOTIONS, RaoShip
from umbilical.screening.criteria import parse_criterion
from umbilical.sea import BoxVessel, RaoVessel, Spectrum, vessel_of
from umbilical.sea.rao_checks import assumed_of_table, covered, sea_problems, table_problems
from umbilical.verify.references.sea import CONVENTIONS, rao_rows

BOX = BoxVessel(93.0, 20.0, 6.6, 0.75)
PLAIN = rao_rows(BOX, CONVENTIONS["lag, y to port"])
OPERATION = """extends = "work-class"
name = "own ship"
[vessel]
kind = "rao"
file = "ship.csv"
phase = "lag"
axes = "port_up"
waves = "towards"
sheave_forward = 10.0
"""


RUN = """extends = "ringdown"
name = "in waves"
duration = 12.0
[environment]
vessel_ramp = 4.0
[environment.sea]
plane = 0.0
[[environment.sea.systems]]
significant_height = 1.5
peak_period = 10.0
heading = 2.5
[environment.sea.vessel]
kind = "rao"
file = "ship.csv"
phase = "lag"
axes = "port_up"
waves = "towards"
sheave_up = 8.0
"""


def vessel(**changes: Any) -> RaoVessel:
    found = vessel_of(RaoShip(**PLAIN | changes), 9.81)
    assert isinstance(found, RaoVessel)
    return found


def write(path: Path, *, pitch_unit: str = "deg/m", period: bool = True) -> None:
    names = ["surge", "sway", "heave", "pitch"]
    units = {"pitch": pitch_unit}
    head = ["heading [deg]", "period [s]" if period else "frequency [Hz]"]
    head += [part for n in names for part in (f"{n} [{units.get(n, 'm/m')}]", f"{n} phase [deg]")]
    lines = [";".join(head)]
    for k, omega in enumerate(PLAIN["frequency"]):
        row = [np.degrees(PLAIN["heading"][k]), 2 * np.pi / omega if period else omega / (2 * np.pi)]
        for name in names:
            amplitude = PLAIN[name][k]
            if name == "pitch" and pitch_unit == "deg/m":
                amplitude = np.degrees(amplitude)
            if name == "pitch" and pitch_unit == "deg/deg":
                amplitude = amplitude * 9.81 / omega**2
            row += [amplitude, np.degrees(PLAIN[f"{name}_phase"][k])]
        lines.append(";".join(f"{number:.12g}" for number in row).replace(".", ","))
    path.write_text("\n".join(lines))


@pytest.mark.parametrize("heading", [0.3, 1.7, 4.0, -1.0])
def test_headings_of_the_other_side_and_full_turns(heading: float) -> None:
    omega = np.array([0.4, 0.6])
    there = np.array(vessel().motions(omega, heading))
    assert np.allclose(there, np.array(vessel().motions(omega, heading + 2.0 * np.pi)))
    mirrored = np.array(vessel().motions(omega, -heading)) * np.array([1, -1, 1, -1, 1, -1])[:, None]
    assert np.allclose(there, mirrored)


def test_lag_is_minus_lead_and_a_slope_is_k_metres() -> None:
    omega = np.array([0.4, 0.6])
    lead = {f"{name}_phase": tuple(-p for p in PLAIN[f"{name}_phase"]) for name in MOTIONS}
    assert np.allclose(vessel(phase="lead", **lead).motions(omega, 1.0), vessel().motions(omega, 1.0))
    k = np.array(PLAIN["frequency"]) ** 2 / 9.81
    slope = {name: tuple(np.array(PLAIN[name]) / k) for name in ("roll", "pitch", "yaw")}
    assert np.allclose(vessel(rotations="per_slope", **slope).motions(omega, 1.0), vessel().motions(omega, 1.0))


def test_between_the_points_parts_are_linear_not_amplitude_and_phase() -> None:
    here, there = (np.array(vessel().motions(np.array([w]), 0.0)) for w in (0.6, 0.7))
    assert np.allclose(np.array(vessel().motions(np.array([0.65]), 0.0)), (here + there) / 2.0)
    assert vessel().motions(np.array([0.1, 3.0]), 0.0).heave.tolist() == [0j, 0j]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"phase": "lead"}, "lead/lag swapped"),
        ({"waves": "from"}, "headings from for towards"),
        ({"axes": "starboard_down"}, "other axes"),
        ({"heave": tuple(100.0 * h for h in PLAIN["heave"])}, "1 within a quarter"),
        ({"pitch": tuple(np.degrees(PLAIN["pitch"]))}, "deg/m or rad/m"),
        ({"pitch_phase": tuple(np.array(PLAIN["pitch_phase"]) + np.pi)}, "bow up"),
        ({"heading": (*PLAIN["heading"][:-1], PLAIN["heading"][0])}, "missing|twice"),
        ({"heave": PLAIN["heave"][:-1]}, "equally many"),
    ],
)
def test_a_table_that_is_not_as_declared_is_refused(change: dict[str, Any], words: str) -> None:
    problems = [*table_problems(RaoShip(**PLAIN | change))]
    assert problems
    assert any(part in str(problems[0]) for part in words.split("|"))


def test_a_table_of_short_waves_is_refused() -> None:
    short = np.array(PLAIN["frequency"]) > 0.45
    cut: dict[str, Any] = {
        name: tuple(np.array(v)[short]) for name, v in PLAIN.items() if isinstance(v, tuple) and len(v) > 3
    }
    assert "20 s or more" in str(next(table_problems(RaoShip(**PLAIN | cut))))


def test_heave_alone_says_which_sign_was_assumed() -> None:
    none: dict[str, Any] = {part: () for n in MOTIONS if n != "heave" for part in (n, f"{n}_phase")}
    alone = RaoShip(**PLAIN | none)
    assert not [*table_problems(alone)]
    assert "lag is taken as declared" in " ".join(assumed_of_table(alone))


def test_a_sea_beyond_the_table_is_refused() -> None:
    assert covered(vessel(), Spectrum(2.0, 10.0)) > 0.99
    assert not [*sea_problems(vessel(), Spectrum(2.0, 10.0), 2.0)]
    assert "energy" in str(next(sea_problems(vessel(), Spectrum(2.0, 4.0), 2.0)))


def test_what_a_table_moves_in_shorter_waves_can_be_declared() -> None:
    shorter, last = np.array([3.0, 5.0]), np.array([2.6])
    cases: list[Any] = [("hold", 1.0), ("zero", 0.0)]
    for outside, share in cases:
        ship = vessel(outside=outside)
        assert not [*sea_problems(ship, Spectrum(2.0, 4.0), 2.0)]
        found, end = (np.array(ship.motions(omega, 2.0)) for omega in (shorter, last))
        assert found == pytest.approx(share * end.repeat(2, axis=1))
        assert "outside the 2.42 to 25.1 s" in " ".join(assumed_of_table(RaoShip(**PLAIN | {"outside": outside})))


def test_headings_far_apart_are_not_interpolated() -> None:
    head = np.array(PLAIN["heading"]) > 3.1
    cut: dict[str, Any] = {
        name: tuple(np.array(v)[head]) for name, v in PLAIN.items() if isinstance(v, tuple) and len(v) > 3
    }
    only = vessel(**cut)
    assert only.knows(np.pi)
    assert only.knows(-np.pi)
    assert not only.knows(2.4)


@pytest.mark.parametrize(("unit", "period"), [("deg/m", True), ("deg/deg", False)])
def test_a_spreadsheet_of_the_closed_form_gives_its_limits(tmp_path: Path, unit: str, period: bool) -> None:
    write(tmp_path / "ship.csv", pitch_unit=unit, period=period)
    (tmp_path / "my.toml").write_text(OPERATION)
    axes: Any = {"depth": np.array([1500.0]), "period": np.array([9.0]), "heading": np.radians([135.0])}
    own, box = (
        operate(load_operation(source), [parse_criterion("slack=1e-2/3h")], **axes)
        for source in (tmp_path / "my.toml", "work-class")
    )
    assert own.limit[0, 0, 0] == pytest.approx(box.limit[0, 0, 0], rel=0.05)  # ten frequencies, linear between
    assert "no roll, yaw" in " ".join(own.notices())


def test_pitch_in_degrees_and_in_radians_moves_a_run_alike(tmp_path: Path) -> None:
    runs = []
    for unit in ("deg/m", "rad/m"):
        write(tmp_path / "ship.csv", pitch_unit=unit)
        (tmp_path / "run.toml").write_text(RUN)
        runs.append(simulate(load(tmp_path / "run.toml"))["displacement"].values)
    assert abs(runs[0]).max() > 0.1
    np.testing.assert_allclose(runs[1], runs[0], atol=1e-9)


def test_columns_may_be_headed_as_programs_do(tmp_path: Path) -> None:
    write(tmp_path / "ship.csv")
    text = (tmp_path / "ship.csv").read_text()
    (tmp_path / "my.toml").write_text(OPERATION)
    plain = load_operation(tmp_path / "my.toml")
    for name in ("surge", "sway", "heave", "pitch"):
        text = text.replace(f"{name} [", f"{name.title()}_Amp [").replace(f"{name} phase [", f"{name.upper()} Phase [")
    (tmp_path / "ship.csv").write_text(text.replace("heading", "Wave heading").replace("period", "Wave Period"))
    other = load_operation(tmp_path / "my.toml")
    assert isinstance(other.vessel, RaoShip)
    assert isinstance(plain.vessel, RaoShip)
    assert other.vessel.pitch == plain.vessel.pitch


def test_a_file_with_a_wrong_column_or_convention_is_refused(tmp_path: Path) -> None:
    write(tmp_path / "ship.csv")
    (tmp_path / "my.toml").write_text(OPERATION.replace('"lag"', '"lead"'))
    with pytest.raises(ScenarioError, match="lead/lag swapped"):
        load_operation(tmp_path / "my.toml")
    text = (tmp_path / "ship.csv").read_text().replace("heave phase [deg]", "heave phase")
    (tmp_path / "ship.csv").write_text(text)
    with pytest.raises(ScenarioError, match="heave phase \\[rad\\]") as refused:
        load_operation(tmp_path / "my.toml")
    assert [problem.key for problem in refused.value.problems] == ["vessel.file.heave_phase"]
