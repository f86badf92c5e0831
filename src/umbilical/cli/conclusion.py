"""What a command concluded: the one value from which its first line, its ``--json`` and its exit code follow."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from umbilical.cli.speech import DOES_NOT_HOLD, say, say_json

Decision = Literal["HOLDS", "DOES_NOT_HOLD", "UNRESOLVED", "NOT_ASKED"]


@dataclass(frozen=True)
class Conclusion:
    """A command's verdict.

    Attributes:
        decision: whether what was asked holds; UNRESOLVED where the evidence contradicts itself or does not suffice,
            NOT_ASKED where the command was not asked to judge.
        headline: the first line; it states the decision in words, and nothing printed below contradicts it.

    >>> Conclusion("UNRESOLVED", "my.toml: UNRESOLVED, two counts of the poles differ").exit_code
    7
    """

    decision: Decision
    headline: str

    @property
    def exit_code(self) -> int:
        """0, or 7 where what was asked does not hold or is not resolved."""
        return 0 if self.decision in ("HOLDS", "NOT_ASKED") else DOES_NOT_HOLD

    def document(self) -> dict[str, Any]:
        """The keys that lead every ``--json`` of a command that judges."""
        return {"verdict": self.decision, "headline": self.headline, "exit_code": self.exit_code}


def conclude(
    conclusion: Conclusion,
    *,
    text: Callable[[], str],
    document: Callable[[], Mapping[str, Any]],
    files: Mapping[str, Any] | None = None,
    as_json: bool,
) -> int:
    """Print a verdict and what it rests on.

    Args:
        conclusion: the verdict.
        text: makes what is printed below the headline.
        document: makes the rest of the ``--json`` object.
        files: written ones by role, unless ``text`` and ``document`` name them.
        as_json: whether to print one JSON object instead of text.

    Returns:
        The exit code.
    """
    if as_json:
        say_json({**conclusion.document(), "files": dict(files or {}), **document()})
    else:
        written = [f"  {role}: {path}" for role, path in (files or {}).items()]
        say("\n".join(filter(None, [conclusion.headline, text(), *written])))
    return conclusion.exit_code
