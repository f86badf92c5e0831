"""What a check may find: a problem, which refuses the scenario, or a notice, which lets it in."""

from __future__ import annotations

from dataclasses import dataclass

from umbilical.errors import Problem


@dataclass(frozen=True)
class Notice:
    """Something allowed that is probably not meant.

    Attributes:
        key: dotted key in the scenario.
        message: what is odd about it.
    """

    key: str
    message: str

    def __str__(self) -> str:
        return f"{self.key}: {self.message}"


Finding = Problem | Notice


def amount(value: float, unit: str) -> str:
    """A number with six digits and its unit."""
    return f"{value:.6g} {unit}" if unit else f"{value:.6g}"
