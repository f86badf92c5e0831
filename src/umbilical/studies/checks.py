"""Checks of a study across its fields, before anything is simulated."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

from umbilical.admission import admit
from umbilical.errors import Problem, ScenarioError
from umbilical.quantities import METRICS
from umbilical.scenario.document import look_up, validate
from umbilical.scenario.problems import nearest
from umbilical.studies.distributions import Grid, LogUniform, Uniform, count, is_number
from umbilical.studies.members import Draws, Member, arm_data, needed_of_a_fault, variables
from umbilical.studies.study import Study

_STATED = 0.5
_MOST = 10_000_000


def problems_across(study: Study) -> list[Problem]:
    """Everything wrong with a study whose fields are sound one by one."""
    found = [problem for check in _CHECKS for problem in check(study)]
    # What the arms make of the scenario says nothing new while names or bounds are wrong.
    return found or [problem for check in (_scenarios, _draw_in_the_middle) for problem in check(study)]


def _names(study: Study) -> Iterator[Problem]:
    """No name stands twice."""
    for key, names in (("arms", [a.name for a in study.arms]), ("factors", [v.name for v in variables(study)])):
        for name, times in Counter(names).items():
            if times > 1:
                reason = "results are told apart by these names"
                yield Problem(key, f'"{name}" {times} times', "each name once", reason, "rename one")


def _bounds(study: Study) -> Iterator[Problem]:
    """Lower bounds are below upper ones."""
    for variable in variables(study):
        found = variable.distribution
        if isinstance(found, Uniform | LogUniform | Grid) and found.low >= found.high:
            yield _order(variable.name, found.low, found.high)
    for gain in study.tuning.gains if study.tuning else ():
        if gain.low >= gain.high or (gain.scale == "log" and gain.low <= 0.0):
            yield _order(f"tuning.gains {gain.key}", gain.low, gain.high)


def _order(key: str, low: float, high: float) -> Problem:
    return Problem(key, f"{low:g} to {high:g}", "low below high, and above 0 for a logarithm", "nothing lies between",
                   "exchange or widen them")  # fmt: skip


def _relative(study: Study) -> Iterator[Problem]:
    """Only numbers multiply, and only what is there."""
    try:
        base = arm_data(study, {})
    except ScenarioError:
        return  # keys that lead nowhere are named by the arms
    for factor in study.factors:
        if not factor.relative:
            continue
        value = _find(base, factor.key)
        if not is_number(factor.distribution) or type(value) not in (int, float):
            bound = "a number of the scenario, and numbers drawn"
            cure = "drop `relative`, or name another key"
            yield Problem(factor.key, "relative = true", bound, "a factor multiplies a number", cure)


def _grid(study: Study) -> Iterator[Problem]:
    """All combinations can be made, and counted."""
    if study.design != "grid":
        return
    for variable in variables(study):
        if count(variable.distribution) is None:
            kind = variable.distribution.kind
            cure = "a grid or choice distribution, or another design"
            yield Problem(variable.name, kind, "grid or choice", "a grid combines single values", cure)
    if len(Draws(study)) > _MOST:
        yield Problem("design", f"{len(Draws(study))} combinations", f"at most {_MOST}", "it would never end", "fewer")


def _faults(study: Study) -> Iterator[Problem]:
    """A campaign says all that its kinds of fault need."""
    for number, campaign in enumerate(study.campaigns, start=1):
        for kind in campaign.kinds:
            for name in needed_of_a_fault(kind):
                if getattr(campaign, name) is None:
                    key = f"campaigns.{number}.{name}"
                    yield Problem(key, "missing", "a distribution", f"a {kind} fault needs it", f"add {name}")


def _motors(study: Study) -> Iterator[Problem]:
    """A campaign's motors are there."""
    there = len(study.scenario.motors)
    for number, campaign in enumerate(study.campaigns, start=1):
        for motor in campaign.motors:
            if not 1 <= motor <= there:
                key, bound = f"campaigns.{number}.motors", f"1 to {there}" if there else "none: there are no motors"
                yield Problem(key, str(motor), bound, "only a motor that is there can fail", "name one that is there")


def _metrics(study: Study) -> Iterator[Problem]:
    """Metrics that are named exist."""
    named = {f"limits.{name}": name for name in study.limits} | {"trajectories.metric": study.trajectories.metric}
    if study.tuning:
        named |= {f"tuning.objectives.{k}.metric": o.metric for k, o in enumerate(study.tuning.objectives, start=1)}
    for key, name in named.items():
        if name not in METRICS:
            yield Problem(key, f'"{name}"', "a metric of a run", "there is no such metric", nearest(name, METRICS))


def _tuned_arm(study: Study) -> Iterator[Problem]:
    names = [arm.name for arm in study.arms]
    if study.tuning and study.tuning.arm not in names:
        found = study.tuning.arm
        yield Problem("tuning.arm", f'"{found}"', f"one of {', '.join(names)}", "no such arm", nearest(found, names))


def _arms_leave_the_draws_alone(study: Study) -> Iterator[Problem]:
    """What is drawn is the same in every arm."""
    drawn = {factor.key for factor in study.factors} | ({"faults"} if study.campaigns else set())
    for number, arm in enumerate(study.arms, start=1):
        for key in drawn & arm.changes.keys():
            reason = "arms are compared on the same draws"
            yield Problem(f"arms.{number}.changes", key, "no key that is drawn", reason, "drop it here or as a factor")


def _scenarios(study: Study) -> Iterator[Problem]:
    """Every arm is a scenario that would run."""
    for number, arm in enumerate(study.arms, start=1):
        for problem in _broken(study, arm.changes):
            yield Problem(f"arms.{number}: {problem.key}", *list(vars(problem).values())[1:])


def _broken(study: Study, changes: Mapping[str, Any]) -> tuple[Problem, ...]:
    """What is wrong with the study's scenario under some changes."""
    try:
        admit(validate(arm_data(study, changes), study.name))
    except ScenarioError as error:
        return error.problems
    return ()


def _draw_in_the_middle(study: Study) -> Iterator[Problem]:
    """A draw from the middle of everything is a scenario, so that every key leads somewhere."""
    draws = Draws(study)
    try:
        draws.scenario(Member(1, tuple(_STATED for _ in draws.variables)), 0)
    except ScenarioError as error:
        yield from error.problems


def _find(data: Mapping[str, Any], key: str) -> Any:
    try:
        return look_up(data, key)
    except KeyError:
        return None


_CHECKS = (_names, _bounds, _relative, _grid, _faults, _motors, _metrics, _tuned_arm, _arms_leave_the_draws_alone)
