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
DETERMINISTIC: dict[str, Any] = {"seed": 1}  # scipy renames this argument; both names are understood
MEMBERS = 6
"""Members of the population per knob."""
DIGITS = 4
"""Significant digits of a gain that is found; more would say something about the search only."""
STRICTNESS = 100.0
"""Cost of a round trip 1 too large: a tenth of it outweighs any reflection."""
FIRMER = 0.02
"""By so much, in logarithms, the ROV shall be held firmer than before where both are asked for."""
LOCAL_STEPS = 40


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
        Knob("control.slope_observer.damping", 1.0, 4.0),
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
    from scipy.optimize import differential_evolution, minimize

    before = judge.score(sampled_loop(scenario, thrust))
    bounds = [(np.log(knob.low), np.log(knob.high)) for knob in knobs]
    begun = np.clip(np.log([_present(scenario, knob.key) for knob in knobs]), *np.transpose(bounds))
    count = Counter(lambda x: judge.score(_loop(scenario, _values(knobs, x), thrust)), generations, progress)
    best = differential_evolution(
        lambda x: _cost(count.score(x), before, objective), bounds, x0=begun, popsize=MEMBERS, **DETERMINISTIC,
        maxiter=generations, tol=0.0, polish=False, callback=count.generation, mutation=(0.5, 1.0), recombination=0.7,
    )  # fmt: skip
    # A population comes near the edge of what is allowed; a local search follows it.
    local = minimize(
        lambda x: _objective(count.score(x), before, objective), best.x, method="SLSQP", bounds=bounds,
        constraints={"type": "ineq", "fun": lambda x: _room(count.score(x), before, objective)},
        options={"maxiter": LOCAL_STEPS, "ftol": 1e-5},
    )  # fmt: skip
    x = min((best.x, local.x), key=lambda x: _cost(count.score(x), before, objective))
    values = {key: rounded(value) for key, value in _values(knobs, x).items()}
    return Found(values, judge.score(_loop(scenario, values, thrust)), count.tried)


class Counter:
    """Scores, the last one remembered, and news of how far the search is."""

    def __init__(
        self, judged: Callable[[np.ndarray], Score], generations: int, progress: Callable[[float], None] | None
    ) -> None:
        self.tried = 0
        self._judged, self._generations, self._progress = judged, generations, progress
        self._last: tuple[bytes, Score] | None = None
        self._done = 0

    def score(self, x: np.ndarray) -> Score:
        """Score at a point in the logarithms of the knobs."""
        if self._last is None or self._last[0] != x.tobytes():
            self._last = (x.tobytes(), self._judged(x))
            self.tried += 1
        return self._last[1]

    def generation(self, x: np.ndarray, convergence: float) -> None:
        """One generation is done."""
        self._done += 1
        if self._progress:
            self._progress(min(1.0, self._done / self._generations))


def _values(knobs: Sequence[Knob], x: np.ndarray) -> dict[str, float]:
    return {knob.key: float(value) for knob, value in zip(knobs, np.exp(x), strict=True)}


def _present(scenario: Scenario, key: str) -> float:
    _, section, name = key.split(".")
    return float(getattr(getattr(scenario.control, section), name))


def _objective(score: Score, before: Score, objective: Objective) -> float:
    """What shall be small."""
    return float(np.log(score.compliance / before.compliance)) if objective == "rejection" else score.reflection


def _room(score: Score, before: Score, objective: Objective) -> np.ndarray:
    """What must not be negative: distance of every round trip from 1, and no loss in what is not the objective."""
    room = np.log(SPARE / score.trips)
    match objective:
        case "ringdown":
            return room
        case "rejection":
            return np.append(room, before.reflection - score.reflection)
    return np.append(room, np.log(before.compliance / score.compliance) - FIRMER)


def _cost(score: Score, before: Score, objective: Objective) -> float:
    """Objective and what is missing to the rest in one number."""
    missing = np.maximum(0.0, -_room(score, before, objective)).sum()
    return _objective(score, before, objective) + STRICTNESS * float(missing) + 10.0 * abs(score.unstable)


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
    0.001235
    """
    return float(f"{value:.{DIGITS}g}")
