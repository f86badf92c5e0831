"""Certificates against simulations of the ideal loop, paying out, hauling in and at rest."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import umbilical
from tests.support.certificates import GAIN, HALF_SINE, fixed, hauled_in
from umbilical.certificate import bound
from umbilical.studies.audit import audit, ideal_loop, identity_residual, largest_ratio, lyapunov_of_run

EXCESS, IDENTITY = 1e-3, 2e-3

CASES: dict[str, umbilical.Scenario] = {
    "at rest, 5": fixed(5.0, 400.0, duration=30.0, **HALF_SINE),
    "at rest, 20": fixed(20.0, 400.0, duration=30.0, **HALF_SINE),
    "paying out, 10": umbilical.load("paper", {GAIN: 10.0}),
    "hauling in, 5": hauled_in(5.0, duration=40.0, **HALF_SINE),
    "hauling in, 20": hauled_in(20.0, duration=40.0, **HALF_SINE),
}


@pytest.mark.parametrize("name", CASES)
def test_v_of_the_ideal_loop_stays_below_its_bound(name: str) -> None:
    certificate = umbilical.certify(CASES[name])
    run = umbilical.simulate(ideal_loop(CASES[name]))
    time, value = lyapunov_of_run(run, certificate)
    assert run.status is umbilical.Status.COMPLETED
    assert largest_ratio(value, bound(certificate, time, float(value[0]))) <= 1.0 + EXCESS
    assert identity_residual(run, certificate, value) < IDENTITY


def test_a_rate_five_times_as_large_is_refuted() -> None:
    """Negative control: the exact decay is 2.7 times the certified one."""
    certificate = umbilical.certify(CASES["at rest, 5"])
    time, value = lyapunov_of_run(umbilical.simulate(ideal_loop(CASES["at rest, 5"])), certificate)
    boast = replace(certificate, rates=5.0 * certificate.rates)
    assert largest_ratio(value, bound(boast, time, float(value[0]))) > 1.2


def test_energy_grows_where_nothing_can_be_certified() -> None:
    """Hauling in from 500 m to 350 m at beta = 0.01: section 7 of the model says by about a fifth."""
    scenario = hauled_in(0.01, **HALF_SINE)
    certificate = umbilical.certify(scenario)
    _, value = lyapunov_of_run(umbilical.simulate(ideal_loop(scenario)), certificate)
    assert not certificate.holds
    assert 1.15 < value[-1] / value[0] < 1.3


def test_audit_of_a_preset() -> None:
    found = audit(umbilical.load("ringdown", {GAIN: 2.0, "duration": 5.0}))
    assert found.excess <= 1.0 + EXCESS
    assert 0.9 < found.cable_excess <= 1.0 + EXCESS
    assert found.identity < IDENTITY
    assert found.ideal_run.scenario.ideal_thruster
    assert not found.real_run.scenario.ideal_thruster
    assert found.real.size == found.real_time.size > 1
    assert np.isfinite(found.real_excess)


def test_progress_ends_at_one() -> None:
    shares: list[float] = []
    audit(umbilical.load("ringdown", {GAIN: 2.0, "duration": 1.0}), progress=shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0


@pytest.mark.parametrize("values", [[0.0, 0.0], []])
def test_what_never_moves_is_below_any_bound(values: list[Any]) -> None:
    assert largest_ratio(np.array(values), np.array(values)) == 0.0
