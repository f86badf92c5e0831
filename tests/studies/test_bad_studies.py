"""A wrong study is refused before anything runs, with all its problems."""

from __future__ import annotations

import pytest

from tests.support.studies import small_study
from umbilical.errors import FileError, ScenarioError
from umbilical.studies.load import load_study
from umbilical.studies.members import Draws

UNIFORM = {"kind": "uniform", "low": 0.1, "high": 0.2}


def tuning(key):
    """A search over one gain of the arm PD."""
    return {
        "arm": "PD",
        "gains": [{"key": key, "low": 1.0, "high": 2.0}],
        "objectives": [{"metric": "tip_peak"}],
    }


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
        ({"name": "../above"}, "name"),
        ({"name": ".."}, "name"),
        ({"factors.1.key": "seed", "factors.1.relative": False}, "seed"),
        ({"factors.1.key": "faults.1.start", "factors.1.relative": False}, "faults.1.start"),
        ({"factors.1.distribution.step": 3.0}, "payload.mass"),
        ({"arms.2.changes": {"payload": {"mass": 3.0}}}, "arms.2.changes"),
        ({"arms.2.changes": {"faults.1.start": 3.0}}, "arms.2.changes"),
        ({"factors.1.key": "control.law.slope_gain", "factors.1.relative": False}, "arms.1: control.law.slope_gain"),
        ({"factors.1.key": "control.law.velocity_gain", "factors.1.relative": False}, "arms.2: control.law.velocity_"),
        ({"limits": {"grid_loss": 1.0}}, "limits.grid_loss"),
        ({"trajectories.metric": "energy_balance_residual"}, "trajectories.metric"),
        ({"tuning": tuning("payload.mass")}, "tuning.gains payload.mass"),
        ({"tuning": tuning("payload")}, "tuning.gains payload"),
        ({"tuning": tuning("control.law.slope_gain")}, "tuning.gains control.law.slope_gain"),
    ],
)
def test_one_problem_is_named(changes, key):
    data = small_study().to_dict()
    with pytest.raises(ScenarioError) as refused:
        small_study(**{name.replace(".", "__"): value for name, value in changes.items()})
    assert key in " ".join(problem.key for problem in refused.value.problems)
    assert data == small_study().to_dict()


def test_all_problems_come_at_once_and_each_once():
    """Of single fields, across fields, and of what the arms and the draws make of the scenario."""
    with pytest.raises(ScenarioError) as refused:
        small_study(
            members=0,
            factors__2__key="cable.mass",
            factors__2__relative=False,
            factors__3__distribution__kind="gamma",
            arms__1__name="",
            arms__2__changes={"control.law.slop_gain": 1.0},
            limits={"x": 1.0},
            factors__1__distribution__low=9.0,
        )
    keys = [problem.key for problem in refused.value.problems]
    fields = ["arms.1.name", "factors.3.distribution.kind", "members"]
    assert sorted(keys) == sorted([*fields, "arms.2: control.law.slop_gain", "cable.mass", "limits.x", "payload.mass"])


def test_a_bound_has_its_unit():
    with pytest.raises(ScenarioError, match=r"payload\.mass = 9 to 1\.2 kg"):
        small_study(factors__1__distribution__low=9.0)


def test_more_combinations_than_can_be_counted():
    grid = {"kind": "grid", "low": 0.9, "high": 1.1, "count": 10_000}
    keys = [f"environment.payload_force.{k}.amplitude" for k in (2, 3, 4)] + ["payload.mass", "cable.line_density"]
    factors = [{"key": key, "relative": True, "distribution": grid} for key in keys]
    with pytest.raises(ScenarioError, match=r"some 10\^20 combinations"):
        small_study(design="grid", campaigns=[], factors=factors)


def test_a_list_of_the_study_can_be_drawn_from():
    force = [{"kind": "constant", "value": 50.0}]
    factor = {"key": "environment.payload_force.1.value", "relative": True, "distribution": UNIFORM}
    study = small_study(changes={"environment.payload_force": force}, factors=[factor])
    draws = Draws(study)
    assert 5.0 <= draws.scenario(draws.member(1), 0).to_dict()["environment"]["payload_force"][0]["value"] <= 10.0


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

    from umbilical.studies.study import admit_study

    study = small_study()
    assert admit_study(tomllib.loads(study.to_toml()), "again") == study
    assert study.hash == small_study().hash != small_study(seed=1).hash


def test_a_misspelt_key_of_a_relative_factor_is_told_what_was_meant() -> None:
    with pytest.raises(ScenarioError) as refused:
        small_study(factors=[{"key": "payload.mas", "relative": True, "distribution": HALF_TO_DOUBLE}])
    (problem,) = refused.value.problems
    assert problem.key == "payload.mas"
    assert "did you mean 'mass'" in problem.fix


def test_a_relative_factor_of_what_is_no_number_is_refused() -> None:
    with pytest.raises(ScenarioError) as refused:
        small_study(factors=[{"key": "cable.wet_line_density", "relative": True, "distribution": HALF_TO_DOUBLE}])
    assert "a number of the scenario" in refused.value.problems[0].bound


HALF_TO_DOUBLE = {"kind": "uniform", "low": 0.5, "high": 2.0}
