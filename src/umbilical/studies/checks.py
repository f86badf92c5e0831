"""Checks of a study across its fields, before anything is simulated."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from umbilical.errors import Problem, ScenarioError
from umbilical.library import admit
from umbilical.quantities import METRICS
from umbilical.scenario.document import look_up
from umbilical.scenario.inventory import words_at
from umbilical.scenario.problems import nearest
from umbilical.scenario.scenario import validate
from umbilical.studies.designs import design_size
from umbilical.studies.distributions import GridPoints, LogUniform, Uniform, count, draw_value, is_number
from umbilical.studies.members import arm_data, given_by, needed_of_a_fault, variables
from umbilical.studies.rows import NAMES
from umbilical.studies.study import Factor, Study

_MOST = 10_000_000
_MIDDLE = 0.5
_NAME = re.compile(r"\w[\w .,()+-]*")


def problems_across(study: Study) -> list[Problem]:
    """Everything wrong with a study whose fields are sound one by one; nothing twice."""
    return list(dict.fromkeys(problem for check in _CHECKS for problem in check(study)))


def _folder_name(study: Study) -> Iterator[Problem]:
    """The name is one of a folder, and of nothing above it."""
    if not _NAME.fullmatch(study.name):
        bound = "letters, digits, spaces and .,()+-_, a letter or digit first"
        yield Problem("name", f'"{study.name}"', bound, "the folder of the results is named so", "choose a plain name")


def _names(study: Study) -> Iterator[Problem]:
    """No name stands twice."""
    for key, names in (("arms", [a.name for a in study.arms]), ("factors", [v.name for v in variables(study)])):
        for name, times in Counter(names).items():
            if times > 1:
                reason = "results are told apart by these names"
                yield Problem(key, f'"{name}" {times} times', "each name once", reason, "rename one")


def _bounds(study: Study) -> Iterator[Problem]:
    """Lower bounds are below upper ones, and steps between them."""
    for variable in variables(study):
        found, unit = variable.distribution, words_at(study.scenario, variable.name)[0]
        if isinstance(found, Uniform | LogUniform | GridPoints) and found.low >= found.high:
            yield _order(variable.name, found.low, found.high, unit)
        elif isinstance(found, Uniform) and found.step and found.step > found.high - found.low:
            value, bound = (
                f"steps of {found.step:g} {unit}".strip(),
                f"at most {found.high - found.low:g} {unit}".strip(),
            )
            yield Problem(variable.name, value, bound, "only the lowest value could be drawn", "take smaller steps")
    for gain in study.tuning.gains if study.tuning else ():
        if gain.low >= gain.high or (gain.scale == "log" and gain.low <= 0.0):
            unit = words_at(study.scenario, gain.key)[0]
            yield _order(f"tuning.gains {gain.key}", gain.low, gain.high, unit)


def _order(key: str, low: float, high: float, unit: str) -> Problem:
    return Problem(key, f"{low:g} to {high:g} {unit}".strip(), "low below high, and above 0 for a logarithm",
                   "nothing lies between", "exchange or widen them")  # fmt: skip


def _relative(study: Study) -> Iterator[Problem]:
    """Only numbers multiply, and only what is there."""
    for factor in study.factors:
        if factor.relative and not _multiplies(study, factor):
            bound = "a number of the scenario, and numbers drawn"
            fix = "drop `relative`, or name another key"
            wrong = Problem(factor.key, "relative = true", bound, "a factor multiplies a number", fix)
            # Of a key that leads nowhere, the scenario itself says what was meant.
            yield from _new_ones(study, {}, {factor.key: draw_value(factor.distribution, _MIDDLE)}) or (wrong,)


def _multiplies(study: Study, factor: Factor) -> bool:
    try:
        value = look_up(arm_data(study, {}), factor.key)
    except (KeyError, ScenarioError):  # keys of changes that lead nowhere are named by the arms
        value = None
    return is_number(factor.distribution) and type(value) in (int, float)


def _grid(study: Study) -> Iterator[Problem]:
    """All combinations can be made, and counted."""
    if study.design != "grid":
        return
    for variable in variables(study):
        if count(variable.distribution) is None:
            kind = variable.distribution.kind
            fix = "a grid or choice distribution, or another design"
            yield Problem(variable.name, kind, "grid or choice", "a grid combines single values", fix)
    combinations = design_size(study.design, study.members, [count(v.distribution) for v in variables(study)])
    if combinations > _MOST:
        yield Problem(
            "design",
            f"some 10^{len(str(combinations)) - 1} combinations",
            f"at most {_MOST}",
            "it would never end",
            "fewer",
        )


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
    """Metrics that are named are in the rows."""
    named = {f"limits.{name}": name for name in study.limits} | {"trajectories.metric": study.trajectories.metric}
    if study.tuning:
        named |= {f"tuning.objectives.{k}.metric": o.metric for k, o in enumerate(study.tuning.objectives, start=1)}
    for key, name in named.items():
        if name not in NAMES:
            reason = (
                "there is no such metric" if name not in METRICS else "it is read from stored fields, not from rows"
            )
            yield Problem(key, f'"{name}"', "a metric of a study's rows", reason, nearest(name, NAMES))


def _tuned_arm(study: Study) -> Iterator[Problem]:
    names = [arm.name for arm in study.arms]
    if study.tuning and study.tuning.arm not in names:
        found = study.tuning.arm
        yield Problem("tuning.arm", f'"{found}"', f"one of {', '.join(names)}", "no such arm", nearest(found, names))


def _draws_are_not_lost(study: Study) -> Iterator[Problem]:
    """Nothing else says what a draw says."""
    for number, factor in enumerate(study.factors, start=1):
        if factor.key in ("seed", "name"):
            reason, fix = "every member has its own already", f"drop factor {number}"
            yield Problem(factor.key, "drawn", "anything but the seed and the name", reason, fix)
        if study.campaigns and _overlap(factor.key, "faults"):
            reason = "a campaign replaces the list of faults in the members it strikes"
            yield Problem(factor.key, "drawn", "no fault, beside a campaign", reason, "draw it in a campaign")


def _nobody_decides_twice(study: Study) -> Iterator[Problem]:
    """What is drawn is the same in every arm, and is not tuned."""
    drawn = [factor.key for factor in study.factors] + (["faults"] if study.campaigns else [])
    for number, arm in enumerate(study.arms, start=1):
        for key in [key for key in arm.changes if any(_overlap(key, other) for other in drawn)]:
            reason = "arms are compared on the same draws"
            yield Problem(f"arms.{number}.changes", key, "no key that is drawn", reason, "drop it here or as a factor")
    for gain in study.tuning.gains if study.tuning else ():
        if any(_overlap(gain.key, other) for other in drawn):
            reason = "the draw would replace what the search tries"
            yield Problem(
                f"tuning.gains {gain.key}", "drawn too", "no key that is drawn", reason, "drop one of the two"
            )


def _overlap(one: str, other: str) -> bool:
    """Whether two keys are the same place, or one is inside the other."""
    return f"{one}.".startswith(f"{other}.") or f"{other}.".startswith(f"{one}.")


def _scenarios(study: Study) -> Iterator[Problem]:
    """Every arm is a scenario that would run."""
    return _by_arm([_refused(study, arm.changes, admission=True) for arm in study.arms])


def _draws_in_the_middle(study: Study) -> Iterator[Problem]:
    """A draw from the middle of everything is a scenario in every arm, so that every key leads somewhere."""
    drawn = {
        factor.key: _drawn_in_the_middle(study, factor)
        for factor in study.factors
        if not factor.relative or _multiplies(study, factor)
    }
    return _by_arm([_new_ones(study, arm.changes, drawn) for arm in study.arms])


def _drawn_in_the_middle(study: Study, factor: Factor) -> Any:
    return given_by(arm_data(study, {}), factor, draw_value(factor.distribution, _MIDDLE))


def _gains_in_the_middle(study: Study) -> Iterator[Problem]:
    """Every gain leads somewhere in the arm that is tuned."""
    for gain in study.tuning.gains if study.tuning else ():
        for arm in study.arms:
            if study.tuning and arm.name == study.tuning.arm:
                for problem in _new_ones(study, arm.changes, {gain.key: gain.at(_MIDDLE)}):
                    yield replace(problem, key=f"tuning.gains {problem.key}")


def _new_ones(study: Study, before: Mapping[str, Any], changes: Mapping[str, Any]) -> tuple[Problem, ...]:
    """What further changes spoil in a scenario that has its own problems, or none."""
    known = _refused(study, before, admission=False)
    return tuple(p for p in _refused(study, {**before, **changes}, admission=False) if p not in known)


def _refused(study: Study, changes: Mapping[str, Any], *, admission: bool) -> tuple[Problem, ...]:
    """What is wrong with the study's scenario under some changes, field by field, and across them on request."""
    try:
        scenario = validate(arm_data(study, changes), study.name)
        if admission:
            admit(scenario)
    except ScenarioError as error:
        return error.problems
    return ()


def _by_arm(found: Sequence[Sequence[Problem]]) -> Iterator[Problem]:
    """Problems of all arms, each named once: with the arm's number if it is not in all of them."""
    for problem in dict.fromkeys(problem for problems in found for problem in problems):
        numbers = [number for number, problems in enumerate(found, start=1) if problem in problems]
        yield problem if len(numbers) == len(found) else replace(problem, key=f"arms.{numbers[0]}: {problem.key}")


_CHECKS = (
    _folder_name,
    _names,
    _bounds,
    _relative,
    _grid,
    _faults,
    _motors,
    _metrics,
    _tuned_arm,
    _draws_are_not_lost,
    _nobody_decides_twice,
    _scenarios,
    _draws_in_the_middle,
    _gains_in_the_middle,
)
