"""Checks of heave in the tension of a cable that stretches, or does not: what becomes of it is told."""

from __future__ import annotations

from collections.abc import Iterator

from umbilical.errors import Problem
from umbilical.plant.checks.moving import MovingCable, sampled_top, sampled_winch
from umbilical.plant.checks.seas import sound
from umbilical.plant.checks.timeline import refuses
from umbilical.plant.seaway import heaving, sheave
from umbilical.plant.stretching import NEAR, Difference, difference
from umbilical.relations.tension import hanging_of, largest_tension, net_gravity
from umbilical.scenario.environment import Environment
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.signals import Table

_STIFF, _WEAK = 100.0, 10.0
"""EA over the static tension at the sheave: below the first a stretch of 1 % is told, below the second refused."""


def heave_has_its_model(environment: Environment, model: str) -> Iterator[Finding]:
    """A sea's heave is left out of the string's tension unless it is asked for; the rope always heaves."""
    if (sea := environment.sea) is None or not sound(environment) or not sheave(environment).up:
        return
    if model != "rope" and not sea.heave:
        words = 'the sheave\'s heave is left out of the tension (environment.sea.heave, or model = "rope")'
        yield Notice("environment.sea", words)


def bears_what_hangs(moving: MovingCable) -> Iterator[Finding]:
    """A string that is said to stretch does so by a little."""
    given, sampled = moving.cable.axial_stiffness, sampled_winch(moving.winch, moving.duration)
    if given is not None and sampled:
        still, hung = net_gravity(moving.environment.gravity), hanging_of(*moving[3:], moving.environment)
        yield from stretches_little(given, float(largest_tension(sampled[1].length, still, hung).max()))


def stretches_little(stiffness: float, load: float) -> Iterator[Finding]:
    """EA, N, is well above the largest static load, N."""
    key = "cable.axial_stiffness"
    if stiffness < _WEAK * load:
        yield Problem(key, amount(stiffness, "N"), f"at least {_WEAK * load:.4g} N, ten times the static tension",
                      "the cable would stretch by more than a tenth, where no material is linear",
                      "EA in newton: modulus times area, or force over strain of the whole cable")  # fmt: skip
    elif stiffness < _STIFF * load:
        yield Notice(key, f"{stiffness:.4g} N: the static stretch reaches {load / stiffness:.2%}")


def heave_of_a_cable_that_stretches(moving: MovingCable, model: str) -> Iterator[Finding]:
    """How heave enters the tension is told: with the cable's stretch or without, and how far both are apart."""
    environment, given = moving.environment, moving.cable.axial_stiffness
    if model == "rope" or not sound(environment) or not heaving(environment):
        return
    if not sampled_top(moving.winch, environment, moving.duration):
        return
    key = "environment.sea.heave" if environment.sea and environment.sea.heave else "environment.vessel_heave"
    if given is None:
        yield Notice(
            key, "heave enters the tension as of a cable that does not stretch: too little where waves are shorter "
            f"than {NEAR:g} axial periods of cable and body (cable.axial_stiffness says how stiff it is; "
            'model = "rope" knows slack, too)',
        )  # fmt: skip
    elif refuses(bears_what_hangs(moving)):
        return
    elif any(isinstance(term, Table) for term in environment.vessel_heave or ()):
        yield Problem("cable.axial_stiffness", amount(given, "N"), "left out where a table heaves",
                      "stretch is worked out wave by wave, and a table has none",
                      'sines or a sea, or model = "rope"')  # fmt: skip
    elif found := difference(moving.winch, environment, moving.cable, moving.payload, moving.duration):
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
