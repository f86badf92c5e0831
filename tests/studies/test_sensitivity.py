"""Influences against functions whose indices are known."""

from __future__ import annotations

import numpy as np
import pytest
import xarray

from umbilical.studies.load import load_study
from umbilical.studies.members import Draws
from umbilical.studies.results import StudyResult
from umbilical.studies.rows import STATUSES
from umbilical.studies.sensitivity import rank

UNIFORM = {"kind": "uniform", "low": 0.5, "high": 1.5}
GRID = {"kind": "grid", "low": 0.5, "high": 1.5, "count": 8}
KEYS = ("payload.mass", "motors.1.thrust_coefficient", "motors.2.thrust_coefficient")


def made(design: str, function, members: int = 600) -> StudyResult:
    """A result whose metric is a function of the unit cube."""
    law = GRID if design == "grid" else UNIFORM
    factors = [{"key": key, "relative": True, "distribution": law} for key in KEYS]
    study = load_study("fault-map").replace(
        {"campaigns": [], "design": design, "members": members, "factors": factors, "limits": {}}
    )
    points = Draws(study).points
    data = xarray.Dataset(
        {
            "point": (("member", "variable"), points),
            "tip_peak": (("member", "arm"), function(points)[:, None]),
            "status": (("member", "arm"), np.zeros((len(points), 1), dtype=np.int8)),
        },
        {"arm": ["one"], "variable": list(KEYS)},
    )
    return StudyResult(data, study)


def additive(x: np.ndarray) -> np.ndarray:
    """Indices 16/21, 4/21, 1/21: variances of 4 x1, 2 x2 and x3."""
    return 4.0 * x[:, 0] + 2.0 * x[:, 1] + x[:, 2]


@pytest.mark.parametrize(("design", "within"), [("grid", 1e-9), ("saltelli", 0.08), ("sobol", 0.08), ("random", 0.1)])
def test_first_indices_of_a_sum(design, within):
    found = {i.name: i.first for i in rank(made(design, additive), "tip_peak", "one")}
    assert list(found) == list(KEYS)
    assert list(found.values()) == pytest.approx([16 / 21, 4 / 21, 1 / 21], abs=within)


def test_total_indices_tell_company_from_working_alone():
    """(x1 - 1/2)(x2 - 1/2): alone nothing, together everything."""
    together = made("saltelli", lambda x: (x[:, 0] - 0.5) * (x[:, 1] - 0.5), 5000)
    found = {i.name: i for i in rank(together, "tip_peak", "one")}
    assert found[KEYS[0]].first == pytest.approx(0.0, abs=0.1)
    assert found[KEYS[0]].total == pytest.approx(1.0, abs=0.1)
    assert found[KEYS[2]].total == pytest.approx(0.0, abs=0.01)


def test_morris_effects_are_the_slopes():
    found = {i.name: i for i in rank(made("morris", additive), "tip_peak", "one")}
    assert [found[key].first for key in KEYS] == pytest.approx([4.0, 2.0, 1.0])
    assert found[KEYS[0]].total == pytest.approx(0.0, abs=1e-9)


def refused(result: StudyResult, count: int) -> StudyResult:
    """The same with the first members refused, whose values would be the largest."""
    result.data["status"][:count] = STATUSES.index("REFUSED")
    return result


def test_refused_members_are_left_out():
    found = rank(refused(made("sobol", additive), 60), "tip_peak", "one")
    assert [i.first for i in found] == pytest.approx([16 / 21, 4 / 21, 1 / 21], abs=0.1)


@pytest.mark.parametrize("design", ["grid", "saltelli", "morris"])
def test_a_design_that_needs_all_members_is_not_judged_from_some(design):
    with pytest.raises(ValueError, match="2 members have no tip_peak"):
        rank(refused(made(design, additive), 2), "tip_peak", "one")


def test_a_grid_is_exact():
    assert all(np.isnan(i.first_error) for i in rank(made("grid", additive), "tip_peak", "one"))


def test_too_few_members_are_refused():
    with pytest.raises(ValueError, match="too few"):
        rank(made("sobol", additive, 32), "tip_peak", "one")
