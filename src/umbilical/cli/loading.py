"""Scenarios, studies and operations with the changes of ``--set``."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from umbilical.cli.output import report
from umbilical.errors import FileError, Problem, ScenarioError

if TYPE_CHECKING:
    from umbilical.control.contract import Controller
    from umbilical.scenario import Scenario
    from umbilical.screening import Operation
    from umbilical.studies.study import Study

_Loaded = TypeVar("_Loaded")


def _changed(load: Callable[[str, Mapping[str, Any]], _Loaded], source: str, changes: Sequence[str] | None) -> _Loaded:
    """What ``load`` makes of a source and ``key=value`` changes.

    Raises:
        ScenarioError: with every problem of the changes and of what they make of the source.
    """
    from umbilical.scenario.document import assignment

    found: dict[str, Any] = {}
    problems: list[Problem] = []
    for text in changes or ():
        try:
            found |= [assignment(text)]
        except ScenarioError as error:
            problems += error.problems
    try:
        loaded = load(source, found)
    except ScenarioError as error:
        raise ScenarioError([*problems, *error.problems], error.origin) from error
    if problems:
        raise ScenarioError(problems, source)
    return loaded


def load_scenario(source: str, changes: Sequence[str] | None, controller: str | None = None) -> Scenario:
    """A scenario with ``key=value`` changes.

    Of a result that another controller made it says so, unless a ``controller`` is given.

    Raises:
        FileError: there is no such scenario, or it is an operation or a study.
        ScenarioError: with every problem.
    """
    from umbilical.library import load

    try:
        scenario = _changed(load, source, changes)
    except (FileError, ScenarioError):
        _refuse_other_kinds(source)
        raise
    if Path(source).suffix == ".nc" and not controller:
        _report_other_controller(source)
    return scenario


def _refuse_other_kinds(source: str) -> None:
    """Say where an operation or a study belongs, rather than which keys of a scenario it lacks."""
    from umbilical.screening.load import is_operation
    from umbilical.studies.load import is_study

    if is_operation(source):
        raise FileError(f"{source}: this is an operation; `umbilical operate`, `lower` and `show` take it")
    if Path(source).suffix != ".nc" and is_study(source):
        raise FileError(f"{source}: this is a study; `umbilical sweep`, `member`, `tune` and `show` take it")


def _report_other_controller(source: str) -> None:
    from umbilical.stored_runs import controller_name

    if name := controller_name(source):
        report(f"{source}: this run had the controller {name}; what follows is about the scenario's own controller")


def own_controller(name: str | None, scenario: Scenario) -> Controller | None:
    """The controller that ``--controller`` names, tried; None where it is not given.

    Raises:
        ScenarioError: there is none, or it fails at once.
    """
    if name is None:
        return None
    from umbilical.studies.controllers import named_controller

    return named_controller(name, scenario)


def load_changed_study(source: str, changes: Sequence[str] | None, *, runs: bool = True) -> Study:
    """A study with ``key=value`` changes; where it is to be run, a result must not say which code.

    Raises:
        FileError: there is no such study, or a result file whose study names Python controllers: whoever opens it has
            not read that code.
        ScenarioError: with every problem.
    """
    from umbilical.studies.load import load_study

    study = _changed(load_study, source, changes)
    named = [arm.controller for arm in study.arms if arm.controller]
    if runs and named and Path(source).suffix == ".nc":
        raise FileError(
            f"{source}: its study names the Python controllers {', '.join(named)}, which are never imported from a "
            "result; run the study's own file with --trust"
        )
    return study


def load_changed_operation(source: str, changes: Sequence[str] | None) -> Operation:
    """An operation with ``key=value`` changes; errors as for a study."""
    from umbilical.screening import load_operation

    return _changed(load_operation, source, changes)
