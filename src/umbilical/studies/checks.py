"""Checks of a study across its fields, before anything is simulated."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from umbilical.errors import Problem, ScenarioError
from umbilical.library import admit
from umbilical.quantities import METRICS
from umbilical.scenario.document import look_up
from umbilical.scenario.inventory import words_at
from umbilical.scenario.problems import nearest
from umbilical.studies.designs import design_size
from umbilical.studies.distributions import count, is_number
from umbilical.studies.rows import NAMES

if TYPE_CHECKING:
    from umbilical.studies.study import Factor, Study

_MOST = 10_000_000
_MIDDLE = 0.5
_FOLDER = re.compile(r"\w[\w .,()+-]*")


def problems_across(study: Study) -> list[Problem]:
    """Everything wrong with a study whose fields are sound one by one; nothing twice."""
    return list(dict.fromkeys(problem for check in _CHECKS for problem in check(study)))


def _names(study: Study) -> Iterator[Problem]:
    """The name is one of a folder, and of nothing above it; no name stands twice."""
    if not _FOLDER.fullmatch(study.name):
        bound = "letters, digits, spaces and .,()+-_, a letter or digit first"
        yield Problem("name", f'"{study.name}"', bound, "the folder of the results is named so", "choose a plain name")
    for key, names in (("arms", [arm.name for arm in study.arms]), ("factors", [v.name for v in study.variables])):
        for name, times in Counter(names).items():
            if times > 1:
                reason = "results are told apart by these names"
                yield Problem(key, f'"{name}" {times} times', "each name once", reason, "rename one")


def _bounds(study: Study) -> Iterator[Problem]:
    """Lower bounds are below upper ones, and steps between them."""
    drawn = [(v.name, v.name, v.distribution) for v in study.variables]
    for name, key, found in [*drawn, *((f"tuning.gains {gain.key}", gain.key, gain) for gain in study.gains)]:
        low, high, step = (getattr(found, part, None) for part in ("low", "high", "step"))
        unit = words_at(study.scenario, key)[0]
        if low is None or high is None:
            continue
        if low >= high or (low <= 0.0 and getattr(found, "scale", "") == "log"):
            value, bound = f"{low:g} to {high:g} {unit}".strip(), "low below high, and above 0 for a logarithm"
            yield Problem(name, value, bound, "nothing lies between", "exchange or widen them")
        elif step and step > high - low:
            value, bound = f"steps of {step:g} {unit}".strip(), f"at most {high - low:g} {unit}".strip()
            yield Problem(name, value, bound, "only the lowest value could be drawn", "take smaller steps")


def _relative(study: Study) -> Iterator[Problem]:
    """Only numbers multiply, and only what is there."""
    for factor in study.factors:
        if factor.relative and not _multiplies(study, factor):
            bound = "a number of the scenario, and numbers drawn"
            fix = "drop `relative`, or name another key"
            wrong = Problem(factor.key, "relative = true", bound, "a factor multiplies a number", fix)
            # Of a key that leads nowhere, the scenario itself says what was meant.
            yield from _new_ones(study, {}, {factor.key: factor.distribution.at(_MIDDLE)}) or (wrong,)


def _multiplies(study: Study, factor: Factor) -> bool:
    try:
        value = look_up(study.scenario_data({}), factor.key)
    except (KeyError, ScenarioError):  # keys of changes that lead nowhere are named by the arms
        return False
    return is_number(factor.distribution) and type(value) in (int, float)


def _grid(study: Study) -> Iterator[Problem]:
    """All combinations can be made, and counted."""
    if study.design != "grid":
        return
    counts = [count(variable.distribution) for variable in study.variables]
    for variable, values in zip(study.variables, counts, strict=True):
        if values is None:
            reason, fix = "a grid combines single values", "a grid or choice distribution, or another design"
            yield Problem(variable.name, variable.distribution.kind, "grid or choice", reason, fix)
    combinations = design_size("grid", study.members, counts)
    if combinations > _MOST:
        value = f"some 10^{len(str(combinations)) - 1} combinations"
        yield Problem("design", value, f"at most {_MOST}", "it would never end", "fewer")


def _campaigns(study: Study) -> Iterator[Problem]:
    """A campaign says all that its kinds of fault need, and its motors are there."""
    there = len(study.scenario.motors)
    for number, campaign in enumerate(study.campaigns, start=1):
        for kind, part in campaign.lacking:
            key = f"campaigns.{number}.{part}"
            yield Problem(key, "missing", "a distribution", f"a {kind} fault needs it", f"add {part}")
        for motor in campaign.motors:
            if not 1 <= motor <= there:
                key, bound = f"campaigns.{number}.motors", f"1 to {there}" if there else "none: there are no motors"
                yield Problem(key, str(motor), bound, "only a motor that is there can fail", "name one that is there")


def _metrics(study: Study) -> Iterator[Problem]:
    """Metrics that are named are in the rows, and the arm that is tuned is there."""
    named = {f"limits.{name}": name for name in study.limits} | {"trajectories.metric": study.trajectories.metric}
    if study.tuning:
        named |= {f"tuning.objectives.{k}.metric": o.metric for k, o in enumerate(study.tuning.objectives, start=1)}
        arms, arm = [each.name for each in study.arms], study.tuning.arm
        if arm not in arms:
            yield Problem("tuning.arm", f'"{arm}"', f"one of {', '.join(arms)}", "no such arm", nearest(arm, arms))
    for key, name in named.items():
        if name not in NAMES:
            reason = "it is read from stored fields, not from rows" if name in METRICS else "there is no such metric"
            yield Problem(key, f'"{name}"', "a metric of a study's rows", reason, nearest(name, NAMES))


def _draws(study: Study) -> Iterator[Problem]:
    """What is drawn is said by nothing else: it is the same in every arm, and is not tuned."""
    for number, factor in enumerate(study.factors, start=1):
        if factor.key in ("seed", "name"):
            reason, fix = "every member has its own already", f"drop factor {number}"
            yield Problem(factor.key, "drawn", "anything but the seed and the name", reason, fix)
        if study.campaigns and _overlap(factor.key, "faults"):
            reason = "a campaign replaces the list of faults in the members it strikes"
            yield Problem(factor.key, "drawn", "no fault, beside a campaign", reason, "draw it in a campaign")
    drawn = [factor.key for factor in study.factors] + (["faults"] if study.campaigns else [])
    for number, arm in enumerate(study.arms, start=1):
        for key in (key for key in arm.changes if any(_overlap(key, other) for other in drawn)):
            reason = "arms are compared on the same draws"
            yield Problem(f"arms.{number}.changes", key, "no key that is drawn", reason, "drop it here or as a factor")
    for key in (gain.key for gain in study.gains if any(_overlap(gain.key, other) for other in drawn)):
        reason = "the draw would replace what the search tries"
        yield Problem(f"tuning.gains {key}", "drawn too", "no key that is drawn", reason, "drop one of the two")


def _overlap(one: str, other: str) -> bool:
    """Whether two keys are the same place, or one is inside the other."""
    return f"{one}.".startswith(f"{other}.") or f"{other}.".startswith(f"{one}.")


def _scenarios(study: Study) -> Iterator[Problem]:
    """Every arm is a scenario that would run; so is, in every arm, a draw from the middle of everything, so that every
    key leads somewhere; and every gain leads somewhere in the arm that is tuned."""
    yield from _by_arm([_refused(study, arm.changes, admission=True) for arm in study.arms])
    drawn = {
        factor.key: factor.given(study.scenario_data({}), factor.distribution.at(_MIDDLE))
        for factor in study.factors
        if not factor.relative or _multiplies(study, factor)
    }
    yield from _by_arm([_new_ones(study, arm.changes, drawn) for arm in study.arms])
    for gain in study.gains:
        for arm in (arm for arm in study.arms if study.tuning and arm.name == study.tuning.arm):
            for problem in _new_ones(study, arm.changes, {gain.key: gain.at(_MIDDLE)}):
                yield replace(problem, key=f"tuning.gains {problem.key}")


def _new_ones(study: Study, before: Mapping[str, Any], changes: Mapping[str, Any]) -> tuple[Problem, ...]:
    """What further changes spoil in a scenario that has its own problems, or none."""
    known = _refused(study, before)
    return tuple(problem for problem in _refused(study, {**before, **changes}) if problem not in known)


def _refused(study: Study, changes: Mapping[str, Any], *, admission: bool = False) -> tuple[Problem, ...]:
    """What is wrong with the study's scenario under some changes, field by field, and across them on request."""
    try:
        scenario = study.scenario_with(changes)
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


_CHECKS = (_names, _bounds, _relative, _grid, _campaigns, _metrics, _draws, _scenarios)
