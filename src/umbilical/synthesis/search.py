"""The search for gains: differential evolution, then random steps, over a few knobs; the same result everywhere.

The last bits of a number depend on the processor, and a score near a double pole turns them into its eighth digit. A
local search that takes differences of scores makes other gains of that, above all in directions that hardly matter.
So a search only compares scores, of points that are rounded, and a point is better only where it is clearly so.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

import numpy as np

from umbilical.relations.water import payload_inertia
from umbilical.scenario.scenario import Scenario
from umbilical.stability.sampled import SampledLoop, sampled_loop
from umbilical.synthesis.noise import voltage_noise
from umbilical.synthesis.score import SPARE, Demands, Effort, Score, Scorer

Objective = Literal["ringdown", "rejection", "both"]
Values = dict[str, float]
"""Numbers of a scenario by their keys."""
NO_CEILINGS = Effort(np.inf, np.inf, np.inf)
DETERMINISTIC: dict[str, Any] = {"seed": 1}  # scipy renames this argument; both names are understood
MEMBERS = 6
"""Members of the population per knob."""
DIGITS = 4
"""Significant digits of a gain that is found; more would say something about the search only."""
POINT_DIGITS, VALUE_DIGITS = 9, 8
"""Decimals of a knob's logarithm and of what is asked of it; the processor moves the 8th to the 13th."""
BETTER = 1e-6
"""Gain in cost from which on a step is taken: far above what the processor moves."""
STRICTNESS = 100.0
"""Cost of a round trip 1 too large: a tenth of it outweighs any reflection."""
CALMNESS = 10.0
"""Cost of noise e times too large: less than of a margin, which comes first where there is no keeping both."""
WORST = 1e4
"""Cost of an unstable pole: nothing else means anything then."""
FIRMER = 0.02
"""By so much, in logarithms, the ROV shall be held firmer than before where both are asked for."""
LOCAL_STEPS = 700
STEP, SMALLEST_STEP = 0.1, 2e-3
"""Standard deviation of a random step in a knob's logarithm: the first, and the smallest."""
LONGER, SHORTER, FURTHER = 1.3, 0.94, 1.5
"""Factors of the step after success and after failure, and of a step that is tried again where it helped."""


@dataclass(frozen=True)
class Knob:
    """A value of the scenario that may be chosen, between two bounds, in its own unit."""

    key: str
    low: float
    high: float


def outer_knobs(scenario: Scenario, wave_speed: float) -> list[Knob]:
    """beta, k_a, both eps and k_s, as far as the periods allow."""
    period = scenario.control.outer_period or scenario.control.period
    mass = payload_inertia(scenario.payload)
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
    """k_1, k_2 and the command filter, as far as the period allows beside the robust terms.

    The robust terms are in the linear loop, but fade at large errors: the gains shall be no less than they.
    """
    loop, fastest = scenario.control.motor_loop, 0.9 / scenario.control.period
    if loop is None or scenario.ideal_thruster:
        return []
    robust1 = loop.speed_bound * loop.robust_factor / loop.speed_width
    robust2 = loop.current_bound * loop.robust_factor / loop.current_width
    return [
        Knob("control.motor_loop.filter_frequency", 0.02 * fastest, fastest),
        Knob("control.motor_loop.speed_gain", max(robust1, 0.01 * fastest), fastest - robust1),
        Knob("control.motor_loop.current_gain", max(robust2, 0.01 * fastest), fastest - robust2),
    ]


@dataclass(frozen=True)
class DesignTask:
    """What is searched for, and within which bounds.

    Attributes:
        scenario: everything that is not a knob.
        knobs: what may be chosen.
        objective: ``ringdown`` makes the ROV swallow waves; ``rejection`` keeps it still under force;
            ``both`` does the first without losing any of the second.
        demands: margins that the gains shall leave.
        shortest: length of the cable from which on they shall be there, m.
        thrust: steady thrust at which the motors are linearised, N.
        ceilings: largest effort of the motors, in its own units.
        present: whose gains and periods say what "no worse" means; the scenario if left out.
        noise_ceiling: largest noise of a voltage above 10 Hz, V, at rest and at ``thrust``.
        least_noise: whether that noise shall be as small as possible, whatever the objective is.
    """

    scenario: Scenario
    knobs: Sequence[Knob]
    objective: Objective
    demands: Demands
    shortest: float
    thrust: float
    ceilings: Effort = NO_CEILINGS
    present: Scenario | None = None
    noise_ceiling: float = np.inf
    least_noise: bool = False

    def scorer(self, *, quick: bool = False) -> Scorer:
        """Scorer of a loop by the demands; of its effort where ceilings ask for that."""
        return Scorer(self.scenario, self.shortest, self.demands, quick=quick, efforts=self.ceilings != NO_CEILINGS)

    def loop(self, values: dict[str, float]) -> SampledLoop:
        """The loop with other values."""
        return sampled_loop(changed(self.scenario, values), self.thrust)

    def values(self, x: np.ndarray) -> dict[str, float]:
        """The knobs at a point in their logarithms."""
        return {knob.key: float(value) for knob, value in zip(self.knobs, np.exp(x), strict=True)}

    @property
    def bounds(self) -> list[tuple[float, float]]:
        """Of the knobs' logarithms."""
        return [(float(np.log(knob.low)), float(np.log(knob.high))) for knob in self.knobs]


def explore(
    task: DesignTask, *, generations: int, begun: Values | None = None, progress: Callable[[float], None] | None = None
) -> Values:
    """Gains near the best ones among those with the demanded margins, ranked quickly.

    Args:
        task: what is searched for.
        generations: of the search.
        begun: where it begins; at the scenario's own gains if left out.
        progress: called with the share done.
    """
    from scipy.optimize import differential_evolution

    point = _point(task, begun or {knob.key: _present(task.scenario, knob.key) for knob in task.knobs})
    scores = Scores(task, task.scorer(quick=True), generations, progress)
    best = differential_evolution(
        scores.cost, task.bounds, x0=point, popsize=MEMBERS, **DETERMINISTIC, maxiter=generations, tol=0.0,
        polish=False, callback=scores.generation, mutation=(0.5, 1.0), recombination=0.7,
    )  # fmt: skip
    return task.values(best.x)


def refine(task: DesignTask, begun: Values, progress: Callable[[float], None] | None = None) -> Values:
    """From gains near the best ones to the edge of what is allowed, judged on many frequencies, and rounded."""
    scores = Scores(task, task.scorer(), LOCAL_STEPS, progress)
    best = _stepwise(scores, _point(task, begun), *_inside(task))
    return {key: to_digits(value) for key, value in task.values(best).items()}


def _stepwise(scores: Scores, x: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """A point reached by random steps of some knobs; a step that helped is tried again, further."""
    draw, size, least = np.random.default_rng(1), STEP, scores.cost(x)
    again = np.zeros_like(x)
    for _ in range(LOCAL_STEPS):
        repeated = bool(again.any())
        tried = np.clip(x + (again if repeated else size * _some(draw, x.size)), low, high)
        cost = scores.cost(tried, least - BETTER)
        better = cost < least - BETTER
        size = max(SMALLEST_STEP, size * (LONGER if better else 1.0 if repeated else SHORTER))
        again = FURTHER * (tried - x) if better else np.zeros_like(x)
        x, least = (tried, cost) if better else (x, least)
        scores.generation(x, 0.0)
    return x


def _some(draw: np.random.Generator, knobs: int) -> np.ndarray:
    """Standard normal numbers for some of the knobs, at least one, and zeros for the others."""
    chosen = draw.permutation(knobs) < draw.integers(1, knobs + 1)
    return np.where(chosen, draw.standard_normal(knobs), 0.0)


def _inside(task: DesignTask) -> np.ndarray:
    """The bounds, a little narrower, so that rounding takes no point out again; shape (2, knobs)."""
    low, high = np.transpose(task.bounds)
    return np.stack([low + 1e-9, high - 1e-9])


def _point(task: DesignTask, values: Values) -> np.ndarray:
    """The logarithms of values, moved just inside the bounds."""
    return np.clip(np.log([values[knob.key] for knob in task.knobs]), *_inside(task))


class Scores:
    """What a search asks of a point in the logarithms of the knobs; every score is remembered."""

    def __init__(
        self, task: DesignTask, scorer: Scorer, generations: int = 0, progress: Callable[[float], None] | None = None
    ) -> None:
        self._task, self._judge = task, scorer
        self._generations, self._progress, self._done = generations, progress, 0
        self._before = self._judge.score(sampled_loop(task.present or task.scenario, task.thrust))
        self._scored, self._heard = cache(self._score), cache(self._noise)

    def score(self, x: np.ndarray) -> Score:
        """All of it."""
        return self._scored(np.round(x, POINT_DIGITS).tobytes())

    def noise(self, x: np.ndarray) -> float:
        """Of a voltage, at rest and at the operating thrust, V."""
        return self._heard(np.round(x, POINT_DIGITS).tobytes())

    def _score(self, point: bytes) -> Score:
        return self._judge.score(self._task.loop(self._task.values(np.frombuffer(point))))

    def _noise(self, point: bytes) -> float:
        task, values = self._task, self._task.values(np.frombuffer(point))
        new = changed(task.scenario, values)
        return voltage_noise(self._judge, task.loop(values), new, (0.0, task.thrust)).rms

    def objective(self, x: np.ndarray) -> float:
        """What shall be small."""
        if self._task.least_noise:
            return round(float(np.log(self.noise(x))), VALUE_DIGITS)
        score = self.score(x)
        rejection = self._task.objective == "rejection"
        value = float(np.log(score.compliance / self._before.compliance)) if rejection else score.reflection
        return round(value, VALUE_DIGITS)

    def room(self, x: np.ndarray) -> np.ndarray:
        """What must not be negative: round trips below 1, efforts below ceilings, nothing lost beside the aim."""
        score = self.score(x)
        asked = [(e, c) for e, c in zip(score.effort, self._task.ceilings, strict=True) if np.isfinite(c)]
        room = [*np.log(SPARE / score.trips), *(np.log(ceiling / effort) for effort, ceiling in asked)]
        match self._task.objective:
            case "rejection":
                room.append(self._before.reflection - score.reflection)
            case "both":
                room.append(np.log(self._before.compliance / score.compliance) - FIRMER)
        return np.round(room, VALUE_DIGITS)

    def calm(self, x: np.ndarray) -> float:
        """What the noise leaves of its ceiling, as a logarithm."""
        ceiling = self._task.noise_ceiling
        return round(float(np.log(ceiling / self.noise(x))), VALUE_DIGITS) if np.isfinite(ceiling) else 0.0

    def cost(self, x: np.ndarray, enough: float = np.inf) -> float:
        """Objective and what is missing to the rest in one number; of one that is large enough without it, no noise."""
        missing = float(np.maximum(0.0, -self.room(x)).sum())
        quiet = self.objective(x) + STRICTNESS * missing + WORST * abs(self.score(x).unstable)
        return quiet if quiet >= enough else quiet + CALMNESS * max(0.0, -self.calm(x))

    def generation(self, x: np.ndarray, convergence: float) -> None:
        """One generation is done."""
        self._done += 1
        if self._progress:
            self._progress(min(1.0, self._done / self._generations))


def _present(scenario: Scenario, key: str) -> float:
    _, section, name = key.split(".")
    return float(getattr(getattr(scenario.control, section), name))


def changed(scenario: Scenario, values: Values) -> Scenario:
    """The scenario with some numbers of its control replaced and no check made: for the search only."""
    control = scenario.control
    for key, value in values.items():
        _, section, name = key.split(".")
        part: Any = getattr(control, section)
        control = control.model_copy(update={section: part.model_copy(update={name: value})})
    return scenario.model_copy(update={"control": control})


def to_digits(value: float) -> float:
    """A number to :data:`DIGITS` significant digits.

    >>> to_digits(0.00123456)
    0.001235
    """
    return float(f"{value:.{DIGITS}g}")
