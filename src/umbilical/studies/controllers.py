"""Python controllers by name: those of a study are never imported without the user's word, all are tried first."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from inspect import signature
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from umbilical.control.contract import Controller
from umbilical.engine.simulate import rehearse
from umbilical.errors import Problem, ScenarioError, UmbilicalError
from umbilical.scenario import Scenario
from umbilical.scenario.problems import nearest

if TYPE_CHECKING:
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
    find = _fails_in_its_arm if trust else _not_trusted
    found = [(number, arm, find(study, arm)) for number, arm in enumerate(study.arms, start=1) if arm.controller]
    if problems := [_problem(number, arm, *why) for number, arm, why in found if why]:
        raise ScenarioError(problems, study.name)


def make_controller(path: str | None, scenario: Scenario) -> Any:
    """The Python controller that ``module:function`` or ``module:Class`` makes from a scenario; None for none.

    What asks for no argument gets none.

    Raises:
        ImportError, AttributeError, ValueError: there is no such module or function.
        Exception: whatever the function raises.
    """
    if path is None:
        return None
    return _made(_factory(path), scenario)


def _made(make: Callable[..., Any], scenario: Scenario) -> Any:
    return make() if callable(make) and not signature(make).parameters else make(scenario)


def named_controller(path: str, scenario: Scenario, key: str = "--controller") -> Controller:
    """The controller that the user of a command names, after its first updates in the scenario.

    Raises:
        ScenarioError: as for :func:`check_controllers`.
    """
    if why := _failure(path, scenario, "this scenario's run"):
        raise ScenarioError([Problem(key, path, *why)], scenario.name)
    return make_controller(path, scenario)


def describe_error(error: BaseException) -> str:
    """Type and text of what a controller raised, of bounded length; an error of ours says what it was by itself."""
    kind = "" if isinstance(error, UmbilicalError) else f"{type(error).__name__}: "
    return shortened(f"{kind}{error}".rstrip(": "))


def shortened(reason: str) -> str:
    """A reason of bounded length."""
    return reason if len(reason) <= _LONGEST else f"{reason[:_LONGEST]}..."


def _not_trusted(study: Study, arm: Arm) -> tuple[str, str, str]:
    reason = "importing it runs its code, from the folder you are in or from the environment"
    return "a controller you trust", reason, "read it, then give --trust (in Python: trust=True)"


def _fails_in_its_arm(study: Study, arm: Arm) -> tuple[str, str, str] | None:
    return _failure(str(arm.controller), study.scenario_with(arm.changes), "this arm's run")


def _failure(path: str, scenario: Scenario, where: str) -> tuple[str, str, str] | None:
    """What is allowed, why this is not, and what to do; None where the controller works."""
    bound = "module:Class, or module:function that makes a controller from a scenario"
    fix = "see `Your own controller` in the guide"
    try:
        make = _factory(path)
    except AttributeError as error:
        return bound, str(error), nearest(path.partition(":")[2], _public(path))
    except ModuleNotFoundError as error:
        module = Path(path.partition(":")[0].removesuffix(".py")).name
        return bound, str(error), f"{module}:NAME, in the folder of {module}.py or installed"
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # sys.exit in a module must not end us
        return bound, f"importing it fails: {describe_error(error)}", fix
    try:
        controller = _made(make, scenario)
        if not isinstance(controller, Controller):
            missing = ", ".join(name for name in ("period", "start", "update") if not hasattr(controller, name))
            return bound, f"it gives {type(controller).__name__}, which has no {missing}", fix
        rehearse(scenario, controller)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # sys.exit in a controller must not end us
        return bound, f"it fails at the start of {where}: {describe_error(error)}", fix
    return None


def _problem(number: int, arm: Arm, bound: str, reason: str, fix: str) -> Problem:
    return Problem(f"arms.{number}.controller", f'"{arm.controller}"', bound, reason, fix)


def _factory(path: str) -> Callable[..., Any]:
    return getattr(_module(path), path.partition(":")[2])


def _public(path: str) -> list[str]:
    """What a module has that may be a controller or make one: its own classes and functions."""
    module = _module(path)
    found = [(name, value) for name, value in vars(module).items() if callable(value) and not name.startswith("_")]
    return [name for name, value in found if getattr(value, "__module__", "") == module.__name__]


def _module(path: str) -> ModuleType:
    if "" not in sys.path:
        sys.path.append("")  # controllers usually lie in the folder one works in
    return import_module(path.partition(":")[0])
