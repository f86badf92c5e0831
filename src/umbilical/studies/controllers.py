"""Python controllers that a study names: never imported without the user's word, and tried before the first member."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

from umbilical.control.contract import Controller
from umbilical.engine.simulate import rehearse
from umbilical.errors import Problem, ScenarioError
from umbilical.scenario import Scenario
from umbilical.scenario.document import validate
from umbilical.studies.members import arm_data
from umbilical.studies.study import Arm, Study

_LONGEST = 300
"""Characters of a reason that are kept; an exception may carry a whole array."""


def check_controllers(study: Study, *, trust: bool) -> None:
    """Import the controllers of a study's arms and take their first updates in the arms' own scenarios.

    Args:
        study: whose arms may name controllers as ``module:function``.
        trust: whether the user allows it; a name is all it takes to run any function of any module.

    Raises:
        ScenarioError: it is not allowed, there is no such function, it cannot be called with a scenario, what it gives
            is no controller, or that fails at once; with every problem.
    """
    find = _failure if trust else _not_trusted
    found = [(number, arm, find(study, arm)) for number, arm in enumerate(study.arms, start=1) if arm.controller]
    if problems := [_problem(number, arm, *why) for number, arm, why in found if why]:
        raise ScenarioError(problems, study.name)


def make_controller(path: str | None, scenario: Scenario) -> Any:
    """The Python controller an arm names as ``module:function``, made from the member's scenario; None for none.

    Raises:
        ImportError, AttributeError, ValueError: there is no such module or function.
        Exception: whatever the function raises.
    """
    return None if path is None else _factory(path)(scenario)


def describe_error(error: BaseException) -> str:
    """Type and text of what a controller raised, of bounded length."""
    return shortened(f"{type(error).__name__}: {error}".rstrip(": "))


def shortened(reason: str) -> str:
    """A reason of bounded length."""
    return reason if len(reason) <= _LONGEST else f"{reason[:_LONGEST]}..."


def _not_trusted(study: Study, arm: Arm) -> tuple[str, str, str]:
    reason = "importing it runs its code, from the folder you are in or from the environment"
    return "a controller you trust", reason, "read it, then give --trust (in Python: trust=True)"


def _failure(study: Study, arm: Arm) -> tuple[str, str, str] | None:
    """What is allowed, why this is not, and what to do; None where the controller works."""
    scenario = validate(arm_data(study, arm.changes), study.name)
    bound, cure = "module:function, which makes a controller from a scenario", "see `Your own controller` in the guide"
    try:
        controller = make_controller(arm.controller, scenario)
        if not isinstance(controller, Controller):
            missing = ", ".join(name for name in ("period", "start", "update") if not hasattr(controller, name))
            return bound, f"it gives {type(controller).__name__}, which has no {missing}", cure
        rehearse(scenario, controller)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # sys.exit in a controller must not end us
        return bound, f"it fails at the start of this arm's run: {describe_error(error)}", cure
    return None


def _problem(number: int, arm: Arm, bound: str, reason: str, cure: str) -> Problem:
    return Problem(f"arms.{number}.controller", f'"{arm.controller}"', bound, reason, cure)


def _factory(path: str) -> Callable[[Scenario], Any]:
    module, _, name = path.partition(":")
    if "" not in sys.path:
        sys.path.append("")  # controllers usually lie in the folder one works in
    return getattr(import_module(module), name)
