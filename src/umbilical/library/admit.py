"""Runs every check whose sections of the scenario are sound, and gathers all they find."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cache
from inspect import signature
from typing import Annotated, Any

import numpy as np
from pydantic import TypeAdapter

from umbilical.errors import Problem, ScenarioError, expect
from umbilical.library.checks import checks_for
from umbilical.plant.checks.moving import MovingCable
from umbilical.scenario import Scenario
from umbilical.scenario.document import freeze
from umbilical.scenario.findings import Finding, Notice
from umbilical.scenario.scenario import validate


def admit(scenario: Scenario, like: Scenario | None = None) -> tuple[Notice, ...]:
    """Check the whole run before its first step.

    Args:
        scenario: what is to be run.
        like: one that was admitted; checks that read only sections in which both are equal are not made again.

    Returns:
        What is allowed but probably not meant, such as a fault after the end of the run.

    Raises:
        ScenarioError: with every problem.

    >>> from umbilical.library import load
    >>> admit(load("paper"))
    ()
    """
    expect(scenario, "Scenario", "load")
    findings = _findings(_sections(scenario), _sections(like) if like else {})
    if problems := _only_problems(findings):
        raise ScenarioError(problems, scenario.name)
    return tuple(finding for finding in findings if isinstance(finding, Notice))


def admit_data(data: Mapping[str, Any], origin: str, problems: Iterable[Problem] = ()) -> Scenario:
    """Scenario of plain data, after all checks; one broken section does not hide problems of the others.

    Args:
        data: plain data of a complete scenario.
        origin: what to call it in errors.
        problems: those already found on the way to it.

    Raises:
        ScenarioError: with every problem of the fields and, between sound sections, across them.
    """
    try:
        scenario = validate(data, origin)
        found, sections = [*problems], _sections(scenario)
    except ScenarioError as error:
        scenario = None
        found, sections = [*problems, *error.problems], _sound_sections(data, error.problems)
    found += _only_problems(_findings(sections))
    if scenario is None or found:
        raise ScenarioError(found, origin)
    return scenario


def _findings(sections: Mapping[str, Any], checked: Mapping[str, Any] | None = None) -> list[Finding]:
    """What the checks find whose sections are all there, less those whose sections are all ``checked``."""
    checked = checked or {}
    same = {name for name in checked if name in sections and checked[name] == sections[name]}
    if sections.keys() >= set(MovingCable._fields):
        moving = MovingCable(*(sections[name] for name in MovingCable._fields))
        sections = {**sections, "moving": moving}
        same |= {"moving"} if same >= set(MovingCable._fields) else set()
    able = [
        (check, needs)
        for check in checks_for(sections.get("model", "string"))
        if sections.keys() >= (needs := _parameters(check)) and not same >= needs
    ]
    # Overflow in a check is an answer (an infinite wave speed breaks its bound), not a fault of the check.
    with np.errstate(all="ignore"):
        return [finding for check, needs in able for finding in check(**{name: sections[name] for name in needs})]


@cache
def _parameters(check: Callable[..., Any]) -> frozenset[str]:
    """Names of what a check reads; looking takes longer than most checks do."""
    return frozenset(signature(check).parameters)


def _only_problems(findings: Iterable[Finding]) -> list[Problem]:
    return [finding for finding in findings if isinstance(finding, Problem)]


def _sections(scenario: Scenario) -> dict[str, Any]:
    """All sections by name, and the scenario itself for checks of the whole."""
    return {name: getattr(scenario, name) for name in Scenario.model_fields} | {"scenario": scenario}


def _sound_sections(data: Mapping[str, Any], problems: Iterable[Problem]) -> dict[str, Any]:
    """The top-level values without a problem of their own, defaults included."""
    broken = {problem.key.split(".")[0] for problem in problems}
    sound = {name: field for name, field in Scenario.model_fields.items() if name not in broken}
    annotated: Any = Annotated  # built at run time, which type checkers cannot follow
    return {
        name: TypeAdapter(annotated[field.annotation, field]).validate_python(freeze(data[name]))
        if name in data
        else field.get_default(call_default_factory=True)
        for name, field in sound.items()
    }
