"""Where scenarios come from: presets, files of every kind, `extends`, overrides; and what is let in with a word."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from umbilical.errors import FileError, ScenarioError, UmbilicalError
from umbilical.library import admit, load, preset_names, preset_text

PRESETS = {
    "paper", "paper-none", "paper-pd", "paper-adaptive", "paper-dead", "paper-stuck", "paper-partial",
    "paper-dead-adaptive", "paper-stuck-adaptive", "paper-partial-adaptive",
    "crosscheck-none", "crosscheck-pd", "crosscheck-proposed", "crosscheck-no-observer", "ringdown", "haul-in",
}  # fmt: skip
AT_SEA = {"observation-300m", "work-class-1000m-current", "work-class-3000m", "work-class-payout"}
"""Presets in water, of which there is something to tell."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(folder: Path, text: str | bytes, name: str = "my.toml") -> Path:
    path = folder / name
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def refused(path: Path) -> str:
    """What loading a file is refused with; empty if it is not. Any other exception fails the test."""
    try:
        load(path)
    except UmbilicalError as error:
        return str(error)
    return ""


def test_all_presets_are_there() -> None:
    assert set(preset_names()) == PRESETS | AT_SEA


@pytest.mark.parametrize("name", sorted(PRESETS))
def test_presets_are_admitted_without_a_word(name: str) -> None:
    scenario = load(name)
    assert scenario.name == name
    assert admit(scenario) == ()


def test_file_and_preset_are_the_same_scenario(folder: Path) -> None:
    write(folder, preset_text("paper"))
    assert load("my.toml") == load(Path("my.toml")) == load("paper")


def test_a_file_may_extend_a_preset(folder: Path) -> None:
    write(
        folder,
        'extends = "paper-dead"\nname = "mine"\n[cable]\nline_density = 3\n[winch]\nlaw = "constant"\nlength = 300.0\n',
    )
    scenario = load("my.toml")
    assert scenario.cable.line_density == 3.0
    assert scenario.cable.damping == 0.001
    assert scenario.winch.law == "constant"
    assert [fault.kind for fault in scenario.faults] == ["dead"]
    assert "winch" not in scenario.assumed, "the value is the file's own now"
    assert "control.period" in scenario.assumed, "this one still is the preset's"


def test_overrides_come_last(folder: Path) -> None:
    write(folder, 'extends = "paper"\nname = "mine"\n[cable]\nline_density = 3.0\n')
    assert load("my.toml", {"cable.line_density": 4.0}).cable.line_density == 4.0


def test_extending_what_is_no_preset(folder: Path) -> None:
    write(folder, 'extends = "papper"\n')
    with pytest.raises(ScenarioError, match="did you mean 'paper'"):
        load("my.toml")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "the file is empty"),
        ("  \n\n", "the file is empty"),
        ("name = \n", "not TOML.*line 1"),
        ('name = "a"\nname = "b"\n', "not TOML.*line 2"),
        ("x = " + "[" * 5000, "not TOML|nested too deeply"),
        ('name = "Schlüssel"\n'.encode("latin-1"), r"not UTF-8 text \(line 1\)"),
        ('name = "a"\n'.encode("utf-16"), "not UTF-8 text"),
        (b"\x89HDF\r\n\x1a\n\x00\x00", "not UTF-8 text"),
        (b"name = 'a\x00b'", "not TOML"),
    ],
)
def test_files_that_are_no_scenario(folder: Path, content: str | bytes, message: str) -> None:
    with pytest.raises(FileError, match=message):
        load(write(folder, content))


def test_a_scenario_saved_with_a_byte_order_mark_and_windows_lines(folder: Path) -> None:
    text = preset_text("paper").replace("\n", "\r\n")
    assert load(write(folder, b"\xef\xbb\xbf" + text.encode())) == load("paper")


def test_missing_file_names_the_nearest_preset(folder: Path) -> None:
    with pytest.raises(FileError, match="did you mean 'paper-dead'"):
        load("paper-daed")
    with pytest.raises(FileError, match=r"no/such/file\.toml: there is no preset or file"):
        load("no/such/file.toml")
    with pytest.raises(FileError, match="did you mean 'ringdown'"):
        preset_text("ringdwon")


def test_a_folder_is_no_scenario(folder: Path) -> None:
    with pytest.raises(FileError, match="this is a folder"):
        load(folder)


def test_an_unreadable_file(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Patched rather than made with chmod, which does not keep an administrator from reading."""
    path = write(folder, preset_text("paper"))

    def refuse(*_: Any, **__: Any) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(FileError, match=r"cannot be read \(Permission denied\)"):
        load(path)


def test_truncated_anywhere_is_refused_or_still_a_scenario(folder: Path) -> None:
    """Cuts before the controller is described must be refused; later ones may only cost comments and marks."""
    text = preset_text("paper").encode()
    needed = text.index(b"[control.law]")
    for cut in range(1, len(text), 211):
        path = write(folder, text[:cut])
        refusal = refused(path)
        assert path.name in refusal if refusal else cut > needed


@pytest.mark.parametrize(
    ("overrides", "key"),
    [
        ({"faults": [{"kind": "dead", "motor": 1, "start": 50.001}]}, "faults.1.start"),
        (
            {"environment.payload_force": [{"kind": "step", "value": 1.0, "time": 51.0}]},
            "environment.payload_force.1.time",
        ),
        (
            {"motors.2.torque_disturbance": [{"kind": "pulse", "value": 1.0, "start": 60.0, "end": 61.0}]},
            "motors.2.torque_disturbance.1.start",
        ),
        ({"winch.start": 50.5}, "winch"),
    ],
)
def test_what_never_happens_is_let_in_with_a_word(overrides: dict[str, Any], key: str) -> None:
    (notice,) = admit(load("paper", overrides))
    assert notice.key == key
    assert "after the end of the run at 50 s" in notice.message


def test_a_loop_that_feels_the_grid_is_let_in_with_a_word() -> None:
    (notice,) = admit(load("ringdown", {"control.law.slope_gain": 20.0}))
    assert notice.key == "control.law.slope_gain"
    assert "umbilical margins" in notice.message
    assert not admit(load("ringdown", {"control.law.slope_gain": 5.0}))


def test_adaptation_without_the_error_that_drives_it_is_refused() -> None:
    law = {"kind": "pd", "position_gain": 100.0, "velocity_gain": 10.0}
    with pytest.raises(ScenarioError) as refusal:
        load("paper-adaptive", {"control.law": law})
    assert [problem.key for problem in refusal.value.problems] == ["control.allocation.method"]


def test_a_fault_at_the_very_end_is_let_in_silently() -> None:
    assert admit(load("paper", {"faults": [{"kind": "dead", "motor": 1, "start": 50.0}]})) == ()


def test_admit_refuses_what_replace_made() -> None:
    with pytest.raises(ScenarioError, match="above or below 0"):
        admit(load("paper").replace({"motors.1.thrust_coefficient": 0.0}))


def test_presets_differ_in_what_their_names_say() -> None:
    paper = load("paper").to_dict()
    for name, differing in {
        "paper-none": {"name", "description", "ideal_thruster", "motors", "control", "assumed"},
        "paper-pd": {"name", "description", "sensors", "control"},
        "paper-adaptive": {"name", "description", "control", "assumed"},
        "paper-dead": {"name", "description", "faults", "assumed"},
        "paper-stuck": {"name", "description", "faults", "assumed"},
        "paper-partial": {"name", "description", "faults", "assumed"},
        "haul-in": {"name", "description", "winch", "assumed"},
    }.items():
        other = load(name).to_dict()
        assert {key for key in paper if paper[key] != other[key]} == differing, name


def test_assumed_numbers_are_marked() -> None:
    marks = load("paper-stuck-adaptive").assumed
    for key in (
        "winch", "initial", "environment.payload_force", "motors.1.thrust_coefficient", "motors.2.voltage_disturbance",
        "control.velocity_observer", "control.slope_observer", "control.disturbance_observer", "control.motor_loop",
        "control.allocation.rates", "control.allocation.leak", "control.allocation.initial", "faults.1.value",
    ):  # fmt: skip
        assert marks[key], key


def test_what_an_extending_file_takes_over_is_marked(tmp_path: Path) -> None:
    mine, paper = tmp_path / "mine.toml", load("paper")
    mine.write_text('extends = "paper"\ncontrol.period = 0.0005\n', encoding="utf-8")
    assert load(mine).description == f"Changed from paper. {paper.description}"
    assert paper.assumed.keys() - load(mine).assumed.keys() == {"control.period"}  # whose reason was of another value
    mine.write_text(mine.read_text(encoding="utf-8") + 'description = "Mine."\n')
    assert load(mine).description == "Mine."


def test_a_density_that_is_none_is_refused() -> None:
    with pytest.raises(ScenarioError, match="line_density"):
        load("paper", {"cable.line_density": 5e-324})
