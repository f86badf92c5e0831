"""Memory: what a study takes is said before it is drawn, flat while it runs, and not decided by its longest text."""

from __future__ import annotations

import tracemalloc
from functools import partial

import numpy as np
import pytest

from tests.support.studies import small_study
from umbilical.errors import ScenarioError
from umbilical.formats import to_netcdf
from umbilical.studies import engines, prepare
from umbilical.studies.members import Draws
from umbilical.studies.results import assemble_study
from umbilical.studies.rows import NAMES, Cell, Row, run_member
from umbilical.studies.sweep import sweep
from umbilical.studies.tune import tune


def rows(members: int, arms: int, reason: str = ""):
    numbers = tuple(np.linspace(0.1, 1.0, len(NAMES)))
    for number in range(1, members + 1):
        first = Cell("FAILED", reason, 0.0, numbers) if number == 1 and reason else Cell("COMPLETED", "", 1.0, numbers)
        yield Row(number, (first, *[Cell("COMPLETED", "", 1.0, numbers)] * (arms - 1)))


def peak_of(study, reason: str = "") -> int:
    """Bytes at most while a result is assembled and written, imports not counted."""
    small = study.model_copy(update={"members": 16})
    to_netcdf(assemble_study(small, rows(16, len(study.arms))).data)
    tracemalloc.start()
    try:
        to_netcdf(assemble_study(study, rows(study.members, len(study.arms), reason)).data)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("design", ["random", "latin", "sobol"])
def test_the_estimate_of_memory_is_an_upper_one_and_not_far_off(design):
    study = small_study(members=2048, design=design)
    assert 0.2 < peak_of(study) / prepare.memory_needed(study) < 1.0


def test_one_long_reason_costs_its_own_length_only():
    study = small_study(members=2048)
    assert peak_of(study, "x" * 100_000) < peak_of(study) + 2_000_000


def test_what_the_machine_cannot_hold_is_refused_with_the_number(monkeypatch, tmp_path):
    monkeypatch.setattr(prepare.machine, "memory", lambda: 1e9)
    monkeypatch.setattr(Draws, "points", property(lambda self: pytest.fail("it was drawn")))
    tuning = {"arm": "PD", "gains": [{"key": "control.law.position_gain", "low": 1.0, "high": 2.0}]}
    study = small_study(members=10_000_000, tuning={**tuning, "objectives": [{"metric": "tip_peak"}]})
    for command in (sweep, tune):
        with pytest.raises(ScenarioError, match=r"10000000, which take \d+\.?\d* GB") as caught:
            command(study, tmp_path / "out")
        assert [problem.key for problem in caught.value.problems] == ["members"]
        assert not (tmp_path / "out").exists()
    most = int(caught.value.problems[0].bound.split()[2].rstrip(","))
    prepare.check_study_memory(study.model_copy(update={"members": most}))
    with pytest.raises(ScenarioError):
        prepare.check_study_memory(study.model_copy(update={"members": most + 1}))


def test_a_grid_counts_its_own_members():
    values = {"kind": "grid", "low": 400.0, "high": 500.0, "count": 30}
    factors = [{"key": key, "distribution": values} for key in ("payload.mass", "winch.end_length")]
    study = small_study(design="grid", members=1, campaigns=[], factors=factors)
    assert len(Draws(study)) == 900


def test_the_machine_has_memory():
    assert prepare.machine.memory() > 1e8


@pytest.mark.parametrize("engine", [engines.threads(2), pytest.param(engines.processes(2), marks=pytest.mark.slow)])
def test_an_engine_takes_members_as_it_needs_them(engine):
    """Of a stream of members no more than a few are taken before the first row is there."""
    draws, taken = Draws(small_study(members=1000, arms=[{"name": "one"}])), []
    members = (taken.append(number) or draws.member(number) for number in range(1, 1001))
    next(found := engines.in_any_order(engine, partial(run_member, draws), members))
    found.close()
    assert len(taken) <= 12
