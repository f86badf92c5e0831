"""Certificates: the numbers of the model's section 7, optimality, fixes, refusals."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh

import umbilical
from tests.support.certificates import FREE, GAIN, fixed, hauled_in, matrices
from umbilical.certificate import Inequality
from umbilical.certificate.conditions import decay_rates, extent, largest_cross
from umbilical.certificate.search import best_weights
from umbilical.certificate.setting import Loop, Payout, ideal_constants, sampled, slab_edges
from umbilical.errors import ScenarioError

MODEL = 0.02
"""The model gives two digits."""


def prepared(scenario: umbilical.Scenario) -> tuple[Loop, Payout]:
    edges = slab_edges(scenario.winch, scenario.duration)
    return ideal_constants(scenario), sampled(scenario.winch, scenario.environment.gravity, edges)


@cache
def of_paper(slope_gain: float) -> umbilical.Certificate:
    """The certificate of 'paper', whose own gain is 0.01 m/s."""
    return umbilical.certify(umbilical.load("paper", {GAIN: slope_gain}))


@pytest.mark.parametrize(
    ("slope_gain", "rate", "exact"),
    [(0.01, 2.0e-5, 7.3e-5), (5.0, 0.010, 0.028), (10.0, 0.020, 0.056), (20.0, 0.038, 0.116), (50.0, 0.0755, 0.36)],
)
def test_fixed_length(slope_gain: float, rate: float, exact: float) -> None:
    certificate = umbilical.certify(fixed(slope_gain))
    assert certificate.holds
    assert certificate.proof.holds
    assert certificate.rate == pytest.approx(rate, rel=MODEL)
    assert certificate.fixed_length_rate == pytest.approx(rate, rel=MODEL)
    assert certificate.exact_rate == pytest.approx(exact, rel=MODEL)
    assert certificate.rate < certificate.exact_rate < 5.0 * certificate.rate


@pytest.mark.parametrize(("slope_gain", "rate"), [(5.0, 0.0090), (20.0, 0.037)])
def test_hauling_in(slope_gain: float, rate: float) -> None:
    certificate = umbilical.certify(hauled_in(slope_gain))
    assert certificate.holds
    assert certificate.proof.holds
    assert certificate.rate == pytest.approx(rate, rel=MODEL)
    assert certificate.rate < certificate.fixed_length_rate


def test_hauling_in_cannot_be_certified_with_the_gain_of_the_paper() -> None:
    certificate = umbilical.certify(hauled_in(0.01))
    assert not certificate.holds
    assert np.isnan(certificate.rate)
    assert [inequality.name for inequality in certificate.broken] == ["K2"]
    assert certificate.broken[0].margin == pytest.approx(-0.99, rel=0.01)


@pytest.mark.parametrize(("slope_gain", "rate"), [(0.01, -1.2e-3), (0.5, -2.0e-4), (1.0, 8.0e-4), (5.0, 8.75e-3)])
def test_the_jerk_of_the_winch(slope_gain: float, rate: float) -> None:
    """On the payout of the preset 'paper'; the rates of section 7."""
    certificate = of_paper(slope_gain)
    assert certificate.rate == pytest.approx(rate, rel=MODEL)
    assert certificate.holds == (rate > 0.0)
    assert certificate.proof.holds, "also what is negative is proved"
    assert [inequality.name for inequality in certificate.broken] == ([] if rate > 0.0 else ["K5"])


def test_a_weight_that_follows_the_tension_moves_the_jerk_in_time_and_does_not_absorb_it() -> None:
    """With V -> (g - a)^-nu V the rate is ``th - nu a'/(g - a)``: better pointwise, the same over the whole run."""
    loop, motion = prepared(umbilical.load("paper", {GAIN: 0.5}))
    found = best_weights(loop, motion)
    assert found is not None
    plain = decay_rates(loop, motion, *found)
    best = {nu: float((plain - nu * motion.relative_jerk).min()) for nu in (0.0, 1.0 / 3.0, 1.0)}
    assert best[0.0] < 0.0 < best[1.0 / 3.0], "a third of it certifies a smaller gain"
    assert best[1.0] < best[0.0], "following the tension wholly makes it worse"
    toll = np.trapezoid(motion.relative_jerk.ravel(), motion.t.ravel())
    assert abs(toll) < 1e-4 * np.abs(np.diff(np.log(1.0 - motion.a.ravel() / loop.g))).sum(), (
        "over the run its integral is ln((g - a(0))/(g - a(end))), here 0"
    )


def test_the_ends_of_the_cable_decide() -> None:
    """Smallest eigenvalue at 200 x and every sample, by LAPACK, against the formula at the two ends."""
    loop, motion = prepared(umbilical.load("haul-in", {GAIN: 20.0, "cable.damping": 0.3}))
    found = best_weights(loop, motion)
    assert found is not None
    formula = decay_rates(loop, motion, *found)
    for slab in range(0, motion.t.shape[0], 6):
        length, v, a, nu = (float(x[slab, 0]) for x in (motion.l, motion.v, motion.a, motion.relative_jerk))
        pairs = [matrices(loop, *found, x, (length, v, a, nu)) for x in np.linspace(0.0, length, 200)]
        lowest = min(2.0 * eigh(m, n, eigvals_only=True)[0] for n, m in pairs)
        assert lowest == pytest.approx(formula[slab, 0], rel=1e-9)


@pytest.mark.parametrize("name", ["paper", "haul-in"])
@pytest.mark.parametrize("slope_gain", [5.0, 45.0, 200.0])
def test_no_weights_at_random_are_better(name: str, slope_gain: float) -> None:
    loop, motion = prepared(umbilical.load(name, {GAIN: slope_gain, "cable.damping": 0.05}))
    found = best_weights(loop, motion)
    assert found is not None
    room, dice = extent(loop, motion), np.random.default_rng(1)
    vessel = dice.uniform(room.least_vessel, room.reach.min(), 3000)
    cross = dice.uniform(0.0, 1.0, 3000) ** 0.3 * largest_cross(motion, room, vessel)
    others = decay_rates(loop, motion, cross[:, None, None], vessel[:, None, None]).min(axis=(1, 2))
    assert others.max() <= decay_rates(loop, motion, *found).min() * (1.0 + 1e-3)


def recommended(certificate: umbilical.Certificate) -> float:
    """The gain that the fix prints, read as a user reads it."""
    (fix,) = certificate.fixes
    assert fix.key == GAIN
    return float(re.findall(r"(?:at least|exceed) ([0-9.]+) m/s", fix.fix)[0])


def test_the_fix_is_the_edge_of_what_can_be_certified() -> None:
    """Hauling in at 1.2 m/s."""
    certificate = umbilical.certify(hauled_in(1.0, speed=1.2, duration=50.0))
    assert "for hauling in at 1.2 m/s" in certificate.fixes[0].fix
    gain = recommended(certificate)
    assert 1.2 < gain < 1.21
    assert umbilical.certify(hauled_in(gain, speed=1.2, duration=50.0)).holds
    assert not umbilical.certify(hauled_in(0.998 * gain, speed=1.2, duration=50.0)).holds


@pytest.mark.parametrize("slope_gain", [0.9995, 1.0005, 1.001, 1.002])
def test_the_fix_never_asks_for_what_is_there(slope_gain: float) -> None:
    """Hauling in at 1 m/s: within the thousandth that is left free nothing holds, and the fix is beyond it."""
    scenario = hauled_in(slope_gain, duration=50.0)
    certificate = umbilical.certify(scenario)
    assert not certificate.holds
    gain = recommended(certificate)
    assert slope_gain < gain < 1.01
    assert umbilical.certify(scenario.replace({GAIN: gain})).holds
    assert "0.1% of each bound left free" in certificate.fixes[0].bound


@pytest.mark.slow
def test_across_the_edge_what_holds_is_what_is_proved() -> None:
    """The jerk of the payout of 'paper': samples decay a little earlier than the proof, and the proof decides."""
    verdicts = []
    for slope_gain in (0.6, 0.6008, 0.60087, 0.601):
        certificate = umbilical.certify(umbilical.load("paper", {GAIN: slope_gain}))
        decays = certificate.proof.holds and certificate.rates.min() > 0.0
        (shown,) = (i for i in certificate.inequalities if i.name == "K5")
        assert certificate.holds == decays == shown.holds == (not certificate.fixes)
        assert shown.right == pytest.approx(certificate.rate, rel=1e-9)
        assert certificate.holds or recommended(certificate) == 0.601, "which is the last of these"
        verdicts.append(certificate.holds)
    assert verdicts == sorted(verdicts), "larger gains only mend it"
    assert len(set(verdicts)) == 2


def test_a_rate_that_does_not_decay_is_no_certificate() -> None:
    """Negative control: the same certificate with a slab at 0."""
    certificate = umbilical.certify(fixed(5.0))
    assert certificate.holds
    assert not replace(certificate, rates=np.array([0.0])).holds
    assert not replace(certificate, rates=np.array([np.nan])).holds


def test_a_gain_can_be_too_large() -> None:
    """``c_l^2/beta`` must exceed the speed of hauling in, too: 2500/3000 < 1."""
    certificate = umbilical.certify(hauled_in(3000.0, duration=50.0))
    assert [inequality.name for inequality in certificate.broken] == ["K1"]
    assert "must not exceed" in certificate.fixes[0].fix
    gain = recommended(certificate)
    assert 2480.0 < gain < 2500.0
    assert umbilical.certify(hauled_in(gain, duration=50.0)).holds


JERKY = {"law": "cosine", "start_length": 400.0, "amplitude": 0.5, "frequency": 1.5}


def test_a_winch_that_no_gain_mends_is_slowed_down_and_that_is_proved() -> None:
    scenario = umbilical.load("paper", FREE | {GAIN: 5.0, "winch": JERKY})
    certificate = umbilical.certify(scenario)
    assert not certificate.holds
    (fix,) = certificate.fixes
    assert fix.key == "winch"
    changes = dict(re.findall(r"([a-z_.]+) = ([0-9.]+)", fix.fix))
    assert "winch.frequency" in changes
    assert umbilical.certify(scenario.replace({key: float(value) for key, value in changes.items()})).holds


def test_where_nothing_is_proved_nothing_is_suggested() -> None:
    """The winch is given as a table, which is not slowed down."""
    times = np.linspace(0.0, 10.0, 101)
    table = {"law": "table", "times": times.tolist(), "lengths": (400.5 - 0.5 * np.cos(1.5 * times)).tolist()}
    certificate = umbilical.certify(umbilical.load("paper", FREE | {GAIN: 5.0, "winch": table, "duration": 10.0}))
    assert not certificate.holds
    assert certificate.fixes == ()


@pytest.mark.parametrize("changes", [
    {"winch": {"law": "speed", "start_length": 400.0, "speed": -2.0}, GAIN: 0.5},
    {"winch": {"law": "trapezoid", "start_length": 450.0, "end_length": 430.0, "top_speed": 1.0, "acceleration": 0.05}},
    {"winch": JERKY | {"frequency": 0.1, "amplitude": 4.0}, GAIN: 0.05},
    {"winch": JERKY | {"frequency": 0.3, "amplitude": 4.0}, GAIN: 30000.0},
])  # fmt: skip
@pytest.mark.parametrize("moves", [False, True])
def test_a_fix_that_is_followed_is_certified(changes: dict, moves: bool) -> None:
    vessel = [{"kind": "sine", "amplitude": 0.5, "frequency": 0.7, "phase": 0.0}] if moves else []
    scenario = umbilical.load(
        "paper", FREE | changes | {"environment.vessel_motion": vessel, "environment.vessel_ramp": 20.0}
    )
    certificate = umbilical.certify(scenario)
    assert not certificate.holds
    for fix in certificate.fixes:
        numbers = re.findall(r"(?:at least|exceed|slope_gain =) ([0-9.]+)", fix.fix)
        assert umbilical.certify(scenario.replace({GAIN: float(numbers[0])}), fix=False).holds
    assert certificate.fixes


def test_weights_at_their_edge_are_not_chosen() -> None:
    """A light ROV on a damped cable under a moving vessel: the best lam is next to 0, which the proof refuses."""
    light = {"payload.mass": 150.0, "payload.damping": 1500.0, "cable.damping": 5.0, GAIN: 0.01}
    winch = {"law": "trapezoid", "start_length": 2800.0, "end_length": 3000.0, "top_speed": 1.0, "acceleration": 0.1}
    motion = [{"kind": "sine", "amplitude": 0.5, "frequency": 0.7, "phase": 0.0}]
    vessel = {"environment.vessel_motion": motion, "environment.vessel_ramp": 20.0}
    certificate = umbilical.certify(umbilical.load("paper", FREE | light | {"winch": winch} | vessel))
    assert certificate.weights.cross > 0.0
    assert certificate.holds


@pytest.mark.parametrize("believed", [{"payload_damping": 0.0}, {"payload_mass": 400.0}, {"gravity": 9.8}])
def test_what_is_believed_and_not_true_is_outside_even_where_it_is_zero(believed: dict[str, float]) -> None:
    def limits(nominal: dict[str, float]) -> str:
        scenario = umbilical.load("ringdown", {GAIN: 5.0, "payload.damping": 200.0, "control.nominal": nominal})
        return "; ".join(umbilical.certify(scenario, fix=False).limits)

    assert "constants the controller believes" in limits(believed)
    assert "constants the controller believes" not in limits({})


@pytest.mark.parametrize(
    ("preset", "change", "key"),
    [
        ("paper-pd", {}, "control.law.kind"),
        ("paper-none", {}, "control.law.kind"),
        ("paper", {GAIN: 0.0}, "control.law.slope_gain"),
    ],
)
def test_what_it_is_not_about_is_refused(preset: str, change: dict[str, float], key: str) -> None:
    with pytest.raises(ScenarioError) as refused:
        umbilical.certify(umbilical.load(preset, change))
    assert [problem.key for problem in refused.value.problems] == [key]


WATER = {
    "environment.gravity": 9.81, "environment.water": {"current": {"depths": [0.0, 600.0], "speeds": [0.5, 0.1]}},
    "winch": {"law": "constant", "length": 400.0}, "payload.wet_weight": 3500.0, GAIN: 5.0,
    "payload.water": {"linear_drag": 60.0, "added_mass": 200.0},
    "cable.wet_line_density": 1.2, "cable.water": {"diameter": 0.02, "normal_drag": 0.0, "tangential_drag": 0.0},
}  # fmt: skip


def test_linear_damping_in_a_steady_current_is_proved_and_pushes() -> None:
    """D_l u is a constant force on the ROV, as a payload_force of that size; drag of its own motion is cancelled."""
    at_sea = umbilical.certify(umbilical.load("ringdown", WATER))
    assert at_sea.holds
    still = {"environment.water.current": None}
    pushed = {"environment.payload_force": [{"kind": "constant", "value": 60.0 * (0.5 - 0.4 * 400.0 / 600.0)}]}
    same = umbilical.certify(umbilical.load("ringdown", WATER | still | pushed))
    assert at_sea.loads.force == pytest.approx(same.loads.force)
    assert (at_sea.rate, at_sea.residual) == pytest.approx((same.rate, same.residual))


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"cable.water.normal_drag": 1.2}, "cable.water.normal_drag"),
        ({"payload.water.quadratic_drag": 10.0}, "payload.water.quadratic_drag"),
        ({"control.law.station_gain": 0.1}, "control.law.station_gain"),
        ({"control.law.washout_time": 120.0}, "control.law.washout_time"),
        (
            {"environment.water.current.variation": [{"kind": "sine", "amplitude": 0.1, "frequency": 1.0}]},
            "environment.water.current.variation",
        ),
        ({"environment.vessel_heave": [{"kind": "sine", "amplitude": 0.1, "frequency": 0.3}]},
         "environment.vessel_heave"),
        ({"winch": {"law": "quintic", "start_length": 400.0, "end_length": 420.0, "duration": 40.0}}, "cable.water"),
        ({"winch": {"law": "quintic", "start_length": 400.0, "end_length": 420.0, "duration": 40.0}},
         "environment.water.current.speeds"),
    ],
)  # fmt: skip
def test_water_that_no_proof_covers_is_refused_by_name(change: dict[str, Any], key: str) -> None:
    with pytest.raises(ScenarioError) as refused:
        umbilical.certify(umbilical.load("ringdown", WATER).replace(change))
    assert key in [problem.key for problem in refused.value.problems]


def test_limits_name_what_lies_between_the_ideal_loop_and_the_scenario() -> None:
    assert len(umbilical.certify(umbilical.load("paper-dead-adaptive", {GAIN: 5.0})).limits) == 5
    assert len(umbilical.certify(umbilical.load("crosscheck-proposed", {GAIN: 5.0})).limits) == 2


def test_an_inequality_at_its_edge() -> None:
    assert Inequality("a", "a <= b", 1.0, 1.0, "1").holds
    assert not Inequality("a", "a < b", 1.0, 1.0, "1", strict=True).holds
    assert not Inequality("a", "a <= b", 1.0, float("nan"), "1").holds


def test_the_papers_conditions_fail_for_its_own_gains() -> None:
    """Paying out faster than beta breaks iota_5 whatever the free numbers; the observers' errors break iota_6."""
    by_name = {i.name: i for i in of_paper(0.01).paper}
    assert len(by_name) == 7
    assert {name for name, i in by_name.items() if not i.holds} == {"iota_2", "iota_5", "iota_6"}
    still = {i.name: i.holds for i in umbilical.certify(fixed(0.01)).paper}
    assert [name for name, holds in still.items() if not holds] == ["iota_6"]


def test_the_papers_free_number_is_as_large_as_it_may_be() -> None:
    """iota_4 and iota_5 fall with lambda; with the winch stopped iota_5 is the first to end, at zero."""
    rights = {i.name: i.right for i in umbilical.certify(fixed(0.01)).paper}
    assert rights["iota_5"] == pytest.approx(0.0, abs=1e-9 * rights["iota_4"])
    assert rights["iota_4"] > 0.0


def test_every_inequality_is_asked_on_the_cable() -> None:
    found = of_paper(5.0)
    assert all(i.x is not None and 0.0 <= i.x <= 500.0 for i in found.inequalities)
