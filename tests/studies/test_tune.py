"""Searches find known optima, keep their conditions, and go on where they were cut."""

from __future__ import annotations

import shutil

import pytest

from tests.support.studies import small_study
from umbilical import load
from umbilical.errors import ScenarioError
from umbilical.studies import engines, tune
from umbilical.studies.constraints import CONSTRAINTS
from umbilical.studies.load import load_study
from umbilical.studies.search import TrialVerdict, front, search
from umbilical.studies.study import Study

GAIN = [{"key": "control.disturbance_observer.gain", "low": 1.0, "high": 20.0}]
TUNING = {
    "arm": "PD",
    "trials": 12,
    "gains": [{"key": "control.law.position_gain", "low": 10.0, "high": 1000.0, "scale": "log"}],
    "objectives": [{"metric": "tip_peak", "statistic": "worst"}],
}


def tuned_study(**changes: object) -> Study:
    return small_study(members=3, scenario__duration=0.5, tuning=TUNING | changes)


def test_a_known_minimum_is_found():
    tried = []

    def bowl(point):
        tried.append(((point[0] - 0.3) ** 2 + (point[1] - 0.8) ** 2, point))
        return TrialVerdict((tried[-1][0],), ())

    search(bowl, 2, 1, 120, 1)
    assert min(tried)[1] == pytest.approx((0.3, 0.8), abs=0.1)
    assert len(tried) == 120


def test_a_condition_moves_the_minimum_to_its_border():
    found = []

    def judge(point):
        verdict = TrialVerdict((point[0],), (0.5 - point[0],))
        found.append((point[0], verdict))
        return verdict

    search(judge, 1, 1, 80, 1)
    best = front([verdict for _, verdict in found])
    assert 0.5 <= found[best[0]][0] < 0.56
    assert min(x for x, _ in found) < 0.5  # it looked there, and what it saw does not count


def test_two_objectives_leave_a_front():
    """f = x^2, (x - 1)^2: every x from 0 to 1 is on the front."""
    found = []

    def judge(point):
        verdict = TrialVerdict((1e-3 + point[0] ** 2, 1e-3 + (point[0] - 1.0) ** 2), ())
        found.append(verdict)
        return verdict

    search(judge, 1, 2, 80, 1)
    chosen = [found[k].values for k in front(found)]
    assert chosen == sorted(chosen)
    assert [b for _, b in chosen] == sorted((b for _, b in chosen), reverse=True)
    assert chosen[0][0] < 0.05
    assert chosen[-1][1] < 0.05


def test_a_stiffer_spring_keeps_the_payload_nearer():
    found = tune.tune(tuned_study(), engine=engines.threads(2))
    gains = [trial.gains["control.law.position_gain"] for trial in found.trials]
    assert len(found.front) == 1
    assert found.front[0].gains["control.law.position_gain"] == max(gains)


def test_cut_and_resumed_a_search_ends_with_the_same_bytes(tmp_path, monkeypatch):
    study = tuned_study()
    tune.tune(study, tmp_path / "whole")
    text = (tmp_path / "whole" / "journal.txt").read_bytes()
    (tmp_path / "cut").mkdir()
    shutil.copy(tmp_path / "whole" / "manifest.json", tmp_path / "cut")
    (tmp_path / "cut" / "journal.txt").write_bytes(text[: int(0.6 * len(text))])
    calls, judge = [], tune.judge_gains
    monkeypatch.setattr(tune, "judge_gains", lambda *a: calls.append(a) or judge(*a))
    tune.tune(study, tmp_path / "cut", resume=True)
    assert 0 < len(calls) < 12
    for file in ("tuning.json", "tuned-1.toml"):
        assert (tmp_path / "cut" / file).read_bytes() == (tmp_path / "whole" / file).read_bytes()


def test_conditions_are_asked_first_and_named(monkeypatch):
    """Gains above 100 are forbidden: no member runs with them, and none is chosen."""
    study = tuned_study(constraints=["soft"])
    seen, run = [], tune.in_memory
    monkeypatch.setattr(tune, "in_memory", lambda d, e: seen.append(d.study.arms[0].changes) or run(d, e))
    soft = {"soft": lambda scenario: scenario.control.law.position_gain - 100.0}
    found = tune.tune(study, constraints=soft, engine=engines.threads(2))
    assert found.conditions == ("admitted", "soft", "completes")
    assert seen
    assert all(changes["control.law.position_gain"] <= 100.0 for changes in seen)
    assert len(seen) < len(found.trials)
    assert found.front[0].gains["control.law.position_gain"] <= 100.0


def test_gains_that_are_refused_are_no_answer():
    """Above 5e5 N s/m the sampled velocity gain overshoots within a period; admission says so."""
    gains = [{"key": "control.law.velocity_gain", "low": 1.0, "high": 5e6, "scale": "log"}]
    found = tune.tune(tuned_study(gains=gains, trials=20), engine=engines.threads(2))
    refused = [trial for trial in found.trials if trial.verdict.violations[0] > 0.0]
    assert refused
    assert found.broken["admitted"] == len(refused)
    assert all(trial.gains["control.law.velocity_gain"] >= 5e5 for trial in refused)
    assert found.front[0].gains["control.law.velocity_gain"] < 5e5


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"control.law.kind": "boundary", "control.law.damping_gain": 5000.0, "control.law.rates": "observer"},
        {"control.allocation.method": "adaptive", "control.allocation.rates": [0.1, 100.0, 100.0]}
        | {"control.allocation.leak": 1e-3, "control.allocation.initial": [0.25, 0.0, 0.0]},
        {"control.slope_observer": None, "control.law.kind": "pd", "control.law.velocity": "observer"}
        | {"control.law.position_gain": 100.0, "control.law.velocity_gain": 10.0},
        {"motors.1.inertia": 0.6},
    ],
)
def test_the_patch_is_the_scenario_that_was_tuned(tmp_path, changes):
    """The study's own changes are in it, and those of the arm."""
    study = load_study("gain-tuning")
    own = {key: value for key, value in study.changes.items() if key.startswith(("control.nominal", "sensors"))}
    study = study.replace({"changes": own, "arms.1.changes": changes, "tuning.gains": GAIN})
    patch = tune.to_patch(study, {"control.disturbance_observer.gain": 2.5})
    (tmp_path / "tuned.toml").write_text(patch)
    assert study.changes
    whole = "control.slope_observer" in changes  # no patch can take a section away
    description = ("" if whole else "Changed from paper. ") + load("paper").description
    expected = {**study.changes, **changes, "control.disturbance_observer.gain": 2.5, "name": "paper-tuned"}
    assert load(tmp_path / "tuned.toml") == load("paper", {**expected, "description": description})
    assert ("extends" in patch) is not whole


def test_a_patch_of_a_preset_says_only_what_differs(tmp_path):
    text = tune.to_patch(load_study("gain-tuning"), {"control.law.slope_gain": 2.5})
    assert 'extends = "paper"' in text
    assert "line_density" not in text


def test_a_patch_of_a_list_and_of_a_changed_scenario(tmp_path):
    study = tuned_study()
    (tmp_path / "tuned.toml").write_text(tune.to_patch(study, {"motors.2.thrust_coefficient": 0.9}))
    tuned = load(tmp_path / "tuned.toml")
    assert [motor.thrust_coefficient for motor in tuned.motors] == [1.2, 0.9]
    assert (tuned.duration, tuned.control.law.kind) == (0.5, "pd")


def test_what_tuning_lacks_is_said():
    with pytest.raises(ScenarioError, match="tuning needs gains"):
        tune.tune(small_study())
    with pytest.raises(ScenarioError, match="no such condition"):
        tune.tune(tuned_study(constraints=["beauty"]))
    with pytest.raises(ScenarioError, match=r"tuning\.arm"):
        tuned_study(arm="PDD")


def test_margins_are_a_condition():
    """The paper's loop is stable and lacks margin; with slow observers it is unstable, and no law has no loop."""
    paper = load("paper")
    assert 0.0 < CONSTRAINTS["margins"](paper) < 1.0
    lame = {"control.velocity_observer.time_constant": 0.05, "control.disturbance_observer.gain": 200.0}
    assert CONSTRAINTS["margins"](paper.replace(lame)) >= 1.0
    assert CONSTRAINTS["margins"](load("paper-none")) > 0.0


def test_the_certificate_is_a_condition():
    """Hauling in, a beta of 0.01 cannot be certified and one of 20 can; PD never."""
    hauling = load("haul-in", {"control.law.slope_gain": 20.0})
    assert CONSTRAINTS["certificate"](hauling) < 0.0
    assert CONSTRAINTS["certificate"](hauling.replace({"control.law.slope_gain": 0.01})) > 0.0
    assert CONSTRAINTS["certificate"](load("paper-pd")) > 0.0
