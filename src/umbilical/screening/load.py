"""Where operations come from: presets by name, and TOML files."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from umbilical import files
from umbilical.errors import FileError, Problem, ScenarioError
from umbilical.library.recorded import consequences, forget, read_files
from umbilical.plant.checks.weights import cable_in_water, payload_in_water
from umbilical.relations.axial import Bar
from umbilical.scenario.document import freeze, read_document, try_override
from umbilical.scenario.presets import Presets
from umbilical.scenario.problems import nearest, problems_of
from umbilical.scenario.ship import RaoShip
from umbilical.screening.operation import Operation
from umbilical.sea.rao_checks import table_problems

_LARGEST_STRAIN = 0.1

OPERATIONS = Presets("umbilical.screening", "operation", "operations that come along")


def load_operation(source: str | os.PathLike[str], overrides: Mapping[str, Any] | None = None) -> Operation:
    """Load an operation and check it.

    Args:
        source: name of a preset, or path of a ``.toml`` file; one that says ``extends = "work-class"`` gives only
            what differs.
        overrides: values by dotted keys, e.g. ``{"payload.mass": 4000.0}``.

    Raises:
        FileError: there is no such preset or file, or it is not TOML.
        ScenarioError: with every problem.

    >>> load_operation("work-class", {"vessel.draught": 7.0}).vessel.draught
    7.0
    """
    origin = os.fspath(source)
    changed, lost = try_override(OPERATIONS.extended(read_document(_text(origin), origin), origin), overrides or {})
    forget(changed, overrides or {}, Operation)
    unread = read_files(changed, Path() if origin in operation_names() else Path(origin).parent, Operation)
    try:
        operation = Operation.model_validate(freeze(changed))
    except ValidationError as error:
        found = [*lost, *unread, *problems_of(error, Operation)]
        raise ScenarioError(consequences(found, unread), origin) from error
    if found := [*lost, *unread, *_problems_across(operation)]:
        raise ScenarioError(found, origin)
    return operation


def operation_names() -> tuple[str, ...]:
    """Names of the operations that come with the package.

    >>> operation_names()
    ('work-class',)
    """
    return OPERATIONS.names


def is_operation(source: str | os.PathLike[str]) -> bool:
    """Whether a name or a file means an operation: it says so, or extends one.

    >>> is_operation("work-class"), is_operation("paper")
    (True, False)
    """
    origin = os.fspath(source)
    if origin in operation_names() or not origin.endswith(".toml"):
        return origin in operation_names()
    try:
        data = read_document(_text(origin), origin)
    except (FileError, ScenarioError):
        return False
    return data.get("kind") == "operation" or data.get("extends") in operation_names()


def operation_text(name: str) -> str:
    """TOML text of an operation that comes with the package."""
    return OPERATIONS.text(name)


def bar_of(operation: Operation, length: float) -> Bar:
    """Cable and body of an operation with so many metres paid out.

    The cable's drag is linearised for the speed of the body: near resonances of the cable itself, where it moves
    faster than the body, that leaves out some damping.
    """
    cable, body = operation.cable, operation.payload
    shared = cable.tangential_drag / body.quadratic_drag if body.quadratic_drag > 0.0 else 0.0
    moving = body.mass + body.added_mass
    return Bar(cable.axial_stiffness, cable.line_density, moving, length, cable.loss_factor, shared)


def _problems_across(operation: Operation) -> list[Problem]:
    """What is wrong between fields that are sound one by one."""
    cable, body = operation.cable, operation.payload
    strain = body.wet_weight / cable.axial_stiffness
    said: Any = operation  # its sections have the names that checks of scenarios read
    checked = (cable_in_water(said.cable, said.environment), payload_in_water(said.payload, said.environment))
    found = [finding for findings in checked for finding in findings if isinstance(finding, Problem)]
    if strain > _LARGEST_STRAIN:
        value = f"{cable.axial_stiffness:g} N"
        bound = f"at least {body.wet_weight / _LARGEST_STRAIN:g} N, a strain of {_LARGEST_STRAIN:.0%}"
        reason = f"the body alone would stretch the cable by {strain:.0%}"
        found.append(Problem("cable.axial_stiffness", value, bound, reason, "EA in newton: modulus times area"))
    if isinstance(operation.vessel, RaoShip):
        found += table_problems(operation.vessel, "vessel", operation.environment.gravity)
    return found


def _text(source: str) -> str:
    if source in operation_names():
        return operation_text(source)
    try:
        return files.read(source).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(f"{source}: this is not UTF-8 text; save it with that encoding") from error
    except FileError as error:
        raise FileError(f"{error}, and no operation of this name; {nearest(source, operation_names())}") from error
