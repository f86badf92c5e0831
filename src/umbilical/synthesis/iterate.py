"""Rounds of search and simulation: gains with the demanded margins that also keep limits of the motors.

The search sees the linear loop only. What a simulation says of its gains tells how much effort the limits allow,
and the next round searches below that.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from umbilical.scenario.scenario import Scenario
from umbilical.stability.judgement import usual_lengths
from umbilical.stability.margins import MarginReport, margins
from umbilical.stability.sampled import sampled_loop
from umbilical.synthesis.noise import NO_NOISE, VoltageNoise, voltage_noise
from umbilical.synthesis.score import Demands, Effort, Score, Scorer
from umbilical.synthesis.search import DesignTask, Values, explore, refine, to_digits
from umbilical.synthesis.trial import DesignTrial, try_gains

GENERATIONS = 90
ROUNDS = 4
RESERVES = (1.0, 2.0, 4.0)
"""How many reserves are asked for, one after the other, until rounded gains keep the margins."""
SAFER = 0.95
"""A ceiling is so much of what the last simulation would allow: effort and simulation are not proportional."""
TAMER = 0.5
"""The same where a simulation did not come to its end and says nothing else."""
SAFE_NOISE = 0.98
"""A search's share of the limit on noise: its frequencies are few and its gains not rounded yet."""
EXPLAINED = 1.1
"""So much more noise in a simulation than predicted is still the sensors': both are estimates."""
SEARCH, STEPS, TRIAL = 0.5, 0.2, 0.3
"""Shares of a round's progress; further steps with more reserve are seldom needed and not in it."""
LIKELY = 0.6
"""Share of the progress still ahead that a round is given: mostly there is one only."""

Excess = dict[str, tuple[float, float]]
"""Value and limit of what is too large, by name."""


@dataclass(frozen=True)
class Limits:
    """What the motors shall not exceed in the trial; infinite where nothing is said.

    Attributes:
        voltage: V.
        speed: rad/s.
        chatter: RMS of a voltage above 10 Hz in the last third of the run, V, beside what sensors' noise explains.
        noise: RMS of a voltage above 10 Hz from sensors' noise, V, as the linear loop has it where it is worst.
    """

    voltage: float = np.inf
    speed: float = np.inf
    chatter: float = 0.05
    noise: float = 3.0

    def exceeded(self, side: Evaluation) -> Excess:
        """What is too large; nothing is, where there is no number."""
        trial, noise = side.trial, side.noise.rms
        limits = {
            "voltage": (trial.voltage_peak, self.voltage),
            "speed": (trial.speed_peak, self.speed),
            "chatter": (trial.chatter, float(np.hypot(self.chatter, min(EXPLAINED * noise, self.noise)))),
            "noise": (noise, self.noise),
        }
        return {name: (x, limit) for name, (x, limit) in limits.items() if x > limit}


@dataclass(frozen=True)
class Evaluation:
    """A scenario before or after: its score, its margins at every length that is asked for, its trial, its noise.

    The noise is the worst of all these lengths, at rest, at the operating thrust and at the trial's highest speed.
    """

    scenario: Scenario
    demands: Demands
    score: Score
    report: MarginReport
    trial: DesignTrial
    noise: VoltageNoise = NO_NOISE

    @property
    def meets(self) -> bool:
        """Whether the loop has the demanded margins at the lengths of the report."""
        period = self.scenario.control.period
        return all(self.demands.met_by(j.margins, period) for j in self.report.judgements)

    @property
    def kept(self) -> bool:
        """Whether it has them there and, echoes in any phase, at every length in between and beyond."""
        return self.meets and self.score.sound


@dataclass(frozen=True)
class DesignOutcome:
    """What the rounds have led to.

    Attributes:
        values: the new gains.
        side: the scenario with them.
        unlimited: the scenario with those of the first round, which knew of no limit.
        limited: names of the limits under which was searched.
        quietest: the scenario with the gains of a search for the least noise, where there was one.
    """

    values: Values
    side: Evaluation
    unlimited: Evaluation
    limited: tuple[str, ...]
    quietest: Evaluation | None = None


def evaluate_gains(task: DesignTask, values: Values, progress: Callable[[float], None] | None = None) -> Evaluation:
    """A scenario with some values, judged and tried."""
    new = task.scenario.replace(values)
    score = Scorer(task.scenario, task.shortest, task.demands).score(sampled_loop(new, task.thrust))
    trial = try_gains(new, progress=progress)
    fastest = sum(abs(motor.thrust_coefficient) for motor in new.motors) * trial.speed_peak**2
    noise = worst_noise(task, new, [thrust for thrust in (0.0, task.thrust, fastest) if np.isfinite(thrust)])
    return Evaluation(new, task.demands, score, _report(task, values), trial, noise)


def worst_noise(task: DesignTask, scenario: Scenario, thrusts: Sequence[float]) -> VoltageNoise:
    """The largest noise of a voltage at the lengths of the run and at some thrusts, N."""
    scorers = [Scorer(scenario, length, task.demands) for length in usual_lengths(scenario)]
    return max(voltage_noise(scorer, sampled_loop(scenario, task.thrust), scenario, thrusts) for scorer in scorers)


def _report(task: DesignTask, values: Values) -> MarginReport:
    return margins(task.scenario.replace(values), operating_thrust=task.thrust)


def design_within(task: DesignTask, limits: Limits, progress: Callable[[float], None]) -> DesignOutcome:
    """The best gains of a task that keep the limits, or those that exceed them least."""
    noisy = np.isfinite(limits.noise) and worst_noise(task, task.scenario, (0.0, task.thrust)).rms > 0.0
    if noisy:
        task = replace(task, noise_ceiling=SAFE_NOISE * limits.noise)
    tried: list[tuple[Values, Evaluation]] = []
    names: set[str] = set()
    done, quietest = 0.0, None
    for _ in range(ROUNDS):
        ahead = LIKELY * (1.0 - done)
        tried.append(_round(task, tried[-1][0] if tried else None, _part(progress, done, ahead)))
        done += ahead
        now = tried[-1][1]
        over = limits.exceeded(now)
        if not now.kept or (now.trial.completed and not over) or "noise" in names & set(over):
            break
        names |= set(over)
        task = replace(task, **_lowered(task, now, over))
    if noisy and (not now.kept or "noise" in limits.exceeded(now)):
        calmest = replace(task, noise_ceiling=np.inf, least_noise=True)
        tried.append(_round(calmest, tried[0][0], _part(progress, done, 1.0 - done)))
        quietest = tried[-1][1]
    values, best = min(tried, key=lambda pair: badness(pair[1], limits))
    return DesignOutcome(values, best, tried[0][1], tuple(sorted(names)) if len(tried) > 1 else (), quietest)


def _round(task: DesignTask, begun: Values | None, progress: Callable[[float], None]) -> tuple[Values, Evaluation]:
    eager = replace(task, demands=task.demands.beyond(RESERVES[0]))
    near = explore(eager, generations=GENERATIONS, begun=begun, progress=_part(progress, 0.0, SEARCH))
    values = _settled(task, near, _part(progress, SEARCH, STEPS))
    return values, evaluate_gains(task, values, _part(progress, 1.0 - TRIAL, TRIAL))


def _settled(task: DesignTask, near: Values, progress: Callable[[float], None]) -> Values:
    """Rounded gains that keep the demands: at the edge of what is allowed, and further inside where they do not."""
    values, period = near, task.scenario.control.period
    for reserves in RESERVES:
        values = refine(replace(task, demands=task.demands.beyond(reserves)), near, progress)
        if task.scorer().score(task.loop(values)).sound and all(
            task.demands.met_by(j.margins, period) for j in _report(task, values).judgements
        ):
            break
    return values


def _lowered(task: DesignTask, now: Evaluation, over: Excess) -> dict[str, Effort | float]:
    """Ceilings under which the next gains should keep the limits that these exceed, or run to the end."""
    shares = {name: SAFER * limit / x for name, (x, limit) in over.items()}
    quieter = shares.pop("noise", 1.0)
    if not now.trial.completed:
        shares = {"voltage": TAMER, "speed": TAMER}
    efforts = {name: to_digits(x * getattr(now.score.effort, name)) for name, x in shares.items()}
    ceilings = Effort(**task.ceilings._asdict() | efforts)
    return {"ceilings": ceilings, "noise_ceiling": to_digits(quieter * task.noise_ceiling)}


def badness(found: Evaluation, limits: Limits) -> tuple[bool, bool, float]:
    """Margins come first, then a run to its end, then the largest excess over a limit."""
    excess = max((x / limit for x, limit in limits.exceeded(found).values()), default=1.0)
    return (not found.kept, not found.trial.completed, excess)


def _part(progress: Callable[[float], None], begun: float, share: float) -> Callable[[float], None]:
    """Progress of a part of the work."""
    return lambda x: progress(begun + share * x)
