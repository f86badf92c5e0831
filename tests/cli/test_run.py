"""``umbilical run``: what it says, what it stores, how it ends."""

from __future__ import annotations

import json

import pytest
import xarray

from umbilical import open_run
from umbilical.run import Status

SHORT = ("--set", "duration=1")
UNSTABLE = ("--set", "control.law.slope_gain=60", "--set", "control.disturbance_observer.gain=100")


def test_text_has_the_metrics_the_assumptions_and_what_was_not_stored(umbilical):
    done = umbilical("run", "paper", *SHORT)
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("paper: COMPLETED at t = 1 s")
    assert "tip_peak" in done.out
    assert "entries that no source gives; `umbilical show paper`" in done.out
    assert "nothing was stored" in done.out


def test_slope_and_tension_are_told_before_the_first_step(umbilical, monkeypatch):
    done = umbilical("run", "work-class-1000m-current", "--set", "duration=0.5", "--json")
    assert "static slope up to 0.02" in done.err
    assert "tension 35000 to 75456.4 N" in done.err
    statics = done.document()["statics"]
    assert (
        statics == umbilical("run", "work-class-1000m-current", "--set", "duration=0.5", "--json").document()["statics"]
    )
    monkeypatch.setattr("umbilical.cli.progress.simulate_visibly", lambda *_: pytest.fail("told after it"))
    with pytest.raises(pytest.fail.Exception, match="told after it"):
        umbilical("run", "work-class-1000m-current")
    shown = umbilical("show", "work-class-1000m-current")
    assert "before the first step: static slope up to 0.0253 at x/l = 0" in shown.out
    assert umbilical("show", "observation-300m", "--json").document()["statics"] is None


def test_json_is_one_object_with_the_promised_keys(umbilical):
    document = umbilical("run", "paper", *SHORT, "--json").document()
    assert document["status"] == "COMPLETED"
    assert document["metrics"]["tip_peak"] > 0.0
    assert document["timing"]["simulate_s"] > 0.0
    assert len(document["scenario_hash"]) == 64
    assert {"reason", "notices", "assumed", "files"} <= document.keys()


def test_a_result_is_stored_and_its_scenario_run_again(umbilical, tmp_path):
    result = tmp_path / "a.nc"
    first = umbilical("run", "crosscheck-none", *SHORT, "--out", result)
    assert first.code == 0
    assert f"result: {result}" in first.out
    assert xarray.open_dataset(result, engine="h5netcdf")["tip_displacement"].attrs["units"] == "m"
    again = umbilical("run", result, "--out", tmp_path / "b.nc")
    assert again.code == 0
    assert (tmp_path / "b.nc").read_bytes() == result.read_bytes()


def test_a_file_of_ones_own_with_a_change(umbilical, tmp_path):
    mine = tmp_path / "mine.toml"
    assert umbilical("presets", "--copy", "crosscheck-none", mine).code == 0
    heavy = umbilical("run", mine, *SHORT, "--set", "payload.mass=5000", "--json").document()["metrics"]["tip_peak"]
    light = umbilical("run", mine, *SHORT, "--json").document()["metrics"]["tip_peak"]
    assert heavy < 0.2 * light


def test_a_diverged_run_is_kept_drawn_and_has_its_own_exit_code(umbilical, tmp_path):
    result, picture = tmp_path / "wild.nc", tmp_path / "wild.png"
    done = umbilical("run", "paper", *SHORT, *UNSTABLE, "--out", result, "--plot", picture, "--json")
    assert done.code == Status.DIVERGED.exit_code
    document = done.document()
    assert document["status"] == "DIVERGED"
    assert "slope" in document["reason"]
    assert 0.0 < document["end_time"] < 1.0
    assert open_run(result).status is Status.DIVERGED
    assert picture.exists()


@pytest.mark.parametrize("stretch", [0, 2])
def test_an_interrupted_run_keeps_what_it_has(umbilical, tmp_path, monkeypatch, stretch):
    from umbilical.engine import simulate

    calls, make_stretch = [], simulate.stretch

    def interrupted(*arguments):
        calls.append(arguments)
        if len(calls) > stretch:
            raise KeyboardInterrupt
        return make_stretch(*arguments)

    monkeypatch.setattr(simulate, "stretch", interrupted)
    result, picture = tmp_path / "part.nc", tmp_path / "part.png"
    done = umbilical("run", "crosscheck-none", "--out", result, "--plot", picture, "--json")
    assert done.code == 130
    assert done.document()["status"] == "INTERRUPTED"
    kept = open_run(result)
    assert (kept["time"].size > 1) == picture.exists() == (stretch > 0)
    assert ("not drawn" in done.err) == (stretch == 0)


def test_files_are_refused_before_the_work(umbilical, tmp_path, monkeypatch):
    monkeypatch.setattr("umbilical.cli.progress.simulate_visibly", lambda scenario: pytest.fail("it simulated"))
    (tmp_path / "there.nc").write_text("mine")
    for option, name, reason in [
        ("--out", "there.nc", "exists already"),
        ("--out", "a.csv", "must end with .nc"),
        ("--out", "none/a.nc", "there is no folder"),
        ("--plot", "a.bmp", "must end with .png or .pdf or .svg"),
    ]:
        done = umbilical("run", "paper", option, tmp_path / name)
        assert (done.code, done.out) == (4, "")
        assert reason in done.err
    assert (tmp_path / "there.nc").read_text() == "mine"


def test_force_replaces_a_file(umbilical, tmp_path):
    (tmp_path / "there.nc").write_text("old")
    done = umbilical("run", "crosscheck-none", *SHORT, "--out", tmp_path / "there.nc", "--force")
    assert done.code == 0
    assert open_run(tmp_path / "there.nc").status is Status.COMPLETED


def test_json_numbers_are_never_nan(umbilical, monkeypatch):
    monkeypatch.setattr("umbilical.run.Run.metrics", {"tip_peak": float("nan"), "tip_rms": float("inf")})
    metrics = umbilical("run", "crosscheck-none", *SHORT, "--json").document()["metrics"]
    assert metrics == {"tip_peak": None, "tip_rms": None}


def test_problems_come_all_at_once_and_as_data(umbilical):
    changes = ["cable.lenght=3", "payload.mass=-1", "nonsense"]
    arguments = [word for change in changes for word in ("--set", change)]
    done = umbilical("run", "paper", *arguments, "--json")
    assert done.code == 2
    document = done.document()
    assert document["status"] == "REFUSED"
    assert {problem["key"] for problem in document["problems"]} == {"cable.lenght", "payload.mass", "nonsense"}
    assert all(set(p) == {"key", "value", "bound", "reason", "fix"} and all(p.values()) for p in document["problems"])
    assert all(problem["key"] in done.err for problem in document["problems"])
    assert "Traceback" not in done.err


def test_json_of_a_refusal_has_the_keys_of_a_run(umbilical):
    refused = umbilical("run", "no-such-preset", "--json").document()
    assert {"status", "reason", "metrics", "timing", "scenario_hash", "notices"} <= refused.keys()
    assert "no-such-preset" in refused["error"]
    assert json.dumps(refused["problems"]) == "[]"
