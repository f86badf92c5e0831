"""Verdicts follow from numbers: with other runs in the place of these, other verdicts come out."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.reproduce import claims_adaptation, claims_faults, claims_vibration
from umbilical.reproduce.experiments import Runs, cell
from umbilical.reproduce.ledger import Evidence, Finding, Verdict
from umbilical.run import Run

PROPOSED = cell("none", "without")


def given(runs: Runs, **places: Run) -> Evidence:
    """The evidence with other runs under some names; ``__`` stands for a comma and a space."""
    return Evidence({**runs, **{name.replace("__", ", "): run for name, run in places.items()}}, {}, {})


def test_every_claim_has_a_verdict_a_number_and_a_region(findings: tuple[Finding, ...]) -> None:
    assert {"C1", "C2", "C3", "C4", "C5", "C6", "C7a", "C7b", "C8", "C9"} <= {f.id for f in findings}
    for finding in findings:
        assert finding.numbers
        assert all(np.isfinite(number.value) for number in finding.numbers), finding.id
        assert len({number.name for number in finding.numbers}) == len(finding.numbers)
        assert finding.region
        assert finding.because
        assert bool(finding.when) or finding.verdict is not Verdict.CONDITIONAL


def test_without_the_maps_the_ledger_says_so(findings: tuple[Finding, ...]) -> None:
    assert {f.id for f in findings if "maps were left out" in f.region} == {"C6", "C7a", "C7b", "C8", "A1"}


def test_a_law_that_is_no_better_fails(runs: Runs) -> None:
    swapped = given(runs, pd=runs[PROPOSED], none__without=runs["pd"])
    assert claims_vibration.c3(swapped).verdict is Verdict.FAILS
    assert claims_vibration.c4(swapped).verdict is Verdict.FAILS


def test_control_that_does_nothing_fails(runs: Runs) -> None:
    idle = given(runs, pd=runs["free"], none__without=runs["free"])
    assert claims_vibration.c2(idle).verdict is Verdict.FAILS
    assert claims_vibration.c2(given(runs, pd=runs["free"])).verdict is Verdict.CONDITIONAL


def test_growth_needs_position_and_time(runs: Runs) -> None:
    """The proposed law's cable moves more in its middle than at its end."""
    held = given(runs, free=runs[PROPOSED])
    assert claims_vibration.c1(held).verdict is not Verdict.HOLDS


def without_estimates(run: Run) -> Run:
    """The run with every estimate zero."""
    zero = {name: 0.0 * run[name] for name in map(str, run.data.data_vars) if name.endswith("_estimate")}
    return Run(run.data.assign(zero), run.scenario)


def test_observers_that_see_nothing_fail(runs: Runs) -> None:
    dead = given(runs, none__without=without_estimates(runs[PROPOSED]))
    assert claims_vibration.c5(dead).verdict is Verdict.FAILS
    assert claims_faults.c9(dead).verdict is Verdict.FAILS
    assert [n.value for n in claims_faults.c9(dead).numbers[:3]] == pytest.approx([1.0, 1.0, 1.0])


def test_arms_that_are_exchanged_turn_the_comparison(runs: Runs) -> None:
    exchanged = given(runs, none__with=runs[PROPOSED], none__without=runs[cell("none", "with")])
    assert claims_faults.c6(exchanged).verdict is Verdict.FAILS


def test_a_run_that_diverges_after_a_fault_is_a_divergence(runs: Runs) -> None:
    lost = runs["blind, dead, fast"]
    assert claims_faults.c7a(given(runs, dead__without=lost)).verdict is Verdict.HOLDS
    assert claims_faults.c8(given(runs, dead__without=lost)).verdict is Verdict.FAILS


def test_a_response_that_falls_back_is_seen(runs: Runs) -> None:
    """A made-up excess that jumps to half the peak and dies out in five seconds."""
    healthy = runs[cell("none", "with")]
    t = healthy["time"].values
    excess = np.where(t >= 10.0, np.exp(-(t - 10.0) / 5.0), 0.0) * 0.5 * float(abs(healthy["tip_displacement"]).max())
    data = healthy.data.assign(tip_displacement=healthy["tip_displacement"] + excess)
    made = {f"{case}__with": Run(data, runs[cell(case, "with")].scenario) for case in ("dead", "stuck", "partial")}
    assert claims_faults.c7b(given(runs, **made)).verdict is Verdict.HOLDS
    assert claims_faults.c7b(given(runs)).verdict is Verdict.CONDITIONAL


def test_adaptation_that_changes_nothing_does_not_help(runs: Runs) -> None:
    same = given(runs, blind__dead__with=runs["blind, dead, without"])
    assert claims_adaptation.a1(same).verdict is Verdict.FAILS


def test_a_ratchet_that_does_not_run_away_is_none(runs: Runs) -> None:
    tame = runs["none, with, long"]
    held = given(runs, blind__dead__fast=tame, blind__none__with__long=tame)
    assert claims_adaptation.a2(held).verdict is Verdict.FAILS
    assert claims_adaptation.a3(held).verdict is Verdict.FAILS


def test_the_adaptive_law_helps_and_harms(findings: tuple[Finding, ...]) -> None:
    """What the issue asks for: an honest setting for each."""
    verdicts = {f.id: f.verdict for f in findings}
    assert (verdicts["A1"], verdicts["A2"], verdicts["A3"]) == (Verdict.HOLDS,) * 3
