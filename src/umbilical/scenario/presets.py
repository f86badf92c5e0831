"""What comes with the package as TOML: scenarios, studies, operations, each in a folder ``presets`` of its own."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from importlib import resources
from typing import Any

from umbilical.errors import FileError, Problem, ScenarioError
from umbilical.scenario.document import Data, extend, read_document
from umbilical.scenario.problems import nearest, shown


class Presets:
    """The TOML files in a package's folder ``presets``.

    Args:
        package: whose folder.
        kind: what they are, for messages.
        whose: which of them can be extended, for messages.

    >>> "paper" in Presets("umbilical.scenario", "preset").names
    True
    """

    def __init__(self, package: str, kind: str, whose: str = "presets of this package") -> None:
        self._package, self._kind, self._whose = package, kind, whose

    @cached_property
    def _folder(self) -> Any:
        return resources.files(self._package) / "presets"

    @property
    def names(self) -> tuple[str, ...]:
        """Their names, sorted."""
        found = (item.name for item in self._folder.iterdir())
        return tuple(sorted(name.removesuffix(".toml") for name in found if name.endswith(".toml")))

    def text(self, name: str) -> str:
        """TOML text of one, as it is in the package.

        Raises:
            FileError: there is none of this name.
        """
        if name not in self.names:
            raise FileError(f"{name}: there is no {self._kind} of this name; {nearest(name, self.names)}")
        return (self._folder / f"{name}.toml").read_text(encoding="utf-8")

    def extended(self, data: Mapping[str, Any], origin: str) -> Data:
        """A document laid over the preset that it extends, which may itself extend another.

        Raises:
            ScenarioError: it extends something else.
        """
        if "extends" not in data:
            return dict(data)
        name = data["extends"]
        changes = {key: value for key, value in data.items() if key != "extends"}
        if name not in self.names:
            bound, reason = f"one of {', '.join(self.names)}", f"only the {self._whose} can be extended"
            near = nearest(name if isinstance(name, str) else "", self.names)
            raise ScenarioError([Problem("extends", shown(name), bound, reason, near)], origin)
        return extend(self.extended(read_document(self.text(name), name), name), changes)
