"""The best gains for given thrusters: searched for without a grid, then tried in a simulation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from umbilical.admission import admit
from umbilical.analysis.impedance import hanging_cable
from umbilical.analysis.margins import check, usual_lengths, usual_thrust
from umbilical.analysis.sampled import sampled_loop
from umbilical.design.margins import MarginReport, check_request, margins
from umbilical.design.score import Demands, Judge, Score
from umbilical.design.search import Objective, changed, inner_knobs, outer_knobs, search
from umbilical.design.trial import Trial, attempt
from umbilical.errors import Problem, ScenarioError
from umbilical.scenario.control import BoundaryLaw
from umbilical.scenario.scenario import Scenario

GENERATIONS = 90
SEARCH, TRIALS = 0.6, 0.3
"""Shares of the progress: search, both simulations; the margins have the rest."""
BETAS = 40
"""Values of beta in the picture of what the motors can follow."""


@dataclass(frozen=True)
class Limits:
    """What the motors shall not exceed in the trial; infinite where nothing is said.

    Attributes:
        voltage: V.
        speed: rad/s.
        chatter: RMS of a voltage above 10 Hz in the last third of the run, V.
    """

    voltage: float = np.inf
    speed: float = np.inf
    chatter: float = 0.05


@dataclass(frozen=True)
class Side:
    """A scenario before or after: its score, its margins at every length, its trial."""

    scenario: Scenario
    score: Score
    report: MarginReport
    trial: Trial

    @property
    def meets(self) -> bool:
        """Whether the demanded margins are there at every length, echoes in any phase."""
        return self.score.sound and self.report.stable


@dataclass(frozen=True)
class Design:
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

    objective: Objective
    values: dict[str, float]
    before: Side
    after: Side
    missing: tuple[str, ...]
    limited_by: str
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
    scenario: Scenario,
    objective: Objective = "both",
    *,
    inner: bool = False,
    demands: Demands | None = None,
    limits: Limits | None = None,
    operating_thrust: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> Design:
    """Choose beta, k_a, the observers' constants and k_s for the thrusters that a scenario has.

    Args:
        scenario: with the boundary law and its observers; its gains are where the search begins and what the
            result is compared with.
        objective: ``ringdown``: the ROV swallows the waves of the first modes; ``rejection``: it stays where it
            is under force; ``both``: the first, without losing any of the second.
        inner: choose the gains and the filter of the motor loops, too.
        demands: margins, at every length between the shortest of the run and an endless one.
        limits: on voltage, speed and chatter, looked at in a simulation of the scenario.
        operating_thrust: as for :func:`umbilical.design.margins.margins`.
        progress: called with the share done, 0 to 1.

    Raises:
        ScenarioError: the scenario has no boundary law with observers.
    """
    check_design(scenario)
    demands, limits = demands or Demands(), limits or Limits()
    lengths = usual_lengths(scenario)
    thrust = usual_thrust(scenario) if operating_thrust is None else operating_thrust
    check_request(scenario, lengths, thrust)
    judge = Judge(scenario, min(lengths), demands)
    knobs = outer_knobs(scenario, hanging_cable(scenario, lengths[0]).tip_wave_speed)
    knobs += inner_knobs(scenario) if inner else []
    tell = progress or (lambda share: None)
    found = search(
        scenario, knobs, judge, objective, thrust, generations=GENERATIONS, progress=lambda x: tell(SEARCH * x)
    )
    new = scenario.replace(found.values)
    admit(new)
    before = _side(scenario, judge, thrust, lambda x: tell(SEARCH + 0.5 * TRIALS * x))
    after = _side(new, judge, thrust, lambda x: tell(SEARCH + TRIALS * (0.5 + 0.5 * x)))
    betas = np.geomspace(1e-3, 1.0, BETAS) * hanging_cable(scenario, lengths[0]).tip_wave_speed
    scores = [judge.score(sampled_loop(changed(new, {"control.law.slope_gain": b}), thrust)) for b in betas]
    tell(1.0)
    return Design(
        objective=objective,
        values=found.values,
        before=before,
        after=after,
        missing=_missing(after, limits),
        limited_by=_limit(new, judge, thrust),
        betas=betas,
        reflections=np.array([score.reflection for score in scores]),
        followed=np.array([score.sound for score in scores]),
    )


def _side(scenario: Scenario, judge: Judge, thrust: float, progress: Callable[[float], None]) -> Side:
    report = margins(scenario, operating_thrust=thrust)
    trial = attempt(scenario, progress=progress)
    return Side(scenario, judge.score(sampled_loop(scenario, thrust)), report, trial)


def _missing(after: Side, limits: Limits) -> tuple[str, ...]:
    """What the new gains do not reach."""
    trial, found = after.trial, []
    if not after.meets:
        change, frequency = after.score.binding
        found.append(f"the margin '{change}' is missed at {frequency:.3g} rad/s")
    if not trial.completed:
        return (*found, f"the simulation did not complete: {trial.run.reason}")
    for name, value, limit, unit in (
        ("voltage", trial.voltage_peak, limits.voltage, "V"),
        ("speed", trial.speed_peak, limits.speed, "rad/s"),
        ("chatter", trial.chatter, limits.chatter, "V"),
    ):
        if value > limit:
            found.append(
                f"{name} {value:.3g} {unit} above the limit of {limit:.3g} {unit}: the thrusters are the limit"
            )
    return tuple(found)


def _limit(scenario: Scenario, judge: Judge, thrust: float) -> str:
    """Which margin is used up first, and by whose lag."""
    loop = sampled_loop(scenario, thrust)
    score = judge.score(loop)
    change, frequency = score.binding
    where = f"the margin '{change}' at {frequency:.3g} rad/s is used up first"
    if not loop.drives:
        return f"{where}; the thruster is ideal, so observers and sampling are the limit"
    motors, hold = judge.motor_lag(loop, frequency)
    ideal = judge.score(sampled_loop(scenario.model_copy(update={"ideal_thruster": True}), thrust))
    lag = f"{np.degrees(motors):.0f} degrees of lag are the motors', {np.degrees(hold):.0f} the sampling's"
    spare = "the thrusters are the limit" if ideal.trip < score.trip else "with ideal thrusters it would be no better"
    return f"{where}; there {lag}: {spare}"


def check_design(scenario: Scenario) -> None:
    """Refuse a scenario whose controller has none of the gains that are chosen here.

    Raises:
        ScenarioError: no boundary law, or one without its observers.
    """
    check(scenario)
    control, law = scenario.control, scenario.control.law
    observed = control.velocity_observer and control.slope_observer and control.disturbance_observer
    if not isinstance(law, BoundaryLaw) or law.rates != "observer" or not observed:
        raise ScenarioError(
            [
                Problem(
                    "control.law",
                    law.kind,
                    "the boundary law with velocity, slope and disturbance observer",
                    "beta, k_a, the observers' constants and k_s are what a design chooses",
                    "kind = 'boundary', rates = 'observer' and all three observers",
                )
            ],
            scenario.name,
        )
