"""Conditions that tuning keeps: each turns a scenario into a number, above 0 by as much as it is broken."""

from __future__ import annotations

from collections.abc import Callable
from math import isnan

from umbilical.errors import ScenarioError
from umbilical.scenario import Scenario

Constraint = Callable[[Scenario], float]


def certificate(scenario: Scenario) -> float:
    """Broken unless the ideal loop is proved to calm down over the whole run: the negative of its certified rate, 1/s.

    >>> from umbilical.admission import load
    >>> ringdown = load("ringdown")
    >>> certificate(ringdown.replace({"control.law.slope_gain": 5.0})) < 0.0
    True
    """
    from umbilical.analysis.certificate import certify  # mpmath and a search behind it

    try:
        found = certify(scenario)
    except ScenarioError:  # a law for which there is no certificate
        return 1.0
    if isnan(found.rate):
        return 1.0
    return -found.rate if found.holds else max(-found.rate, 1e-9)


CONSTRAINTS: dict[str, Constraint] = {"certificate": certificate}
"""Every condition by the name a study gives it in ``tuning.constraints``. That the scenario is admitted and that every
member completes is always one."""
