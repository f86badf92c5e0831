"""What a result says of itself, and how sure it claims to be."""

from __future__ import annotations

import numpy as np
import pytest
import xarray

from tests.support.studies import small_study
from umbilical.studies import statistics
from umbilical.studies.results import StudyResult


def made(design: str = "random", **metrics: list[float]) -> StudyResult:
    """A result with these values of tip_peak by arm."""
    values = np.array(list(metrics.values())).T
    status = {"flag_meanings": "COMPLETED DIVERGED REFUSED FAILED"}
    data = xarray.Dataset(
        {
            "tip_peak": (("member", "arm"), values),
            "status": (("member", "arm"), np.zeros(values.shape, dtype=np.int8), status),
            "reason": (("member", "arm"), np.full(values.shape, "", dtype=object)),
        },
        {"arm": list(metrics)},
    )
    return StudyResult(data, small_study().model_copy(update={"design": design}))


@pytest.mark.parametrize("design", ["random", "sobol", "latin", "grid", "saltelli", "morris"])
def test_intervals_are_claimed_of_draws_only(design):
    result = made(design, one=list(np.arange(50.0)), two=list(np.arange(50.0) + 1.0))
    estimates = [
        statistics.at(result, "tip_peak", "one", 0.5),
        statistics.beyond(result, "tip_peak", "one", 10.0),
        *statistics.against(result, "tip_peak", "two", "one")[1:],
    ]
    drawn = design in ("random", "sobol", "latin")
    assert all(np.isfinite(estimate.low) == drawn for estimate in estimates)
    assert all(np.isfinite(estimate.value) for estimate in estimates)
    assert bool(statistics.caveat(design)) == (design != "random")


def test_what_differs_by_less_than_the_grid_resolves_is_equal():
    found = statistics.against(made(one=[1.0, 2.0], two=[1.00001, 1.99999]), "tip_peak", "two", "one")
    assert (found.ratio.value, found.better.value) == (1.0, 0.5)
    found = statistics.against(made(one=[1.0, 2.0], two=[0.99, 1.98]), "tip_peak", "two", "one")
    assert found.better.value == 1.0


def test_reasons_that_differ_in_numbers_only_are_one():
    result = made(one=[1.0] * 4)
    result.data["status"].values[:, 0] = [2, 2, 1, 0]
    result.data["reason"].values[:3, 0] = ["mass = -1.5: no", "mass = -2e-3: no", "slope reached 7"]
    assert statistics.reasons(result, "one") == [(2, "REFUSED", "mass = -1.5: no"), (1, "DIVERGED", "slope reached 7")]
