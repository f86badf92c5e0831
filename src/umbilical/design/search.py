"""The search for gains: differential evolution over a few knobs, the same result every time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from umbilical.analysis.sampled import SampledLoop, sampled_loop
from umbilical.design.score import SPARE, Judge, Score
from umbilical.scenario.scenario import Scenario

Objective = Literal["ringdown", "rejection", "both"]
SEED = 1
MEMBERS = 5
"""Members of the population per knob."""
DIGITS = 3
"""Significant digits of a gain that is found; more would say something about the search only."""
STRICTNESS = 30.0
"""Cost of a round trip 1 too large: a tenth of it outweighs any reflection."""


@dataclass(frozen=True)
class Knob:
    """A value of the scenario that may be chosen, between two bounds, in its own unit."""

    key: str
    low: float
    high: float


@dataclass(frozen=True)
class Found:
    """The best gains: by key, with their score; how many were tried."""

    values: dict[str, float]
    score: Score
    tried: int


def outer_knobs(scenario: Scenario, wave_speed: float) -> list[Knob]:
    """beta, k_a, both eps and k_s, as far as the periods allow."""
    period = scenario.control.outer_period or scenario.control.period
    mass = scenario.payload.mass
    return [
        Knob("control.law.slope_gain", 1e-3 * wave_speed, wave_speed),
        Knob("control.law.damping_gain", 0.1 * mass, 0.5 * mass / period),
        Knob("control.velocity_observer.time_constant", 2.0 * period, 100.0 * period),
        Knob("control.velocity_observer.damping", 1.0, 4.0),
        Knob("control.slope_observer.time_constant", 2.0 * period, 1000.0 * period),
        Knob("control.disturbance_observer.gain", 0.05, 0.5 / period),
    ]


def inner_knobs(scenario: Scenario) -> list[Knob]:
    """k_1, k_2 and the command filter, as far as the period allows beside the robust terms."""
    loop, fastest = scenario.control.motor_loop, 0.9 / scenario.control.period
    if loop is None or scenario.ideal_thruster:
        return []
    robust1 = loop.speed_bound * loop.robust_factor / loop.speed_width
    robust2 = loop.current_bound * loop.robust_factor / loop.current_width
    return [
        Knob("control.motor_loop.filter_frequency", 0.02 * fastest, fastest),
        Knob("control.motor_loop.speed_gain", 0.005 * fastest, fastest - robust1),
        Knob("control.motor_loop.current_gain", 0.01 * fastest, fastest - robust2),
    ]


def search(
    scenario: Scenario,
    knobs: Sequence[Knob],
    judge: Judge,
    objective: Objective,
    thrust: float,
    *,
    generations: int,
    progress: Callable[[float], None] | None = None,
) -> Found:
    """Gains that serve the objective best among those with the demanded margins.

    Args:
        scenario: everything that is not a knob; its own gains say what "no worse" means.
        knobs: what may be chosen.
        judge: scores a loop.
        objective: ``ringdown`` makes the ROV swallow waves; ``rejection`` keeps it still under force;
            ``both`` does the first without losing any of the second.
        thrust: steady thrust at which the motors are linearised, N.
        generations: of the search.
        progress: called with the share done.
    """
    from scipy.optimize import differential_evolution

    before = judge.score(sampled_loop(scenario, thrust))
    bounds = [(np.log(knob.low), np.log(knob.high)) for knob in knobs]
    done = 0

    def cost(x: np.ndarray) -> float:
        values = {knob.key: float(value) for knob, value in zip(knobs, np.exp(x), strict=True)}
        return _cost(judge.score(_loop(scenario, values, thrust)), before, objective)

    def told(x: np.ndarray, convergence: float) -> None:
        nonlocal done
        done += 1
        if progress:
            progress(min(1.0, done / generations))

    best = differential_evolution(
        cost, bounds, seed=SEED, popsize=MEMBERS, maxiter=generations, tol=0.0, polish=False, callback=told,
        init="sobol", mutation=(0.4, 0.9), recombination=0.8,
    )  # fmt: skip
    values = {knob.key: rounded(float(value)) for knob, value in zip(knobs, np.exp(best.x), strict=True)}
    return Found(values, judge.score(_loop(scenario, values, thrust)), int(best.nfev))


def _cost(score: Score, before: Score, objective: Objective) -> float:
    """Small is good: the objective, and what is missing to the margins."""
    missing = STRICTNESS * max(0.0, score.trip - SPARE) + 10.0 * abs(score.unstable)
    firmer = float(np.log(score.compliance / before.compliance))
    match objective:
        case "ringdown":
            return score.reflection + missing
        case "rejection":
            return firmer + 10.0 * max(0.0, score.reflection - before.reflection) + missing
    return score.reflection + 3.0 * max(0.0, firmer + 0.02) + missing


def _loop(scenario: Scenario, values: dict[str, float], thrust: float) -> SampledLoop:
    return sampled_loop(changed(scenario, values), thrust)


def changed(scenario: Scenario, values: dict[str, float]) -> Scenario:
    """The scenario with some numbers of its control replaced and no check made: for the search only."""
    control = scenario.control
    for key, value in values.items():
        _, section, name = key.split(".")
        part: Any = getattr(control, section)
        control = control.model_copy(update={section: part.model_copy(update={name: value})})
    return scenario.model_copy(update={"control": control})


def rounded(value: float) -> float:
    """A number to :data:`DIGITS` significant digits.

    >>> rounded(0.00123456)
    0.00123
    """
    return float(f"{value:.{DIGITS}g}")
