"""Checks of heave in the tension of a cable that stretches, or does not: what becomes of it is told."""

from __future__ import annotations

from collections.abc import Iterator

from umbilical.errors import Problem
from umbilical.plant.checks.motion import sampled_top, sampled_winch
from umbilical.plant.checks.seas import sound
from umbilical.plant.seaway import heaving, sheave
from umbilical.plant.stretching import NEAR, Difference, difference
from umbilical.relations.tension import hanging_of, largest_tension, net_gravity
from umbilical.scenario.environment import Environment
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.signals import Table
from umbilical.scenario.winch import Winch

_STIFF, _WEAK = 100.0, 10.0
"""EA over the static tension at the sheave: below the first a stretch of 1 % is told, below the second refused."""


def heave_has_its_model(environment: Environment, model: str) -> Iterator[Finding]:
    """A sea's heave is left out of the string's tension unless it is asked for; the rope always heaves."""
    if (sea := environment.sea) is None or not sound(environment) or not sheave(environment).up:
        return
    if model != "rope" and not sea.heave:
        words = 'the sheave\'s heave is left out of the tension (environment.sea.heave, or model = "rope")'
        yield Notice("environment.sea", words)


def bears_what_hangs(
    environment: Environment, cable: Cable, payload: Payload, winch: Winch, duration: float
) -> Iterator[Finding]:
    """A string that is said to stretch does so by a little."""
    given, sampled = cable.axial_stiffness, sampled_winch(winch, duration)
    if given is None or not sampled:
        return
    still, hung = net_gravity(environment.gravity), hanging_of(cable, payload, environment)
    load = float(largest_tension(sampled[1].length, still, hung).max())
    if given < _WEAK * load:
        yield Problem(
            "cable.axial_stiffness", amount(given, "N"), f"at least {_WEAK * load:.4g} N, ten times the static tension",
            "the cable would stretch by more than a tenth", "EA in newton: modulus times area",
        )  # fmt: skip
    elif given < _STIFF * load:
        yield Notice("cable.axial_stiffness", f"{given:.4g} N: the static stretch reaches {load / given:.2%}")


def heave_of_a_cable_that_stretches(
    environment: Environment, cable: Cable, payload: Payload, winch: Winch, duration: float, model: str
) -> Iterator[Finding]:
    """How heave enters the tension is told: with the cable's stretch or without, and how far both are apart."""
    if model == "rope" or not sound(environment) or not heaving(environment):
        return
    if not sampled_top(winch, environment, duration):
        return
    key, given = _key(environment), cable.axial_stiffness
    if given is None:
        yield Notice(
            key, "heave enters the tension as of a cable that does not stretch: too little where waves are shorter "
            f"than {NEAR:g} axial periods of cable and body (cable.axial_stiffness says how stiff it is; "
            'model = "rope" knows slack, too)',
        )  # fmt: skip
        return
    if any(isinstance(f, Problem) for f in bears_what_hangs(environment, cable, payload, winch, duration)):
        return
    if any(isinstance(term, Table) for term in environment.vessel_heave or ()):
        yield Problem(
            "cable.axial_stiffness", amount(given, "N"), "left out where a table heaves",
            "stretch is worked out wave by wave, and a table has none", 'sines or a sea, or model = "rope"',
        )  # fmt: skip
    elif found := difference(winch, environment, cable, payload, duration):
        yield Notice(key, _told(found))


def _told(found: Difference) -> str:
    near = found.shortest <= NEAR * found.period
    limit = f"{'within' if near else 'beyond'} {NEAR:g} axial periods, {found.period:.3g} s on {found.length:.5g} m"
    how = "by the axial transfer of a cable that stretches" if near else "as of a cable that does not stretch"
    left_out = f"; between the ends it is taken to be linear, {found.middle:.3g} N off half way" if near else ""
    return (
        f"heave enters the tension {how}: its waves reach down to {found.shortest:.3g} s, {limit}. Root mean square "
        f"at the sheave {found.top:.4g} N with stretch and {found.rigid_top:.4g} N without, at the ROV "
        f"{found.end:.4g} N and {found.rigid_end:.4g} N{left_out}"
    )


def _key(environment: Environment) -> str:
    return "environment.sea.heave" if environment.sea and environment.sea.heave else "environment.vessel_heave"
