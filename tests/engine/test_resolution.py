"""A grid that a run chooses: right against four times its elements, told, and fixed in the result."""

from types import SimpleNamespace

import pytest

import umbilical
from umbilical.engine import resolution
from umbilical.engine.resolution import GRIDS, choose_grid, peak_error, with_grid
from umbilical.engine.simulate import measure
from umbilical.errors import ScenarioError
from umbilical.library import preset_names
from umbilical.studies.load import load_study

SHORT = {"duration": 8.0, "winch": {"law": "constant", "length": 300.0}}
STRINGS = [name for name in preset_names() if umbilical.load(name).model == "string"][::3]
"""A third of the presets of the string; all were tried once."""
LONGEST = 100.0
"""s of a preset that are run."""


def peaks(scenario, elements, step):
    metrics = measure(with_grid(scenario, elements, step)).metrics
    return {name: metrics[name] for name in resolution.WATCHED}


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_the_grid_is_right_against_four_times_its_elements(tolerance):
    scenario = umbilical.load("crosscheck-none", SHORT | {"grid.tolerance": tolerance})
    choice = choose_grid(scenario, measure)
    assert choice.reached
    coarse, fine = (peaks(scenario, elements, choice.step) for elements in (choice.elements, 4 * choice.elements))
    assert min(fine.values()) > 0.1
    assert peak_error(coarse, fine) == pytest.approx(choice.estimate, abs=0.3 * tolerance)
    assert peak_error(coarse, fine) <= tolerance


def test_a_run_says_its_grid_and_reruns_without_choosing_again():
    run = umbilical.simulate(umbilical.load("crosscheck-none", SHORT | {"grid.elements": "auto"}))
    assert run.notices[0].startswith("grid: ")
    assert run.scenario.grid.tolerance is None
    again = umbilical.simulate(run.scenario)
    assert (again["displacement"].values == run["displacement"].values).all()
    assert not any(notice.startswith("grid: ") for notice in again.notices)


def test_a_front_that_no_grid_resolves_is_told(monkeypatch):
    monkeypatch.setattr(resolution, "GRIDS", (4, 8, 16))
    run = umbilical.simulate(umbilical.load("paper-stuck", {"duration": 14.0, "grid.tolerance": 1e-5}))
    assert run.scenario.grid.elements == 4
    assert "misses the tolerance of 1e-05" in run.notices[0]


def test_the_step_is_halved_until_it_does_not_matter():
    scenario = umbilical.load("crosscheck-none", SHORT | {"grid.elements": "auto"})

    def known(fixed):
        assert fixed.grid.tolerance is None
        return SimpleNamespace(
            status=umbilical.Status.COMPLETED, metrics={"tip_peak": 1.0 + fixed.grid.step, "mid_peak": 0.0}
        )

    choice = choose_grid(scenario, known)
    assert choice.step == pytest.approx(5e-4)
    assert choice.elements == GRIDS[0]


@pytest.mark.parametrize(("least", "chosen"), [(17, 24), (24, 24), (25, 32), (3, 4), (5, 6), (200, 128)])
def test_three_quarters_of_a_grid_do_where_they_do(least, chosen):
    """Peaks are wrong below ``least`` elements; the finest that is compared with more is 128."""
    scenario = umbilical.load("crosscheck-none", SHORT | {"grid.elements": "auto"})

    def known(fixed):
        error = 0.0 if fixed.grid.elements >= least else 1.0 / fixed.grid.elements
        return SimpleNamespace(status=umbilical.Status.COMPLETED, metrics={"tip_peak": 1.0 + error, "mid_peak": 0.0})

    choice = choose_grid(scenario, known)
    assert choice.elements == chosen
    assert choice.reached == (chosen >= least)
    assert choice.finest >= 4 * chosen


def test_runs_that_end_otherwise_are_apart():
    assert peak_error({"COMPLETED tip_peak": 1.0}, {"DIVERGED tip_peak": 1.0}) == float("inf")
    assert peak_error({"tip_peak": 1e-12}, {"tip_peak": 2e-12}) == 0.0


def test_a_study_takes_one_grid_for_all_its_members():
    study = load_study("fault-map").replace(
        {"scenario.duration": 0.2, "members": 2, "changes": {"grid.elements": "auto", "grid.tolerance": 1e-2}}
    )
    found = umbilical.sweep(study).study
    assert found.scenario.grid.tolerance is None
    assert found.changes["grid.elements"] in {*GRIDS, *(3 * elements // 4 for elements in GRIDS)}
    assert "grid.tolerance" not in found.changes


def test_a_rope_has_no_grid_to_choose():
    with pytest.raises(ScenarioError, match=r"grid.tolerance = 0.001"):
        umbilical.load("observation-300m", {"grid.elements": "auto"})


@pytest.mark.slow
@pytest.mark.parametrize("name", STRINGS)
def test_every_preset_is_right_against_four_times_its_grid(name):
    scenario = umbilical.load(name)
    changes = {"grid.elements": "auto", "duration": min(scenario.duration, LONGEST)}
    scenario = scenario.replace(changes)
    choice = choose_grid(scenario, measure)
    assert choice.reached
    coarse = peaks(scenario, choice.elements, choice.step)
    assert peak_error(coarse, peaks(scenario, 4 * choice.elements, choice.step / 4)) <= 1.05 * choice.tolerance
