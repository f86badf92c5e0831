"""Sensors' noise in the voltages: predicted by the sampled linear loop, held against simulations of the whole loop."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import umbilical
from umbilical.scenario.scenario import Scenario
from umbilical.stability.laws import root_slope
from umbilical.stability.margins import margins
from umbilical.stability.sampled import loop_response, sampled_loop
from umbilical.synthesis import iterate
from umbilical.synthesis.design import _missing
from umbilical.synthesis.iterate import DesignOutcome, Evaluation, Limits
from umbilical.synthesis.noise import NO_NOISE, VoltageNoise, commanded_spectrum, reading_noise, voltage_noise
from umbilical.synthesis.score import Demands, Score, Scorer
from umbilical.synthesis.search import DesignTask, Knob, explore, refine
from umbilical.synthesis.trial import try_gains

AT_REST = {"initial.shape": "straight", "grid.elements": 8, "duration": 6.0}
PUSHED = AT_REST | {"environment.payload_force": [{"kind": "constant", "value": 50.0}]}
NOISE = {"sensors.tip_displacement.noise": 1e-5, "sensors.tip_slope.noise": 1e-6}
FAST = {
    "control.law.slope_gain": 12.42, "control.law.damping_gain": 549.2,
    "control.velocity_observer.time_constant": 0.002, "control.velocity_observer.damping": 1.0,
    "control.slope_observer.time_constant": 0.8568, "control.slope_observer.damping": 1.0,
    "control.disturbance_observer.gain": 85.11, "control.motor_loop.filter_frequency": 900.0,
    "control.motor_loop.speed_gain": 282.4, "control.motor_loop.current_gain": 359.6,
}  # fmt: skip
"""Gains that a search without noise finds."""


def predicted(scenario: Scenario, thrust: float, length: float = 400.0) -> float:
    scorer = Scorer(scenario, length, Demands(), quick=True)
    return voltage_noise(scorer, sampled_loop(scenario, 50.0), scenario, [thrust]).rms


@pytest.mark.parametrize(
    ("changes", "thrust"),
    [
        (PUSHED | NOISE, 50.0),
        (AT_REST | NOISE, 0.0),  # the demand crosses the root's steep part: its mean slope counts
        (AT_REST | NOISE | FAST, 0.0),
        (PUSHED | {"sensors.motor_speed.noise": 1e-3, "sensors.motor_current.noise": 1e-3}, 50.0),
        (PUSHED | {"sensors.tip_displacement.noise": 1e-7, "sensors.tip_slope.latency": 0.002}, 50.0),
        (
            PUSHED
            | NOISE
            | {"control.outer_period": 0.004}
            | {f"control.{name}_observer.time_constant": 0.01 for name in ("velocity", "slope")},
            50.0,
        ),
    ],
    ids=["pushed", "at rest", "at rest, fast gains", "motor sensors", "one sensor", "slow outer law"],
)
def test_a_simulation_has_the_noise_that_is_predicted(changes, thrust):
    scenario = umbilical.load("ringdown", changes)
    assert try_gains(scenario).chatter == pytest.approx(predicted(scenario, thrust), rel=0.1)


def test_noise_grows_in_proportion_where_the_root_is_smooth_and_slower_at_rest():
    once, twice = (
        umbilical.load("ringdown", {key: factor * value for key, value in NOISE.items()}) for factor in (1.0, 2.0)
    )
    assert predicted(twice, 500.0) == pytest.approx(2.0 * predicted(once, 500.0), rel=0.01)
    assert predicted(twice, 0.0) == pytest.approx(np.sqrt(2.0) * predicted(once, 0.0), rel=0.01)


@pytest.mark.parametrize("damping", [0.001, 0.5])
def test_the_mean_over_the_phase_of_echoes_is_the_sum_over_resonances(damping):
    """Against the loop with its true echo, on frequencies fine enough for every resonance."""
    scenario = umbilical.load("ringdown", NOISE | {"cable.damping": damping})
    scorer, loop, deviations = (
        Scorer(scenario, 400.0, Demands()),
        sampled_loop(scenario, 50.0),
        reading_noise(scenario)[:4],
    )
    w = np.linspace(5.0, 9.0, 20_001)
    opened = loop_response(scorer.cable, loop, 1j * w).loop
    gains = loop.law.response(np.exp(1j * w * loop.period))[:, 0, :]
    resolved = np.trapezoid(np.abs(gains / (1.0 - opened)[:, None]) ** 2 @ deviations**2, w) * loop.period / np.pi
    spectrum = np.interp(w, scorer.w, commanded_spectrum(scorer, loop, deviations))
    assert np.trapezoid(spectrum, w) == pytest.approx(resolved, rel=0.01)


def test_the_verdict_is_of_the_worst_length_and_thrust():
    task = DesignTask(umbilical.load("paper", NOISE), [], "both", Demands(), 450.0, 500.0)
    worst = iterate.worst_noise(task, task.scenario, (0.0, 500.0))
    scorers = [Scorer(task.scenario, length, Demands()) for length in (450.0, 475.0, 500.0)]
    each = [
        voltage_noise(scorer, task.loop({}), task.scenario, [thrust]) for scorer in scorers for thrust in (0.0, 500.0)
    ]
    assert worst.thrust == 0.0
    assert worst.rms == pytest.approx(max(each).rms, rel=0.01)


def test_a_resolution_is_noise_of_its_twelfths_root():
    fine = umbilical.load("ringdown", {"sensors.tip_displacement.resolution": 1.2e-5})
    same = umbilical.load("ringdown", {"sensors.tip_displacement.noise": 1.2e-5 / np.sqrt(12.0)})
    assert reading_noise(fine) == pytest.approx(reading_noise(same))
    assert predicted(fine, 0.0) == pytest.approx(predicted(same, 0.0))


def test_nothing_comes_of_perfect_sensors_ideal_thrusters_and_periods_too_long_for_10_hz():
    assert predicted(umbilical.load("ringdown"), 0.0) == 0.0
    assert predicted(umbilical.load("ringdown", NOISE | {"ideal_thruster": True}), 0.0) == 0.0
    scorer, slow = Scorer(umbilical.load("ringdown"), 400.0, Demands()), umbilical.load("ringdown", NOISE)
    loop = replace(sampled_loop(slow, 50.0), period=0.06)
    assert voltage_noise(scorer, loop, slow, [0.0]) == NO_NOISE


@pytest.mark.parametrize("spread", [1e-6, 1e-3, 0.1, 30.0])
@pytest.mark.parametrize("demand", [0.0, 2.0, 25.0])
def test_mean_slope_of_the_root(demand, spread):
    """Against the plain mean over a fine grid of demands, which the steep part at 0 has many points of."""
    x = np.linspace(-7.0, 7.0, 2_000_001)
    likelihood = np.exp(-0.5 * x * x)
    u = demand + spread * x
    slopes = (0.5 * u * u + 1e-6) / (u * u + 1e-6) ** 1.25
    assert root_slope(demand, 1e-3, spread) == pytest.approx((slopes * likelihood).sum() / likelihood.sum(), rel=0.01)


THREE = [
    Knob("control.law.slope_gain", 0.05, 50.0),
    Knob("control.law.damping_gain", 50.0, 1e4),
    Knob("control.motor_loop.filter_frequency", 18.0, 900.0),
]
SLOW = {"control.slope_observer.time_constant": 0.5, "control.disturbance_observer.gain": 2.0}


@pytest.mark.slow
def test_a_search_keeps_a_ceiling_of_noise_pays_for_it_and_finds_the_least():
    noisy = umbilical.load("ringdown", NOISE | SLOW)
    free = DesignTask(noisy, THREE, "ringdown", Demands().beyond(1.0), 400.0, 50.0)
    scorer = free.scorer()

    def found(task: DesignTask) -> tuple[float, Score]:
        gains = refine(task, explore(task, generations=4))
        noise = voltage_noise(scorer, task.loop(gains), noisy.replace(gains), [0.0, 50.0]).rms
        return noise, scorer.score(task.loop(gains))

    loud, open_ = found(free)
    least, calm = found(replace(free, least_noise=True))
    assert least < 0.9 * loud
    ceiling = float(np.sqrt(least * loud))
    quiet, bound = found(replace(free, noise_ceiling=ceiling))
    assert all(score.sound for score in (open_, calm, bound))
    assert quiet < 1.01 * ceiling
    assert bound.reflection > open_.reflection


TRIAL = try_gains(umbilical.load("ringdown", {"duration": 0.5, "grid.elements": 8}))


def side(noise: float) -> Evaluation:
    scenario = umbilical.load("ringdown", NOISE)
    task = DesignTask(scenario, [], "both", Demands(), 400.0, 50.0)
    gains = FAST
    demands = Demands(0.5, 0.0, 0.0)
    return Evaluation(
        scenario,
        demands,
        task.scorer().score(task.loop(gains)),
        margins(scenario),
        TRIAL,
        VoltageNoise(noise, 0.0, 400.0),
    )


def test_noise_above_its_limit_is_missing_and_the_search_for_the_least_is_told():
    loud, least = side(5.0), side(4.0)
    said = list(_missing(DesignOutcome({}, loud, loud, (), least), Limits()))
    assert any("noise 5 V above the limit of 3 V" in words for words in said)
    assert any("the least noise of a voltage ended at 4 V, margins kept" in words for words in said)
    assert not any("thruster" in words for words in said)
    assert list(_missing(DesignOutcome({}, side(2.0), loud, (), least), Limits())) == []


def test_what_the_noise_explains_is_no_chatter():
    trial = replace(TRIAL, chatter=1.0)
    assert "chatter" in Limits().exceeded(replace(side(0.0), trial=trial))
    assert Limits().exceeded(replace(side(1.0), trial=trial)) == {}
    assert set(Limits().exceeded(replace(side(1.0), trial=replace(TRIAL, chatter=3.1)))) == {"chatter"}


def test_the_least_noise_is_searched_for_where_the_limit_is_not_reached(monkeypatch):
    asked = []

    def one_round(task, begun, progress):
        asked.append((task.noise_ceiling, task.least_noise))
        return {}, side(4.0 if task.least_noise else 5.0)

    monkeypatch.setattr(iterate, "_round", one_round)
    monkeypatch.setattr(Evaluation, "kept", property(lambda side: True))
    task = DesignTask(umbilical.load("ringdown", NOISE), [], "both", Demands(), 400.0, 50.0)
    outcome = iterate.design_within(task, Limits(), lambda share: None)
    assert outcome.side.noise.rms == 4.0
    assert asked[0] == (pytest.approx(2.94), False)
    assert asked[-1] == (np.inf, True)
    assert asked[1][0] < asked[0][0]
    assert iterate.design_within(task, Limits(noise=6.0), lambda share: None).quietest is None


@pytest.mark.slow
def test_design_for_noisy_sensors_keeps_the_voltages_calm_with_all_margins():
    """The same thrusters, with the gains of a design that knows no noise: 471 V."""
    from umbilical.synthesis.design import design

    found = design(umbilical.load("ringdown", NOISE), inner=True)
    assert found.met, found.missing
    assert found.after.trial.chatter < 3.0
    assert found.after.noise.rms < 3.0
    assert found.after.kept
    assert found.after.score.reflection < found.before.score.reflection
    seeds = [umbilical.load("ringdown", NOISE | {"seed": seed}).replace(found.values) for seed in (1, 2)]
    assert all(try_gains(scenario).chatter < 3.0 for scenario in seeds)
    short = {"duration": 15.0}
    assert try_gains(umbilical.load("ringdown", NOISE | FAST | short)).chatter > 100.0
