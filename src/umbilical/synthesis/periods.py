"""Other control periods for a design: what they leave room for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from umbilical.errors import Problem, ScenarioError
from umbilical.library import admit
from umbilical.scenario.scenario import Scenario
from umbilical.synthesis.search import DesignTask, Values, inner_knobs, outer_knobs


def pace(scenario: Scenario, period: float) -> Values:
    """The periods of a scenario when its shortest is another, s."""
    outer = scenario.control.outer_period
    ratio = round(outer / scenario.control.period) if outer else 0
    return {"control.period": period} | ({"control.outer_period": ratio * period} if outer else {})


def paced(base: DesignTask, new: Values, wave_speed: float, *, inner: bool) -> DesignTask:
    """A task at other periods, with the gains that may be chosen there.

    Raises:
        ScenarioError: with everything that does not fit the periods.
    """
    scenario = base.scenario.replace(new)
    knobs = outer_knobs(scenario, wave_speed) + (inner_knobs(scenario) if inner else [])
    task = replace(base, scenario=scenario, knobs=knobs)
    if problems := [*_cramped(task), *(_kept_gains(task) if new else ())]:
        raise ScenarioError(problems, scenario.name)
    return task


def _cramped(task: DesignTask) -> Iterator[Problem]:
    """Gains without a place between their bounds."""
    reason = f"a period of {task.scenario.control.period:g} s leaves nothing between its bounds"
    for knob in task.knobs:
        if not knob.low < knob.high:
            span = f"{knob.low:.3g} to {knob.high:.3g}"
            yield Problem(knob.key, span, "the lower end below the upper", reason, "choose a shorter control.period")


def _kept_gains(task: DesignTask) -> Iterator[Problem]:
    """What does not fit the new periods and is not chosen anew either."""
    chosen = {knob.key for knob in task.knobs}
    try:
        admit(task.scenario)
    except ScenarioError as error:
        yield from (problem for problem in error.problems if problem.key not in chosen)
