"""How a result is shown: its verdict, a text below the verdict's headline, and plain data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

from umbilical.tables import plain

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


class Face(NamedTuple):
    """How results of one kind are shown. Each function takes the result and what stands beside it, such as an audit.

    Attributes:
        conclusion: gives the verdict.
        text: gives what stands below the headline.
        document: gives data, without the verdict; records and arrays in it become plain data.
    """

    conclusion: Callable[..., Conclusion]
    text: Callable[..., str]
    document: Callable[..., dict[str, Any]]

    def summary(self, *found: Any) -> str:
        """The verdict and what it rests on."""
        return "\n".join(filter(None, [self.conclusion(*found).headline, self.text(*found)]))

    def to_dict(self, *found: Any) -> dict[str, Any]:
        """Plain data, the verdict first, and not to be contradicted by what a result says of itself."""
        verdict = self.conclusion(*found).document()
        return verdict | plain(self.document(*found)) | verdict
