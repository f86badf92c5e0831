"""Checks of weights in water against masses: water bears weight, it adds none."""

from __future__ import annotations

from collections.abc import Iterator

from umbilical.errors import Problem
from umbilical.relations.tension import hanging, inertial_tension, net_gravity
from umbilical.scenario.control import Control
from umbilical.scenario.environment import Environment
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.hardware import Cable, Payload

_ROUNDING = 1e-9
"""Share by which a weight in water may exceed that in air: m g written out by hand."""


def cable_in_water(cable: Cable, environment: Environment) -> Iterator[Finding]:
    """The cable weighs no more in water than in air."""
    wet, dry = cable.wet_line_density, cable.line_density
    if wet is not None and wet > dry * (1.0 + _ROUNDING):
        of_weight = wet / _in_air(1.0, environment.gravity)
        hint = f"{wet:g} N/m of weight are {of_weight:.6g} kg/m" if of_weight <= dry else "check both densities"
        reason = "water bears weight, it adds none; the key is the weight of a metre in water over g, in kg/m"
        bound = f"at most cable.line_density, {dry:g} kg/m"
        yield Problem("cable.wet_line_density", amount(wet, "kg/m"), bound, reason, hint)


def payload_in_water(payload: Payload, environment: Environment) -> Iterator[Finding]:
    """The ROV weighs no more in water than in air; a weight that looks like a mass is asked about."""
    wet, gravity = payload.wet_weight, environment.gravity
    if wet is None:
        return
    yield from _below_the_weight_in_air("payload.wet_weight", wet, payload.mass, gravity)
    if wet <= payload.mass:
        share = wet / _in_air(payload.mass, gravity)
        words = f"{wet:g} N is {share:.2g} of the ROV's weight in air and leaves the cable nearly slack; if {wet:g} kg "
        yield Notice("payload.wet_weight", f"{words}was meant, that is {_in_air(wet, gravity):.6g} N")


def believed_in_water(control: Control, payload: Payload, environment: Environment) -> Iterator[Finding]:
    """Nor does the ROV that the controller believes in."""
    believed = control.nominal
    if believed.payload_wet_weight is not None:
        mass, gravity = believed.payload_mass or payload.mass, believed.gravity or environment.gravity
        key = "control.nominal.payload_wet_weight"
        yield from _below_the_weight_in_air(key, believed.payload_wet_weight, mass, gravity)


def _below_the_weight_in_air(key: str, wet: float, mass: float, gravity: float) -> Iterator[Finding]:
    dry = _in_air(mass, gravity)
    if wet > dry * (1.0 + _ROUNDING):
        yield Problem(key, amount(wet, "N"),
                      f"at most the weight in air, {mass:g} kg * {gravity:g} m/s2 = {dry:g} N",
                      "water bears weight, it adds none",
                      "the weight in water in newton, or leave it out for the weight in air")  # fmt: skip


def _in_air(mass: float, gravity: float) -> float:
    """m g, N."""
    return inertial_tension(0.0, net_gravity(gravity), hanging(mass, 0.0, gravity))
