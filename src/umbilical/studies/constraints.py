"""Conditions that tuning keeps: each turns a scenario into a number, above 0 by as much as it is broken."""

from __future__ import annotations

from collections.abc import Callable
from math import isnan

from umbilical.certificate import certify
from umbilical.errors import ScenarioError
from umbilical.scenario import Scenario
from umbilical.stability.judgement import margins_at, usual_lengths

Constraint = Callable[[Scenario], float]
GAIN = 2.0
"""Factor by which thrusters may be stronger or weaker: 6 dB, as is usual."""
PHASE = 0.5235987755982988
"""Lag that must be survived, rad: 30 degrees, as is usual."""


def certificate(scenario: Scenario) -> float:
    """Broken unless the ideal loop is proved to calm down over the whole run: the negative of its certified rate, 1/s.

    >>> from umbilical.library import load
    >>> ringdown = load("ringdown")
    >>> certificate(ringdown.replace({"control.law.slope_gain": 5.0})) < 0.0
    True
    """
    try:
        found = certify(scenario, fix=False)
    except ScenarioError:  # a law for which there is no certificate
        return 1.0
    if isnan(found.rate):
        return 1.0
    return -found.rate if found.holds else max(-found.rate, 1e-9)


def margins_kept(scenario: Scenario) -> float:
    """Broken unless the linearised sampled loop is stable at the shortest, middle and longest length of the run, and
    survives thrusters of half and of twice their strength, and :data:`PHASE` of lag: the unstable poles, or the largest
    share of a margin that is missing.

    >>> from umbilical.library import load
    >>> 0.0 < margins_kept(load("paper")) < 1.0  # stable, but not with twice the thrust
    True
    """
    try:
        found = [margins_at(scenario, length) for length in usual_lengths(scenario)]
    except ScenarioError:  # no loop, or one that cannot be linearised
        return 1.0
    if unstable := sum(one.stability.unstable for one in found):
        return float(unstable)
    limits = [one.margins for one in found if one.margins is not None]
    return max(
        max(GAIN * one.gain_low.size, GAIN / one.gain_high.size, PHASE / max(one.phase.size, 1e-9)) for one in limits
    ) - 1.0  # fmt: skip


CONSTRAINTS: dict[str, Constraint] = {"certificate": certificate, "margins": margins_kept}
"""Every condition by the name a study gives it in ``tuning.constraints``. That the scenario is admitted and that every
member completes is always one."""
