"""Conditions that tuning keeps: each turns a scenario into a number, above 0 by as much as it is broken."""

from __future__ import annotations

from collections.abc import Callable

from umbilical.scenario import Scenario

Constraint = Callable[[Scenario], float]

CONSTRAINTS: dict[str, Constraint] = {}
"""Every condition by the name a study gives it in ``tuning.constraints``. That the scenario is admitted and that every
member completes is always one."""
