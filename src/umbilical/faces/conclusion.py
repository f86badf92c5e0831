"""The verdict of a result: a decision, its words and the exit code that goes with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

DOES_NOT_HOLD = 7
"""Exit code of what does not hold or is not resolved."""
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
