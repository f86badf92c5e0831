"""Every error this package raises on purpose.

::

    UmbilicalError
    ├── ScenarioError        the scenario is wrong: every problem at once      exit code 2
    ├── FileError            a file cannot be read, or is not what it claims   exit code 2
    ├── OutputError          a result cannot be written where it was asked for exit code 4
    ├── ControllerError      a user's controller broke its contract            exit code 5
    └── MissingPartnerError  an optional package is not installed              exit code 6
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from umbilical.run import Run


class UmbilicalError(Exception):
    """Base of every error raised on purpose; ``exit_code`` is what the command line returns."""

    exit_code = 1


@dataclass(frozen=True)
class Problem:
    """One thing wrong with a scenario, said so that it can be mended without reading our code.

    Attributes:
        key: dotted key in the scenario, e.g. ``winch.end_length``.
        value: what was found, with its unit.
        bound: what is allowed.
        reason: why, in physical or numerical terms.
        fix: what to do about it.
    """

    key: str
    value: str
    bound: str
    reason: str
    fix: str

    def __str__(self) -> str:
        return (
            f"{self.key} = {self.value}\n    allowed: {self.bound}\n    because: {self.reason}\n    fix:     {self.fix}"
        )


class ScenarioError(UmbilicalError):
    """A scenario was refused before the first step; ``problems`` lists everything that is wrong."""

    exit_code = 2

    def __init__(self, problems: Sequence[Problem], origin: str = "scenario") -> None:
        self.problems = tuple(problems)
        self.origin = origin
        count = len(self.problems)
        head = f"{origin}: {count} problem{'s' if count != 1 else ''}"
        super().__init__("\n".join([head, *(f"  {p}".replace("\n", "\n  ") for p in self.problems)]))


class FileError(UmbilicalError):
    """A file is missing, unreadable, truncated or of another kind."""

    exit_code = 2


class OutputError(UmbilicalError):
    """A result cannot be written: the file exists, the folder is read-only, the disk is full."""

    exit_code = 4


class ControllerError(UmbilicalError):
    """A user's controller raised, or returned something that is not a command.

    ``run`` holds the samples up to then, with status FAILED, when the simulation had begun.
    """

    exit_code = 5
    run: Run | None = None


class MissingPartnerError(UmbilicalError):
    """An optional partner package is needed and not installed."""

    exit_code = 6


def expect(value: object, kind: str, maker: str) -> None:
    """Refuse what is no ``kind``, a class by its name, and name the function of the package that gives one.

    Raises:
        TypeError: it is not.

    >>> expect("paper", "Scenario", "load")
    Traceback (most recent call last):
    TypeError: a Scenario is needed here, not 'paper': umbilical.load('paper') gives one
    """
    if kind not in (base.__name__ for base in type(value).__mro__):
        path = str(value) if isinstance(value, str | os.PathLike) else None
        shown = repr(path) if path is not None else f"a {type(value).__name__}"
        argument = "..." if path is None else shown
        raise TypeError(f"a {kind} is needed here, not {shown}: umbilical.{maker}({argument}) gives one")


def import_partner(module: str, message: str) -> Any:
    """An optional package, imported.

    Raises:
        MissingPartnerError: it is not installed; the message says what it is needed for, and how to get it.
    """
    try:
        return import_module(module)
    except ImportError as error:
        raise MissingPartnerError(message) from error
