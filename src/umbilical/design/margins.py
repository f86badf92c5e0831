"""Margins of a scenario over its lengths."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from umbilical.analysis.impedance import hanging_cable
from umbilical.analysis.margins import Judgement, check, judge_loop, usual_lengths, usual_thrust
from umbilical.analysis.sampled import sampled_loop
from umbilical.design.grid import GridJudgement, check_count, judge_grids, resolved
from umbilical.design.matrix import MatrixCheck
from umbilical.errors import Problem, ScenarioError
from umbilical.scenario.scenario import Scenario


@dataclass(frozen=True)
class MarginReport:
    """What a loop is worth over the lengths of its cable.

    Attributes:
        scenario: whose loop it is.
        operating_thrust: steady thrust at which the motors are linearised, N.
        judgements: one for each length, from the exact cable.
        grids: the longest length once more, with the echo of the engine's own grids, at several resolutions.
        check: the count on a coarse one of them against eigenvalues; None without grids.
    """

    scenario: Scenario
    operating_thrust: float
    judgements: tuple[Judgement, ...]
    grids: tuple[GridJudgement, ...] = ()
    check: MatrixCheck | None = None

    @property
    def stable(self) -> bool:
        """Whether the loop is stable at every length."""
        return all(judgement.stable for judgement in self.judgements)

    @property
    def resolved(self) -> bool | None:
        """Whether the two finest grids agree with the exact cable, and the check; None for fewer than three."""
        if len(self.grids) < 3 or self.check is None:
            return None
        return resolved(self.grids) and self.check.agrees


def margins(
    scenario: Scenario,
    lengths: Sequence[float] | None = None,
    operating_thrust: float | None = None,
    *,
    elements: Sequence[int] = (),
    progress: Callable[[float], None] | None = None,
) -> MarginReport:
    """Stability, margins, modes and reflection of the linearised sampled loop, without a grid.

    Args:
        scenario: cable, ROV, motors, sensors and controller; adaptation is frozen at its start.
        lengths: m, the winch standing still; if left out, shortest, middle and longest of the run.
        operating_thrust: steady thrust at which the motors are linearised, N; if left out, the mean force on
            the ROV, at least the pull of a slope of 0.01.
        elements: numbers of elements on which the engine's own matrices are asked, too; three or more give a
            verdict.
        progress: called with the share done, 0 to 1.

    Raises:
        ScenarioError: there is no loop, it cannot be linearised, or a length or the thrust is out of range.

    >>> import umbilical
    >>> report = margins(umbilical.load("ringdown"))
    >>> report.stable, [judgement.length for judgement in report.judgements]
    (True, [400.0])
    """
    check(scenario)
    chosen = usual_lengths(scenario) if lengths is None else tuple(map(float, lengths))
    thrust = usual_thrust(scenario) if operating_thrust is None else float(operating_thrust)
    check_request(scenario, chosen, thrust, elements)
    loop = sampled_loop(scenario, thrust)
    found = []
    for number, length in enumerate(chosen, 1):
        found.append(judge_loop(hanging_cable(scenario, length), loop))
        if progress:
            progress(number / (len(chosen) + 2 * len(elements)))
    longest = max(found, key=lambda judgement: judgement.length)
    grids = judge_grids(scenario, longest, elements)
    checked = check_count(scenario, longest, elements) if elements else None
    return MarginReport(scenario, thrust, tuple(found), grids, checked)


def check_request(scenario: Scenario, lengths: Sequence[float], thrust: float, elements: Sequence[int] = ()) -> None:
    """Refuse lengths, thrusts and grids that have no linear loop, all at once.

    Raises:
        ScenarioError: with every problem.
    """
    problems = [
        Problem("--lengths", f"{length:g} m", "above 0, at most 20000 m", "a cable has a length", "e.g. 300,400")
        for length in lengths
        if not 0.0 < length <= 2e4
    ]
    if not 0.0 < abs(thrust) <= 1e9:
        reason = "at no thrust a propeller has none to first order, and the loop is open"
        problems.append(Problem("--operating-thrust", f"{thrust:g} N", "not 0, at most 1e9 N", reason, "e.g. 50"))
    problems += [
        Problem("--grid", f"{number}", "4 to 1000 elements", "a grid needs elements, and memory", "e.g. 32,64,128")
        for number in elements
        if not 4 <= number <= 1000
    ]
    if problems:
        raise ScenarioError(problems, scenario.name)
