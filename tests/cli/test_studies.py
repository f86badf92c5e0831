"""``sweep``, ``member``, ``tune``, and what ``show`` and ``plot`` make of a study."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from tests.support.studies import small_study
from umbilical import load, simulate
from umbilical.faces import study as study_face
from umbilical.studies.engines import threads
from umbilical.studies.load import load_study
from umbilical.studies.results import open_study
from umbilical.studies.rows import STATUSES
from umbilical.studies.sweep import sweep


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("study") / "small.toml"
    file.write_text(small_study(members=6).to_toml())
    return file


@pytest.fixture(scope="module")
def result(study: Path) -> Path:
    sweep(small_study(members=6), study.parent / "out")
    return study.parent / "out" / "study.nc"


def test_a_sweep_says_what_it_found_and_where(umbilical, study, result, tmp_path):
    done = umbilical("sweep", study, "--out", tmp_path / "out", "--jobs", 2)
    assert (done.code, done.err) == (0, "")
    assert "6 members in 2 arms" in done.out
    assert f"result: {tmp_path / 'out' / 'study.nc'}" in done.out
    assert (tmp_path / "out" / "study.nc").read_bytes() == result.read_bytes()
    again = umbilical("sweep", study, "--out", tmp_path / "out")
    assert again.code == 4
    assert "--resume" in again.err
    assert umbilical("sweep", study, "--out", tmp_path / "out", "--resume").out == done.out
    assert umbilical("sweep", study, "--set", "seed=3", "--out", tmp_path / "out", "--resume").code == 2


def test_json_of_a_sweep_is_one_object(umbilical, study, tmp_path):
    document = umbilical("sweep", study, "--out", tmp_path / "out", "--json").document()
    assert document["members"] == 6
    assert document["endings"]["PD"]["COMPLETED"] == 6
    assert document["metrics"]["tip_peak"]["proposed"]["compared"]["ratio"]["high"] > 0.0
    assert set(document["limits"]) == {"tip_peak"}
    assert document["metrics"]["tip_peak"]["PD"]["median"]["status"] == "finite"
    assert "wide" in document["intervals"]


def test_a_sweep_of_which_nothing_completes_says_so_and_why(umbilical, study, tmp_path):
    damping = '{key = "control.law.damping_gain", distribution = {kind = "choice", values = [1e8]}}'
    words = ["--set", f"factors=[{damping}]", "--set", 'arms=[{name = "one"}]', "--set", "limits={tip_peak = 1.0}"]
    done = umbilical("sweep", study, *words, "--out", tmp_path / "out")
    assert done.code == 7
    assert "6 REFUSED" in done.out
    assert done.out.startswith("paper-robustness: 6 members in 1 arms, NOT ONE COMPLETED in any arm;")
    assert "no member completed" in done.out
    stored = tmp_path / "out" / "study.nc"
    document = umbilical("show", stored, "--json").document()
    assert document["reasons"]["one"][0]["count"] == 6
    assert document["limits"]["tip_peak"]["one"]["status"] == "none"
    refused = umbilical("plot", stored, "--out", tmp_path / "a.png")
    assert (refused.code, "no member completed" in refused.err) == (2, True)


def test_an_arm_that_is_lost_whole_is_in_the_first_line_and_in_the_exit_code(umbilical, study, tmp_path):
    """Diverged members have metrics, and yet nothing was measured."""
    loose = '[{name = "one"}, {name = "runs away", changes = {"environment.payload_force.1.value" = 1e8}}]'
    mass = '[{key = "payload.mass", relative = true, distribution = {kind = "choice", values = [1.0]}}]'
    words = ["--set", f"arms={loose}", "--set", f"factors={mass}", "--set", "campaigns=[]", "--out"]
    done = umbilical("sweep", study, *words, tmp_path / "text")
    assert done.code == 7
    assert "NOT ONE COMPLETED in runs away;" in done.out.splitlines()[0]
    document = umbilical("sweep", study, *words, tmp_path / "json", "--json").document()
    assert (document["verdict"], document["exit_code"]) == ("DOES_NOT_HOLD", 7)
    assert document["none_completed"] == ["runs away"]
    assert document["endings"]["runs away"]["DIVERGED"] == 6
    assert document["metrics"]["tip_peak"]["runs away"]["median"]["status"] == "infinite"


CODE = """
import pathlib, sys
pathlib.Path("imported").touch()
from umbilical import Command
class Spring:
    period = 1e-3
    def start(self, measurement): return None
    def update(self, t, measurement, state): return Command(thrust=-100.0 * measurement.tip_displacement), state
def spring(scenario): return Spring()
"""


@pytest.fixture
def with_code(tmp_path, monkeypatch) -> Path:
    """A study with a controller, in the folder one is in."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.path", [*sys.path])
    monkeypatch.delitem(sys.modules, "springs", raising=False)
    (tmp_path / "springs.py").write_text(CODE)
    tuning = {"arm": "one", "gains": [{"key": "control.law.damping_gain", "low": 1.0, "high": 2.0}], "trials": 1}
    objectives = {"objectives": [{"metric": "tip_peak"}]}
    arms = [{"name": "one", "controller": "springs:spring"}]
    study = small_study(members=2, scenario__duration=0.02, campaigns=[], arms=arms, tuning={**tuning, **objectives})
    (tmp_path / "mine.toml").write_text(study.to_toml())
    return tmp_path / "mine.toml"


@pytest.mark.parametrize("command", ["sweep", "tune"])
def test_code_of_a_study_is_not_imported_unless_it_is_trusted(umbilical, with_code, command):
    done = umbilical(command, with_code, "--out", "out")
    assert done.code == 2
    assert "--trust" in done.err
    for other in ("show", "member"):
        assert umbilical(other, with_code, *([1] if other == "member" else [])).code == 0
    assert not Path("imported").exists()
    assert umbilical(command, with_code, "--out", "out", "--trust", "--jobs", 1).code == 0
    assert Path("imported").exists()


def test_code_is_never_imported_from_a_result(umbilical, with_code):
    sweep(load_study(with_code), "out", trust=True, engine=threads(1))
    Path("imported").unlink()
    del sys.modules["springs"]
    for command in ("sweep", "tune"):
        done = umbilical(command, "out/study.nc", "--trust", "--out", "again")
        assert (done.code, "never imported from a result" in done.err) == (2, True)
    assert umbilical("show", "out/study.nc").code == umbilical("member", "out/study.nc", 1).code == 0
    assert umbilical("plot", "out/study.nc", "--out", "a.png").code == 0
    assert not Path("imported").exists()


def test_what_is_asked_of_a_result_is_in_its_json_too(umbilical, result):
    shown = umbilical("show", result, "--json", "--metric", "mid_rms", "--sensitivity", "tip_peak").document()
    assert set(shown["metrics"]) == {"mid_rms"}
    assert shown["sensitivity"]["metric"] == "tip_peak"
    assert "too few" in shown["sensitivity"]["arms"]["PD"]["reason"]


def test_null_of_a_run_that_diverged_is_told_from_null_of_none(result):
    found = open_study(result)
    found.data["status"][:4, 0] = STATUSES.index("DIVERGED")
    found.data["status"][:, 1] = STATUSES.index("REFUSED")
    metrics = study_face.FACE.document(found)["metrics"]["tip_peak"]
    assert [metrics[arm]["q95"]["status"] for arm in found.arms] == ["infinite", "none"]
    assert metrics["PD"]["median"]["status"] == "infinite"


def test_every_problem_of_a_study_comes_as_data(umbilical, study):
    done = umbilical("sweep", study, "--set", "members=0", "--set", "design=halton", "--json")
    assert done.code == 2
    assert {problem["key"] for problem in done.document()["problems"]} == {"members", "design"}


def test_the_size_of_complete_runs_is_told_before_the_start(umbilical, study, tmp_path):
    done = umbilical("sweep", study, "--set", "trajectories.keep=all", "--set", "members=2", "--out", tmp_path / "out")
    assert "MB will be stored" in done.err
    assert len(list((tmp_path / "out" / "runs").iterdir())) == 4


def test_a_study_is_checked_before_a_cluster_is_asked(umbilical, study, tmp_path):
    own = tmp_path / "own.toml"
    own.write_text(Path(study).read_text() + '\n[[arms]]\nname = "own"\ncontroller = "nobody:nothing"\n')
    done = umbilical("sweep", own, "--dask", "not-an-address", "--out", tmp_path / "out")
    assert done.code == 2
    assert "--trust" in done.err
    done = umbilical("sweep", study, "--dask", "not-an-address", "--out", tmp_path / "out")
    assert done.code == 2
    assert "there is no Dask scheduler" in done.err
    assert not (tmp_path / "out").exists()


def test_two_engines_at_once_are_refused(umbilical, study, tmp_path):
    assert umbilical("sweep", study, "--dask", "local", "--processes", "--out", tmp_path / "out").code == 2
    assert not (tmp_path / "out").exists()


def test_a_member_can_be_run_alone(umbilical, result, tmp_path):
    done = umbilical("member", result, 4, "--arm", "proposed", "--out", tmp_path / "m.toml")
    assert done.code == 0
    found = umbilical("show", result, "--json").document()
    assert found["members"] == 6
    alone = simulate(load(tmp_path / "m.toml")).metrics["tip_peak"]
    import xarray

    row = xarray.open_dataset(result, engine="h5netcdf")["tip_peak"].sel(member=4, arm="proposed")
    assert alone == float(row)
    assert umbilical("member", result, 7).code == 2
    assert umbilical("member", result, 1, "--arm", "PDD").code == 2


def test_show_reads_studies_and_their_results(umbilical, study, result):
    assert "6 members (sobol) in 2 arms of 'paper'" in umbilical("show", study).out
    assert "payload.mass" in umbilical("show", "paper-robustness").out
    assert umbilical("show", "fault-map", "--json").document()["study"]["name"] == "fault-map"
    shown = umbilical("show", result, "--metric", "mid_rms", "--against", "proposed")
    assert "mid_rms" in shown.out
    assert "against 'proposed', draw by draw" in shown.out
    assert "difference [m]" in shown.out
    assert shown.out.count(" to ") >= 6  # median, quantile and comparison of an arm have their intervals
    assert umbilical("show", result, "--metric", "mid").code == 2
    assert umbilical("show", result, "--against", "nobody").code == 2
    assert umbilical("show", "paper", "--metric", "mid_rms").code == 2
    assert "too few" in umbilical("show", result, "--sensitivity", "tip_peak").out


@pytest.mark.parametrize("kind", ["overview", "distribution", "comparison", "map"])
def test_plot_draws_studies(umbilical, result, tmp_path, kind):
    target = tmp_path / f"{kind}.png"
    assert umbilical("plot", result, "--kind", kind, "--metric", "tip_rms", "--out", target).code == 0
    assert target.read_bytes().startswith(b"\x89PNG")


def test_a_map_is_of_what_one_asks_for(umbilical, result, tmp_path):
    picture = ["--out", tmp_path / "a.png", "--force"]
    asked = ["plot", result, "--kind", "map", "--x", "fault.kind", "--y", "fault.motor", "--arm", "proposed"]
    assert umbilical(*asked, *picture).code == 0
    assert "is not drawn" in umbilical("plot", result, "--kind", "map", "--x", "fault.knd", *picture).err
    assert "there are the arms" in umbilical("plot", result, "--kind", "map", "--arm", "P", *picture).err
    assert "only for --kind map" in umbilical("plot", result, "--x", "fault.kind", *picture).err


def test_plot_tells_runs_from_studies(umbilical, result, stored, tmp_path):
    wrong = umbilical("plot", result, "--kind", "tip", "--out", tmp_path / "a.png")
    assert (wrong.code, "of a study there are" in wrong.err) == (2, True)
    other = umbilical("plot", stored["free"], "--kind", "map", "--out", tmp_path / "a.png")
    assert (other.code, "of a run there are" in other.err) == (2, True)
    assert umbilical("plot", result, "--metric", "y", "--out", tmp_path / "a.png").code == 2
    assert umbilical("plot", result, "--kind", "sensitivity", "--out", tmp_path / "a.png").code == 2


def test_presets_list_print_and_copy_studies(umbilical, tmp_path):
    assert "paper-robustness" in umbilical("presets").out
    assert 'name = "fault-map"' in umbilical("presets", "fault-map").out
    copied = umbilical("presets", "--copy", "gain-tuning", tmp_path / "mine.toml")
    assert "umbilical sweep" in copied.out
    assert umbilical("show", tmp_path / "mine.toml").code == 0


def test_tune_ends_with_a_scenario_to_run(umbilical, tmp_path):
    small = ["scenario.duration=0.3", "scenario.grid.elements=8", "members=2", "tuning.trials=5"]
    small += ['tuning.constraints=["certificate"]']
    changes = [word for change in small for word in ("--set", change)]
    done = umbilical("tune", "gain-tuning", *changes, "--out", tmp_path / "out", "--json")
    assert done.code == 0
    document = done.document()
    assert document["front"]
    assert json.loads((tmp_path / "out" / "tuning.json").read_text())["trials"] == document["trials"]
    assert umbilical("run", tmp_path / "out" / "tuned-1.toml").code == 0
    assert document["broken"].keys() == {"admitted", "certificate", "completes"}
    assert len(list((tmp_path / "out").glob("tuned-*.toml"))) == len(document["front"])
    picture = ["--plot", tmp_path / "front.png"]
    again = umbilical("tune", "gain-tuning", *changes, "--out", tmp_path / "out", "--resume", *picture)
    assert (tmp_path / "front.png").read_bytes().startswith(b"\x89PNG")
    assert "no other trial beats these" in again.out
    assert umbilical("tune", "fault-map", "--out", tmp_path / "none").code == 2
    assert not (tmp_path / "none").exists()


def test_a_search_that_finds_nothing_says_what_was_broken(umbilical, tmp_path):
    small = ["scenario.duration=0.3", "scenario.grid.elements=8", "members=2", "tuning.trials=2"]
    small += ["tuning.gains.1.key=control.law.damping_gain", "tuning.gains.1.low=6e5", "tuning.gains.1.high=1e6"]
    changes = [word for change in small for word in ("--set", change)]
    done = umbilical("tune", "gain-tuning", *changes, "--out", tmp_path / "out")
    assert done.code == 7
    assert "admitted 2" in done.out
    assert "none is left to choose" in done.out


def test_a_scenario_command_says_where_a_study_belongs(umbilical, study):
    for source in (study, "gain-tuning"):
        done = umbilical("certify", source)
        assert done.code == 2
        assert f"{source}: this is a study" in done.err
