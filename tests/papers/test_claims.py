"""Verdicts follow from numbers: with other runs in the place of these, other verdicts come out."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.support.maps import made_up_maps
from umbilical.papers.rao2022 import claims_adaptation, claims_faults, claims_vibration
from umbilical.papers.rao2022.claims import judge_claims
from umbilical.papers.rao2022.experiments import FAULTS, Runs, cell
from umbilical.papers.rao2022.ledger import Evidence, Finding, Verdict, make_finding
from umbilical.papers.rao2022.maps import MAPS
from umbilical.run import Run

PROPOSED = cell("none", "without")


def given(evidence: Evidence, **places: Run) -> Evidence:
    """The evidence with other runs under some names; ``__`` stands for a comma and a space."""
    others = {name.replace("__", ", "): run for name, run in places.items()}
    return evidence._replace(runs={**evidence.runs, **others})


def test_every_claim_has_a_verdict_a_number_and_a_region(findings: tuple[Finding, ...]) -> None:
    assert {"C1", "C2", "C3", "C4", "C5", "C6", "C7a", "C7b", "C7c", "C8", "C9"} <= {f.id for f in findings}
    for finding in findings:
        assert finding.numbers
        assert all(np.isfinite(number.value) for number in finding.numbers), finding.id
        assert len({number.name for number in finding.numbers}) == len(finding.numbers)
        assert finding.region
        assert finding.because
        assert bool(finding.when) or finding.verdict is not Verdict.CONDITIONAL


def test_without_the_maps_the_ledger_says_so(findings: tuple[Finding, ...]) -> None:
    assert {f.id for f in findings if "maps were left out" in f.region} == {"C7a", "C7b", "A1", "A2", "A3"}


def test_a_law_that_is_no_better_fails(evidence: Evidence, runs: Runs) -> None:
    swapped = given(evidence, pd=runs[PROPOSED], none__without=runs["pd"])
    assert claims_vibration.c3(swapped).verdict is Verdict.FAILS
    assert claims_vibration.c4(swapped).verdict is Verdict.FAILS


def test_control_that_does_nothing_fails(evidence: Evidence, runs: Runs) -> None:
    idle = given(evidence, pd=runs["free"], none__without=runs["free"])
    assert claims_vibration.c2(idle).verdict is Verdict.FAILS
    assert claims_vibration.c2(given(evidence, pd=runs["free"])).verdict is Verdict.CONDITIONAL


def test_growth_needs_position_and_time(evidence: Evidence, runs: Runs) -> None:
    """The proposed law's cable moves more in its middle than at its end."""
    held = given(evidence, free=runs[PROPOSED])
    assert claims_vibration.c1(held).verdict is not Verdict.HOLDS


def without_estimates(run: Run) -> Run:
    """The run with every estimate zero."""
    zero = {name: 0.0 * run[name] for name in map(str, run.data.data_vars) if name.endswith("_estimate")}
    return Run(run.data.assign(zero), run.scenario)


def test_observers_that_see_nothing_fail(evidence: Evidence, runs: Runs) -> None:
    dead = given(evidence, none__without=without_estimates(runs[PROPOSED]))
    assert claims_vibration.c5(dead).verdict is Verdict.FAILS
    assert claims_faults.c9(dead).verdict is Verdict.FAILS
    assert [n.value for n in make_finding("C9", claims_faults.c9(dead), dead).numbers[:3]] == pytest.approx(
        [1.0, 1.0, 1.0]
    )


def test_arms_that_are_exchanged_turn_the_comparison(evidence: Evidence, runs: Runs) -> None:
    exchanged = given(evidence, none__with=runs[PROPOSED], none__without=runs[cell("none", "with")])
    assert claims_faults.c6(exchanged).verdict is Verdict.FAILS


def test_a_run_that_diverges_after_a_fault_is_a_divergence(evidence: Evidence, runs: Runs) -> None:
    lost = runs["blind, dead, fast"]
    assert claims_faults.c7a(given(evidence, dead__without=lost)).verdict is Verdict.HOLDS
    assert claims_faults.c8(given(evidence, dead__without=lost)).verdict is Verdict.FAILS


def response(runs: Runs, share: Callable[[np.ndarray], np.ndarray]) -> dict[str, Run]:
    """Runs whose excess over the healthy one is a made-up share of its peak, over the time since the fault."""
    healthy = runs[cell("none", "with")]
    since = healthy["time"].values - 10.0
    excess = np.where(since >= 0.0, share(since), 0.0) * float(abs(healthy["tip_displacement"]).max())
    tip = healthy["tip_displacement"] + excess
    faulty = {case: runs[cell(case, "with")] for case in FAULTS}
    return {f"{case}__with": Run(run.data.assign(tip_displacement=tip), run.scenario) for case, run in faulty.items()}


def test_a_response_that_falls_back_and_settles_is_seen(evidence: Evidence, runs: Runs) -> None:
    gone = given(evidence, **response(runs, lambda since: 0.5 * np.exp(-since / 5.0)))
    assert claims_faults.c7c(gone).verdict is Verdict.HOLDS
    swinging = given(evidence, **response(runs, lambda since: 0.5 * np.exp(-since / 5.0) + 0.1 * np.sin(since)))
    assert claims_faults.c7c(swinging).verdict is Verdict.FAILS
    staying = given(evidence, **response(runs, lambda since: 0.5 + 0.0 * since))
    assert claims_faults.c7c(staying).verdict is Verdict.FAILS
    assert claims_faults.c7c(evidence).verdict is Verdict.FAILS


def test_a_jump_is_asked_of_every_fault_and_at_once(evidence: Evidence, runs: Runs) -> None:
    assert claims_faults.c7b(evidence).verdict is Verdict.HOLDS
    creeping = given(evidence, **response(runs, lambda since: 0.01 * since))
    assert claims_faults.c7b(creeping).verdict is Verdict.CONDITIONAL
    lost = given(evidence, dead__with=runs["blind, dead, fast"])
    assert claims_faults.c7b(lost).verdict is Verdict.CONDITIONAL


def test_the_motors_observers_follow_what_is_slow(evidence: Evidence) -> None:
    """C9 names the frequency at which a lag of 1/g_o makes the error that is allowed."""
    found = make_finding("C9", claims_faults.c9(evidence), evidence)
    limit = next(number.value for number in found.numbers if number.name == "d2_limit")
    assert limit / np.hypot(limit, 100.0) == pytest.approx(0.1)
    assert found.when.endswith(f"{limit:.3g} rad/s")


def test_verdicts_do_not_depend_on_whether_maps_were_made(evidence: Evidence, findings: tuple[Finding, ...]) -> None:
    """Maps add numbers and regions; without fault control none of their cells may diverge."""
    maps = made_up_maps()
    for name in ("map-time", "map-factors"):
        maps[name]["peak"].loc[{"arm": "without"}] = 1.0
    found = judge_claims(evidence._replace(maps={name: maps[name] for name in MAPS}))
    assert [f.verdict for f in found] == [f.verdict for f in findings]
    for with_maps, without in zip(found, findings, strict=True):
        assert {n.name for n in without.numbers} <= {n.name for n in with_maps.numbers}
        assert len({n.name for n in with_maps.numbers}) == len(with_maps.numbers)
        assert "maps were left out" not in with_maps.region
    lost = made_up_maps(0.5)
    assert claims_faults.c7a(evidence._replace(maps=lost)).verdict is Verdict.HOLDS


def test_adaptation_that_changes_nothing_does_not_help(evidence: Evidence, runs: Runs) -> None:
    same = given(evidence, blind__dead__with=runs["blind, dead, without"])
    assert claims_adaptation.a1(same).verdict is Verdict.FAILS


def test_help_is_asked_of_a_motor_stuck_far_away_too(evidence: Evidence, runs: Runs) -> None:
    assert claims_adaptation.a1(evidence).verdict is Verdict.CONDITIONAL
    helped = given(evidence, blind__stuck__with=runs["blind, dead, with"])
    assert claims_adaptation.a1(helped).verdict is Verdict.HOLDS


def test_a_ratchet_that_does_not_run_away_is_none(evidence: Evidence, runs: Runs) -> None:
    tame = runs["none, with, endless"]
    held = given(evidence, blind__dead__fast=tame, blind__none__with__long=tame)
    assert claims_adaptation.a2(held).verdict is Verdict.FAILS
    lost = given(evidence, none__with__endless=runs["blind, none, with, long"])
    assert claims_adaptation.a2(lost).verdict is Verdict.HOLDS
    assert claims_adaptation.a3(held).verdict is Verdict.FAILS


def test_the_adaptive_law_helps_and_harms(findings: tuple[Finding, ...]) -> None:
    """What the issue asks for: an honest setting for each."""
    verdicts = {f.id: f.verdict for f in findings}
    assert (verdicts["A1"], verdicts["A2"]) == (Verdict.CONDITIONAL,) * 2
    assert verdicts["A3"] is Verdict.HOLDS
