"""A wrong study is refused before anything runs, with all its problems."""

from __future__ import annotations

import pytest

from tests.support.studies import small_study
from umbilical.errors import FileError, ScenarioError
from umbilical.studies.load import load_study

UNIFORM = {"kind": "uniform", "low": 0.1, "high": 0.2}


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"members": 0}, "members"),
        ({"members": -3}, "members"),
        ({"design": "halton"}, "design"),
        ({"seed": 1.5}, "seed"),
        ({"factors.1.distribution.low": float("nan")}, "factors.1.distribution.low"),
        ({"factors.1.distribution.low": 3.0}, "payload.mass"),
        ({"factors.1.distribution.kind": "gamma"}, "factors.1.distribution.kind"),
        ({"factors.1.key": "payload.mas"}, "payload.mas"),
        ({"factors.1.key": "payload.mas", "factors.1.relative": False}, "payload.mas"),
        ({"factors.2.key": "payload.mass"}, "factors"),
        ({"arms.2.name": "PD"}, "arms"),
        ({"arms": []}, "arms"),
        ({"arms.2.changes": {"control.law.slope_gain": -1.0}}, "arms.2: control.law.slope_gain"),
        ({"arms.2.changes": {"control.law.slop_gain": 1.0}}, "arms.2: control.law.slop_gain"),
        ({"arms.2.changes": {"payload.mass": 3.0}}, "arms.2.changes"),
        ({"arms.2.changes": {"faults": []}}, "arms.2.changes"),
        ({"campaigns.1.kinds": ["melted"]}, "campaigns.1.kinds.1"),
        ({"campaigns.1.motors": [7]}, "campaigns.1.motors"),
        ({"campaigns.1.value": None}, "campaigns.1.value"),
        ({"limits": {"tip_peek": 1.0}}, "limits.tip_peek"),
        ({"trajectories.metric": "y"}, "trajectories.metric"),
        ({"design": "grid"}, "payload.mass"),
        ({"colour": "red"}, "colour"),
        ({"scenario.payload.mass": -1.0}, "scenario.payload.mass"),
        ({"scenario.duration": 0.0015}, "duration"),
    ],
)
def test_one_problem_is_named(changes, key):
    data = small_study().to_dict()
    with pytest.raises(ScenarioError) as refused:
        small_study(**{name.replace(".", "__"): value for name, value in changes.items()})
    assert key in " ".join(problem.key for problem in refused.value.problems)
    assert data == small_study().to_dict()


def test_all_problems_come_at_once():
    with pytest.raises(ScenarioError) as refused:
        small_study(arms__2__name="PD", limits={"x": 1.0}, factors__1__distribution__low=9.0)
    assert {"arms", "limits.x", "payload.mass"} <= {problem.key for problem in refused.value.problems}


@pytest.mark.parametrize("text", ["", "members = 3", 'scenario = "papr"', "scenario = 3", "scenario = ["])
def test_files_that_are_no_study(tmp_path, text):
    (tmp_path / "a.toml").write_text(text)
    with pytest.raises((FileError, ScenarioError), match=r"a\.toml|papr"):
        load_study(tmp_path / "a.toml")
    with pytest.raises(FileError, match="did you mean 'fault-map'"):
        load_study("fault-mop")


def test_a_scenario_beside_the_study_is_found(tmp_path):
    (tmp_path / "mine.toml").write_text('extends = "paper"\nname = "mine"\nduration = 5.0\n')
    (tmp_path / "study.toml").write_text('name = "s"\nscenario = "mine.toml"\n')
    assert load_study(tmp_path / "study.toml").scenario.duration == 5.0


def test_text_round_trip():
    import tomllib

    from umbilical.studies.load import admit_study

    study = small_study()
    assert admit_study(tomllib.loads(study.to_toml()), "again") == study
    assert study.hash == small_study().hash != small_study(seed=1).hash
