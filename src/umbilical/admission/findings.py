"""What a check may find; :mod:`umbilical.scenario.findings` has it, where the checks of forces can reach it."""

from __future__ import annotations

from umbilical.scenario.findings import Finding, Notice, amount

__all__ = ["Finding", "Notice", "amount"]
