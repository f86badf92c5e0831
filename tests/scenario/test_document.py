"""Text and data: round trips, overrides, extending, hashing, the published schema."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from umbilical.errors import FileError, ScenarioError
from umbilical.library import load, preset_names, preset_text
from umbilical.scenario import document
from umbilical.scenario.fields import records, word
from umbilical.scenario.scenario import Scenario, parse_document
from umbilical.scenario.schema import schema_text
from umbilical.scenario.text import literal
from umbilical.screening.operation import Operation

PUBLISHED = Path(__file__).parents[2] / "docs" / "scenario.schema.json"

EVERYTHING: dict[str, Any] = {
    "environment.cable_load": [
        {
            "profile": {"shape": "table", "positions": [0.0, 0.5, 1.0], "values": [1.0, 0.5, 0.0]},
            "signal": [{"kind": "table", "times": [0.0, 60.0], "values": [0.0, 1.0], "interpolation": "linear"}],
        },
        {"profile": {"shape": "uniform"}, "signal": [{"kind": "pulse", "value": 1.0, "start": 1.0, "end": 2.0}]},
    ],
    "environment.vessel_motion": [{"kind": "sine", "amplitude": 1.0, "frequency": 0.5, "phase": 1.0}],
    "environment.vessel_ramp": 5.0,
    "winch": {"law": "table", "times": [0.0, 20.0, 40.0, 60.0], "lengths": [450.0, 460.0, 455.0, 450.0]},
    "initial": {"shape": "gaussian", "amplitude": 1.0, "distance": 100.0, "width": 20.0},
    "faults": [
        {"kind": "ramp", "motor": 1, "start": 1.0, "over": 3.0, "effectiveness": 0.5, "end": 9.0},
        {"kind": "intermittent", "motor": 2, "start": 1.0, "cycle": 3.0, "duty": 0.5, "target": "voltage"},
    ],
    "control.nominal": {"payload_mass": 450.0, "thrust_coefficients": [1.0, 1.0]},
    "control.nominal.motors": [load("paper").to_dict()["motors"][0]] * 2,
    "control.outer_period": 2e-3,
    "sensors.tip_slope.latency": 4e-3,
    "assumed.cable.line_density": 'a "quoted" reason,\nover two lines \\ with \t odd characters: \x7f µ',
    "description": 'a "quoted" text\nover two lines \\ with \t odd characters: \x7f µ',
}


@pytest.mark.parametrize("name", preset_names())
def test_text_round_trip(name: str) -> None:
    scenario = load(name)
    again = parse_document(scenario.to_toml())
    assert again == scenario
    assert again.hash == scenario.hash
    assert hash(again) == hash(scenario)


def test_text_round_trip_of_every_kind_of_section() -> None:
    scenario = load("paper", EVERYTHING)
    assert parse_document(scenario.to_toml()) == scenario


def test_the_paper_preset_is_the_complete_text() -> None:
    """Every key with its unit; a new key cannot be forgotten in the file users start from."""
    assert preset_text("paper") == load("paper").to_toml()


def test_the_text_names_every_key_unit_and_assumption() -> None:
    text = load("paper").to_toml()
    for fragment in (
        "line_density = 2.0              # kg/m | line density of the cable | Table 2",
        "# wet_line_density left out     # kg/m",
        "# one of: constant, speed, quintic, trapezoid, cosine, table",
        "# assumed: the paper prints no observer constants",
        "| assumed: the paper prints no thrust factors",
        "# [[faults]] none",
    ):
        assert fragment in text


def test_faults_can_be_added_below_the_complete_text() -> None:
    text = preset_text("paper") + '[[faults]]\nkind = "dead"\nmotor = 1\nstart = 5.0\n'
    assert parse_document(text).faults[0].start == 5.0


@given(
    st.text(st.characters(exclude_categories=["Cs"])) | st.floats(allow_nan=False, allow_infinity=False) | st.integers()
)
@settings(max_examples=100, deadline=None)
def test_literals_are_read_back(value: Any) -> None:
    assert tomllib.loads(f"value = {literal(value)}")["value"] == value


def test_hash_sees_every_change_and_only_changes() -> None:
    paper = load("paper")
    assert paper.hash == load("paper").hash
    assert paper.replace({"cable.line_density": 2}).hash == paper.hash
    changes = [{"cable.line_density": 2.0000000000000004}, {"seed": 1}, {"motors.2.inertia": 0.6}, {"description": "x"}]
    assert len({paper.hash, *(paper.replace(change).hash for change in changes)}) == 5


def test_replace_by_dotted_keys_numbered_from_one() -> None:
    scenario = load("paper").replace(
        {"motors.2.thrust_coefficient": np.float64(1.0), "grid.elements": np.int64(12), "motors.1.voltage_limit": 48}
    )
    assert [m.thrust_coefficient for m in scenario.motors] == [1.2, 1.0]
    assert scenario.grid.elements == 12
    assert scenario.motors[0].voltage_limit == 48.0
    assert load("paper").motors[1].thrust_coefficient == 0.8


def test_replace_by_none_takes_away() -> None:
    assert load("paper").replace({"control.disturbance_observer": None}).control.disturbance_observer is None


def test_naming_another_kind_empties_the_table_in_any_order() -> None:
    for overrides in (
        {"winch.law": "constant", "winch.length": 300.0},
        {"winch.length": 300.0, "winch.law": "constant"},
    ):
        assert load("paper").replace(overrides).winch.model_dump() == {"law": "constant", "length": 300.0}


def test_a_mark_goes_with_its_value() -> None:
    paper = load("paper")
    assert "control.period" in paper.replace({"duration": 10.0}).assumed
    assert "control.period" not in paper.replace({"control.period": 5e-4}).assumed
    assert "control.motor_loop" not in paper.replace({"control.motor_loop.speed_gain": 60.0}).assumed
    marked = paper.replace({"control.period": 5e-4, "assumed.control.period": "tried"})
    assert marked.assumed["control.period"] == "tried"


def test_overrides_that_lead_nowhere_are_all_named() -> None:
    with pytest.raises(ScenarioError) as caught:
        load("paper").replace({"motors.9.inertia": 1.0, "duration.s": 1.0, "faults.1.start": 2.0})
    assert {p.key for p in caught.value.problems} == {"motors.9.inertia", "duration.s", "faults.1.start"}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("cable.length=250", ("cable.length", 250)),
        ("x = 1e-3", ("x", 1e-3)),
        ("flag=true", ("flag", True)),
        ("law=pd", ("law", "pd")),
        ('law="pd"', ("law", "pd")),
        ("rates=[1, 2]", ("rates", [1, 2])),
        ("name=a=b", ("name", "a=b")),
        ("name=", ("name", "")),
    ],
)
def test_assignments_as_typed(text: str, expected: tuple[str, Any]) -> None:
    assert document.assignment(text) == expected


@pytest.mark.parametrize("text", ["duration", "=3", ""])
def test_assignments_without_key_or_value(text: str) -> None:
    with pytest.raises(ScenarioError, match="key=value"):
        document.assignment(text)


def test_text_that_is_not_toml_names_the_line() -> None:
    with pytest.raises(FileError, match=r"my\.toml: this is not TOML: .*line 3"):
        parse_document('name = "a"\nduration = 1.0\ncable = [\n', "my.toml")


def test_published_schema_is_current() -> None:
    """If this fails: umbilical schema > docs/scenario.schema.json"""
    assert PUBLISHED.read_text(encoding="utf-8") == schema_text()


def test_schema_describes_every_record_and_forbids_other_keys() -> None:
    schema = json.loads(schema_text())
    assert set(schema["properties"]) == {*Scenario.model_fields, "extends"}
    assert schema["additionalProperties"] is False
    assert all(definition["additionalProperties"] is False for definition in schema["$defs"].values())
    kinds = {kind.__name__ for field in Scenario.model_fields.values() for kind in records(field.annotation)}
    assert kinds <= set(schema["$defs"])
    assert schema["$defs"]["Cable"]["properties"]["line_density"]["unit"] == "kg/m"


_LONG = "9" * 5000
IMPOSSIBLE = [
    ".".join("a" * 1000) + "=5",
    "assumed." + ".".join("a" * 1000) + "=5",
    f"motors.{_LONG}.inertia=1.0",
    "motors=" + "[" * 500,
    "motors=" + "[" * 500 + "]" * 500,
    "winch={" + ".".join("a" * 1000) + " = 1}",
    f"duration={_LONG}",
    f"seed=-{_LONG}",
    f"duration=0x{'f' * 5000}",
    f"winch.lengths=[1.0, {{ a = 0x{'f' * 5000} }}]",
    "name=\udcff",
    "\udcff=1",
]


@pytest.mark.parametrize("text", IMPOSSIBLE, ids=[text[:16] for text in IMPOSSIBLE])
def test_what_no_scenario_has_is_refused_as_an_override(text: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        load("paper", dict([document.assignment(text)]))
    assert all(len(line) < 1000 for line in str(caught.value).splitlines())


@pytest.mark.parametrize("text", [text.replace("=", " = ", 1) for text in IMPOSSIBLE[:9]], ids=IMPOSSIBLE[:9])
def test_what_no_scenario_has_is_refused_in_a_file(tmp_path: Path, text: str) -> None:
    path = tmp_path / "my.toml"
    path.write_text(f'extends = "paper"\n{text}\n', encoding="utf-8")
    with pytest.raises((ScenarioError, FileError), match=r"my\.toml"):
        load(path)


@pytest.mark.parametrize("marks", ["5", "[1]", '"x"', "{ duration = 5 }", "{}"])
def test_marks_that_are_no_table_of_reasons_are_refused(tmp_path: Path, marks: str) -> None:
    path = tmp_path / "my.toml"
    path.write_text(f'extends = "paper"\nassumed = {marks}\n', encoding="utf-8")
    if marks == "{}":
        assert load(path)
    else:
        with pytest.raises(ScenarioError, match="assumed"):
            load(path)


def test_a_name_that_is_only_half_alike_is_not_suggested() -> None:
    with pytest.raises(ScenarioError) as caught:
        load("paper", {"motors.1.current_limit": 5.0})
    assert "did you mean" not in caught.value.problems[0].fix
    with pytest.raises(ScenarioError) as caught:
        load("paper", {"motors.1.voltage_limt": 5.0})
    assert caught.value.problems[0].fix == "did you mean 'voltage_limit'?"


def _fields(record):
    for field in record.model_fields.values():
        yield field
        for part in records(field.annotation):
            yield from _fields(part)


@pytest.mark.parametrize("record", [Scenario, Operation])
def test_no_fix_is_a_mere_unit(record):
    """Who reads "fix: kg" knows no more than before; without a fix the bounds are told."""
    given = [(word(field, "unit"), word(field, "fix")) for field in _fields(record)]
    spelt = {"seconds", "metres", "newton", "ohm", "kilograms", "volts"}
    assert len(given) > 20
    assert [fix for unit, fix in given if fix and (fix == unit or fix in spelt)] == []
