"""Commands that read results and scenarios."""

from __future__ import annotations

import json
import shutil
import tomllib
from pathlib import Path

import pytest

from umbilical import load, open_run, preset_names
from umbilical.engine.warming import PARTS
from umbilical.scenario.inventory import inventory
from umbilical.screening import operation_names
from umbilical.studies.load import study_names


def test_show_a_result(umbilical, stored):
    run = open_run(stored["driven"])
    shown = umbilical("show", stored["driven"]).out
    assert run.summary() in shown
    assert run.scenario.hash in shown
    document = umbilical("show", stored["driven"], "--json").document()
    assert document["metrics"] == run.metrics


def test_show_a_scenario_with_what_is_assumed_and_why(umbilical):
    shown = umbilical("show", "paper").out
    scenario = load("paper")
    for key, reason in scenario.assumed.items():
        assert key in shown
        assert reason in shown
    lines = {line.split()[0]: line for line in shown.splitlines() if line.strip()}
    assert lines["cable.line_density"].split()[:3] == ["cable.line_density", "2.0", "kg/m"]
    assert "assumed" not in lines["cable.line_density"]
    assert "assumed" in lines["winch.start_length"]
    assert " 1/s " in lines["control.motor_loop.speed_gain"]
    assert umbilical("show", "paper", "--json").document()["scenario"] == json.loads(json.dumps(scenario.to_dict()))


@pytest.mark.parametrize("name", preset_names())
def test_every_marked_value_of_a_preset_is_in_its_inventory(name):
    scenario = load(name)
    entries = inventory(scenario, scenario.assumed)
    for key in scenario.assumed:
        inside = [entry for entry in entries if entry.key == key or entry.key.startswith(key + ".")]
        assert all(entry.assumed for entry in inside)
        assert inside or not _value(scenario.to_dict(), key), key


def _value(data, key):
    """What stands at a key, None where it was left out."""
    for step in key.split("."):
        data = data[int(step) - 1] if step.isdecimal() else data.get(step)
        if data is None:
            return None
    return data


def test_compare_gives_ratios_to_the_first(umbilical, stored):
    shown = umbilical("compare", stored["free"], stored["driven"]).out
    first, second = (open_run(stored[name]).metrics["tip_peak"] for name in ("free", "driven"))
    row = next(line.split() for line in shown.splitlines() if line.split()[0] == "tip_peak")
    assert [float(cell) for cell in row[2:]] == pytest.approx([first, second, second / first], rel=1e-3)
    document = umbilical("compare", stored["free"], stored["driven"], "--json").document()
    assert [run["scenario"] for run in document["runs"]] == ["crosscheck-none", "paper"]


def test_compare_has_no_ratio_to_nothing(umbilical, stored):
    shown = umbilical("compare", stored["free"], stored["driven"]).out
    row = next(line.split() for line in shown.splitlines() if line.split()[0] == "effort_rms")
    assert row[2] == "0"
    assert row[-1] == "-"


@pytest.mark.parametrize("kind", ["csv", "mat"])
def test_export_beside_the_result(umbilical, stored, tmp_path, kind):
    source = Path(shutil.copy(stored["driven"], tmp_path / "r.nc"))
    assert umbilical("export", source, "--to", kind).code == 0
    assert source.with_suffix(f".{kind}").stat().st_size > 1000
    assert umbilical("export", source, "--to", kind).code == 4
    assert umbilical("export", source, "--to", kind, "--force").code == 0


@pytest.mark.parametrize("kind", ["overview", "tip", "positions", "cable", "motors", "observers", "energy"])
def test_plot_every_kind(umbilical, stored, tmp_path, kind):
    target = tmp_path / "picture.png"
    assert umbilical("plot", stored["driven"], "--kind", kind, "--out", target).code == 0
    assert target.read_bytes().startswith(b"\x89PNG")


def test_plot_goes_beside_the_result(umbilical, stored, tmp_path):
    source = shutil.copy(stored["free"], tmp_path / "r.nc")
    assert umbilical("plot", source, "--kind", "tip").code == 0
    assert (tmp_path / "r-tip.png").exists()


def test_plot_of_what_a_run_does_not_have(umbilical, stored, tmp_path):
    done = umbilical("plot", stored["free"], "--kind", "observers", "--out", tmp_path / "a.png")
    assert done.code == 2
    assert "nothing was estimated" in done.err


def test_presets_are_listed_and_printed(umbilical):
    listed = umbilical("presets").out
    first = [line.split()[0] for line in listed.splitlines() if line]
    assert first == [
        *("scenarios,", *preset_names()),
        *("studies,", *study_names()),
        *("operations,", *operation_names()),
    ]
    assert umbilical("presets", "paper-dead").out.startswith('extends = "paper"')


def test_a_copied_preset_is_the_preset_marked_as_a_copy_and_is_not_overwritten(umbilical, tmp_path):
    mine, paper = tmp_path / "mine.toml", load("paper")
    copied = paper.model_copy(update={"name": "mine", "description": f"Copied from paper. {paper.description}"})
    assert umbilical("presets", "--copy", "paper", mine).code == 0
    assert load(mine) == copied
    assert umbilical("presets", "--copy", "paper-pd", mine).code == 4
    assert load(mine) == copied


def test_a_copy_names_a_schema_that_stands_beside_it_and_fits(umbilical, tmp_path):
    mine = tmp_path / "mine.toml"
    umbilical("presets", "--copy", "paper-dead", mine)
    line = mine.read_text().splitlines()[0]
    schema = json.loads((tmp_path / line.removeprefix("#:schema ")).read_text())
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.validate(tomllib.loads(mine.read_text()), schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**tomllib.loads(mine.read_text()), "duratoin": 1.0}, schema)


def test_examples_are_copied_and_stand_alone(umbilical, tmp_path):
    listed = umbilical("examples").out
    done = umbilical("examples", "--copy", tmp_path / "tries")
    copied = {path.relative_to(tmp_path / "tries").as_posix() for path in (tmp_path / "tries").rglob("*.py")}
    assert done.code == 0
    assert "first_run.py" in copied
    assert copied == {line.split()[0] for line in listed.splitlines() if line.split()[0].endswith(".py")}
    assert umbilical("examples", "--copy", tmp_path / "tries").code == 4


def test_schema_is_json(umbilical):
    assert umbilical("schema").document()["properties"]["duration"]["description"]


def test_doctor_knows_the_packages_and_the_cache(umbilical):
    found = umbilical("doctor", "--json").document()
    assert found["packages"]["numpy"]
    assert Path(found["kernels"]["cache"]).is_dir()
    assert found["machine"]["cores"] >= 1
    assert "numba" in umbilical("doctor").out


def test_doctor_fails_where_a_package_is_missing(umbilical, monkeypatch):
    monkeypatch.setattr("umbilical.cli.doctor.NEEDED", ("numpy", "no-such-package"))
    done = umbilical("doctor")
    assert done.code == 6
    assert "not installed" in done.out


def test_warm_up_compiles_every_loop(umbilical):
    from umbilical.compile import is_warm

    done = umbilical("warm-up")
    assert done.code == 0
    assert [line.split(":")[0] for line in done.out.splitlines()[:-1]] == list(PARTS)
    assert is_warm("run_dry_steps")
    assert is_warm("run_steps")
    assert is_warm("run_held")
    assert is_warm("find_rates")
