"""The best gains for given thrusters: searched for without a grid, then tried in a simulation."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from umbilical.errors import Problem, ScenarioError, expect
from umbilical.library import admit
from umbilical.result import ResultFaces
from umbilical.scenario.scenario import Scenario
from umbilical.stability.impedance import hanging_cable
from umbilical.stability.judgement import check_loop, usual_lengths, usual_thrust
from umbilical.stability.margins import check_request
from umbilical.stability.sampled import sampled_loop
from umbilical.synthesis.iterate import DesignOutcome, Evaluation, Limits, badness, design_within, evaluate_gains
from umbilical.synthesis.periods import pace, paced
from umbilical.synthesis.score import Demands, Score
from umbilical.synthesis.search import DesignTask, Objective, Values, inner_knobs

UNITS = {"voltage": "V", "speed": "rad/s", "chatter": "V", "noise": "V"}
"""Of the limits."""
NOTED_NOISE = 0.8
"""Share of the limit on noise from which on it is named among what holds the objective back."""
SEARCH = 0.85
"""Share of the progress; the simulation of the scenario as it was has most of the rest."""
BETAS = 40
"""Values of beta in the picture of what the motors can follow."""


@dataclass(frozen=True)
class Design(ResultFaces):
    """Gains that were found, and what they change.

    Attributes:
        objective: what was asked for.
        values: new value of each key.
        before, after: both sides.
        missing: what the new gains do not reach, in words; empty where all is met.
        limited_by: what keeps the objective from being served better, in words.
        betas, reflections, followed: for the picture: beta, m/s; largest \\|R\\| of the first modes; whether
            motors, observers and sampling follow with the demanded margins. The other gains are the new ones.
    """

    shown_by: ClassVar[str] = "umbilical.faces.design"
    drawn_by: ClassVar[str] = "plot_design"

    objective: Objective
    values: dict[str, float]
    before: Evaluation
    after: Evaluation
    missing: tuple[str, ...]
    limited_by: tuple[str, ...]
    betas: np.ndarray
    reflections: np.ndarray
    followed: np.ndarray

    @property
    def met(self) -> bool:
        """Whether every margin and every limit is kept."""
        return not self.missing

    def patch(self) -> str:
        """The new values as TOML tables, to be put into a scenario file."""
        tables: dict[str, list[str]] = {}
        for key, value in self.values.items():
            table, name = key.rsplit(".", 1)
            tables.setdefault(table, []).append(f"{name} = {value!r}")
        return "\n".join("\n".join([f"[{table}]", *lines, ""]) for table, lines in tables.items())


def design(
    scenario: Scenario, objective: Objective = "both", *, inner: bool = False, periods: Sequence[float] = (),
    demands: Demands | None = None, limits: Limits | None = None, operating_thrust: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> Design:  # fmt: skip
    """Choose beta, k_a, the observers' constants and k_s for the thrusters that a scenario has.

    Args:
        scenario: with the boundary law and its observers; its gains are where the search begins and what the
            result is compared with.
        objective: ``ringdown``: the ROV swallows the waves of the first modes; ``rejection``: it stays where it
            is under force; ``both``: the first, without losing any of the second.
        inner: choose the gains and the filter of the motor loops, too.
        periods: control periods to choose among, s; the scenario's own if left out. An outer period stays the same
            number of them. Every one is a search of its own.
        demands: margins, at every length between the shortest of the run and an endless one.
        limits: on voltage, speed and chatter in a simulation of the scenario; where gains exceed them, the search
            is repeated with less effort of the motors. And on the noise that sensors put on a voltage, which every
            search keeps.
        operating_thrust: as for :func:`umbilical.stability.margins.margins`.
        progress: called with the share done, 0 to 1.

    Raises:
        ScenarioError: the scenario has no boundary law with observers, or a period cannot be its own.

    The search takes minutes::

        from umbilical.synthesis.iterate import Limits

        found = umbilical.design(umbilical.load("ringdown"), inner=True, limits=Limits(voltage=60.0))
        print(found.met, found.missing, found.patch())
    """
    check_design(scenario)
    demands, limits = demands or Demands(), limits or Limits()
    lengths = usual_lengths(scenario)
    thrust = usual_thrust(scenario) if operating_thrust is None else operating_thrust
    check_request(scenario, lengths, thrust)
    wave_speed = hanging_cable(scenario, lengths[0]).tip_wave_speed
    base = DesignTask(scenario, (), objective, demands, min(lengths), thrust, present=scenario)
    paces = [pace(scenario, period) for period in periods] or [{}]
    tasks = [paced(base, new, wave_speed, inner=inner) for new in paces]
    tell = progress or (lambda share: None)
    outcomes = [
        design_within(task, limits, lambda x, k=k: tell(SEARCH * (k + x) / len(tasks))) for k, task in enumerate(tasks)
    ]
    best = min(range(len(tasks)), key=lambda k: _rank(outcomes[k], limits, objective))
    task, found = tasks[best], outcomes[best]
    admit(found.side.scenario)
    before = evaluate_gains(base, {}, lambda x: tell(SEARCH + (1.0 - SEARCH) * x))
    betas = np.geomspace(1e-3, 1.0, BETAS) * wave_speed
    scores = _scores_over(betas, task, found.values)
    motor_gains_kept = bool(inner_knobs(task.scenario)) and not inner
    return Design(
        objective=objective, values=paces[best] | found.values, before=before, after=found.side,
        missing=tuple(_missing(found, limits)),
        limited_by=tuple(_limited_by(task, found, limits, motor_gains_kept=motor_gains_kept)), betas=betas,
        reflections=np.array([score.reflection for score in scores]),
        followed=np.array([score.sound for score in scores]),
    )  # fmt: skip


def _rank(found: DesignOutcome, limits: Limits, objective: Objective) -> tuple[tuple[bool, bool, float], float]:
    """What of two periods is the better: all that was demanded comes first, then the objective."""
    score = found.side.score
    return badness(found.side, limits), score.compliance if objective == "rejection" else score.reflection


def _scores_over(betas: np.ndarray, task: DesignTask, values: Values) -> list[Score]:
    scorer = task.scorer()
    return [scorer.score(task.loop(values | {"control.law.slope_gain": float(beta)})) for beta in betas]


def _missing(found: DesignOutcome, limits: Limits) -> Iterator[str]:
    """What the new gains do not reach, and what was searched for it."""
    after = found.side
    change, frequency = after.score.binding
    if not after.meets:
        yield f"the demanded margins are missed; '{change}' at {frequency:.3g} rad/s is used up first"
    elif not after.score.sound:
        yield f"the margin '{change}' is missed at some other length, by waves of {frequency:.3g} rad/s"
    if not after.trial.completed:
        yield f"the simulation did not complete: {after.trial.run.reason}"
    for name, (value, limit) in limits.exceeded(after).items():
        unit = UNITS[name]
        searched = "; searches under lower ceilings found no gains that keep it" if name in found.limited else ""
        yield f"{name} {value:.3g} {unit} above the limit of {limit:.3g} {unit}{searched}"
    if found.quietest and (not after.kept or after.noise.rms > limits.noise):
        margins = "kept" if found.quietest.kept else "missed"
        yield f"a search for the least noise of a voltage ended at {found.quietest.noise.rms:.3g} V, margins {margins}"


def _limited_by(task: DesignTask, found: DesignOutcome, limits: Limits, *, motor_gains_kept: bool) -> Iterator[str]:
    """What keeps the objective from being served better."""
    if found.limited and found.side is not found.unlimited:
        yield (
            f"the limit on {' and '.join(found.limited)}: without, the first modes' reflection were"
            f" {found.unlimited.score.reflection:.4g} and the ROV per force {found.unlimited.score.compliance:.3g} m/N"
        )
    noise = found.side.noise
    if noise.rms > NOTED_NOISE * limits.noise:
        yield (
            f"the limit on noise: sensors put {noise.rms:.3g} of {limits.noise:.3g} V on a motor at a thrust of"
            f" {noise.thrust:.3g} N and {noise.length:g} m"
        )
    yield _used_up_first(task, found.side)
    if motor_gains_kept:
        yield "the gains of the motor loops, which were kept: --inner chooses them, too, and may serve better"


def _used_up_first(task: DesignTask, after: Evaluation) -> str:
    """Which margin is used up first, and by whose lag."""
    scorer, loop = task.scorer(), sampled_loop(after.scenario, task.thrust)
    change, frequency = after.score.binding
    where = f"the margin '{change}' at {frequency:.3g} rad/s is used up first"
    if not loop.drives:
        return f"{where}; the thruster is ideal"
    motors, hold = scorer.motor_lag(loop, frequency)
    ideal = scorer.score(sampled_loop(after.scenario.model_copy(update={"ideal_thruster": True}), task.thrust))
    lag = f"the motors lag by {np.degrees(motors):.0f} deg, the sampling by {np.degrees(hold):.0f} deg"
    better = "more" if ideal.trip < after.score.trip else "no more"
    return f"{where}; there {lag}; with the same gains ideal thrusters would leave {better} of it"


def check_design(scenario: Scenario) -> None:
    """Refuse a scenario whose controller has none of the gains that are chosen here.

    Raises:
        ScenarioError: no boundary law, or one without its observers.
    """
    expect(scenario, "Scenario", "load")
    control, law = scenario.control, scenario.control.law
    observed = control.velocity_observer and control.slope_observer and control.disturbance_observer
    if not law.boundary_gains or law.reads_rates or not observed:
        wanted = "the boundary law with velocity, slope and disturbance observer"
        reason = "beta, k_a, the observers' constants and k_s are what a design chooses"
        fix = "kind = 'boundary', rates = 'observer' and all three observers, as in `umbilical presets --copy paper`"
        raise ScenarioError([Problem("control.law", law.kind, wanted, reason, fix)], scenario.name)
    check_loop(scenario)
