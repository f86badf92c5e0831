"""Checks of the sea around cable and ROV: dry, wet, displaced and added masses told apart, current and heave."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.errors import Problem
from umbilical.plant.checks.moving import sampled_top
from umbilical.plant.checks.tables import TableOf, problems_of_a_table
from umbilical.plant.checks.timeline import numbered, refuses, signals_of_the_environment
from umbilical.plant.signals import heave
from umbilical.relations.instants import reaches
from umbilical.relations.tension import mass_of_weight
from umbilical.relations.water import in_water
from umbilical.scenario.environment import Environment
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.signals import Bell, Pulse, Step
from umbilical.scenario.winch import Winch

_APART = 0.1
"""Share by which a weight in water may differ from what the displaced water says before it is told."""
_FLOATS = "a cable that floats bends upwards and its tension vanishes: that needs a full model of the cable"
_FASTEST_CURRENT, _LARGEST_HEAVE = 5.0, 10.0


def water_is_there(cable: Cable, payload: Payload, environment: Environment) -> Iterator[Finding]:
    """What is in water has water around it."""
    for key, section in (("cable.water", cable.water), ("payload.water", payload.water)):
        if section is not None and environment.water is None:
            fix = "add [environment.water] with a density of 1025.0 kg/m3, or leave the section out"
            reason = "drag and added mass need the density of the water"
            yield Problem(key, "given", "together with environment.water", reason, fix)


def only_the_rope(model: str, cable: Cable, payload: Payload, environment: Environment) -> Iterator[Finding]:
    """A cable that floats is no string; what acts across its plane is left out, and that is told."""
    if model == "rope":
        return
    if cable.wet_line_density is not None and cable.wet_line_density < 0.0:
        yield Problem("cable.wet_line_density", amount(cable.wet_line_density, "kg/m"),
                      'at least 0 kg/m, or model = "rope"', _FLOATS,
                      'model = "rope", or the weight of a metre in water over g: 0 floats')  # fmt: skip
    current = environment.water.current if environment.water else None
    rows = (("payload.water", payload.water, "across_added_mass"), ("payload.water", payload.water, "across_drag"),
            ("environment.water.current", current, "speeds_across"))  # fmt: skip
    for key, section, name in rows:
        if getattr(section, name, None) is not None:
            words = 'nothing across the plane counts for the string; model = "rope" reads it'
            yield Notice(f"{key}.{name}", words)


def cable_displaces(cable: Cable, payload: Payload, environment: Environment, model: str) -> Iterator[Finding]:
    """A cable in water has its weight there; a string is heavier than the water it displaces."""
    if cable.water is None or environment.water is None:
        return
    displaced, dry, wet = in_water(cable, payload, environment).displaced, cable.line_density, cable.wet_line_density
    key, left = "cable.wet_line_density", dry - displaced
    if dry < displaced and model != "rope":
        bound = f"at least the {displaced:.6g} kg/m of water that {cable.water.diameter:g} m of diameter displace"
        fix = 'the dry mass of a metre, flooded water included, and the diameter in metres; or model = "rope"'
        yield Problem("cable.line_density", amount(dry, "kg/m"), bound, _FLOATS, fix)
    elif wet is None:
        fix = f"{left:.6g} kg/m, which is {dry:g} less the {displaced:.6g} kg/m that it displaces"
        reason = "left out it would weigh as in air, and drag as in water"
        yield Problem(key, "left out", "given for a cable in water", reason, fix)
    elif abs(wet - left) > _APART * dry:
        words = f"{wet:g} kg/m, but {dry:g} kg/m less the displaced {displaced:.4g} kg/m are {left:.4g} kg/m: "
        yield Notice(key, words + "is the cable flooded, or the diameter another?")


def payload_displaces(payload: Payload, environment: Environment) -> Iterator[Finding]:
    """A ROV in water has its weight there."""
    if payload.water is None:
        return
    key, weight, left = "payload.wet_weight", payload.wet_weight, payload.mass - payload.water.displaced_mass
    if weight is None:
        fix = "its weight in water in newton: what a load cell shows when it hangs there"
        reason = "left out it would weigh m g as in air, and drag as in water"
        yield Problem(key, "left out", "given for a ROV in water", reason, fix)
    elif payload.water.displaced_mass > 0.0:
        found = mass_of_weight(weight, environment.gravity)
        if abs(found - left) > _APART * payload.mass:
            words = f"{weight:g} N are the weight of {found:.4g} kg, but mass less displaced_mass is {left:.4g} kg: "
            yield Notice(key, words + "is one of the three a slip?")


def table_of_the_current(environment: Environment) -> Iterator[Finding]:
    """Depths of the current increase, and each has its speeds."""
    if current := environment.water.current if environment.water else None:
        place = TableOf("environment.water.current", "depths", "speeds", (current.depths[0], current.depths[-1]))
        broken = tuple(problems_of_a_table(place, current.depths, len(current.speeds)))
        yield from broken
        if (across := current.speeds_across) is not None and not broken:
            yield from problems_of_a_table(place._replace(values="speeds_across"), current.depths, len(across))


def current_profile(environment: Environment, winch: Winch, duration: float) -> Iterator[Finding]:
    """The current is known down to the ROV, all through the run."""
    current = environment.water.current if environment.water else None
    if current is None:
        return
    key, across, last = "environment.water.current", current.speeds_across, current.depths[-1]
    yield from (broken := tuple(table_of_the_current(environment)))
    fastest = max(map(abs, (*current.speeds, *(across or ()))))
    if fastest > _FASTEST_CURRENT:
        yield Problem(f"{key}.speeds", amount(fastest, "m/s"), f"at most {_FASTEST_CURRENT:g} m/s",
                      "no current at sea is faster", "metres per second: a knot is 0.514 m/s")  # fmt: skip
    if broken or refuses(signals_of_the_environment(environment, duration)):
        return
    if sampled := sampled_top(winch, environment, duration):
        depth = float(np.max(sampled[1].length - sampled[1].heave))
        if not reaches(last, depth, depth):
            bound = f"at least to the ROV, which reaches {depth:.6g} m"
            reason, fix = "nothing is known of the water below", "one more depth, with the speed there"
            yield Problem(f"{key}.depths", f"down to {last:g} m", bound, reason, fix)


def heave_is_smooth(environment: Environment, duration: float) -> Iterator[Finding]:
    """The tension follows the heave's acceleration, and its work the rate of that: a heave has three derivatives."""
    broken = False
    for key, term in numbered("environment.vessel_heave", environment.vessel_heave or ()):
        linear = getattr(term, "interpolation", "") == "linear"
        if linear or isinstance(term, Step | Pulse | Bell):
            broken, name, value = True, *(("interpolation", "linear") if linear else ("kind", term.kind))
            yield Problem(f"{key}.{name}", f'"{value}"', "constant, sine or a smooth table",
                          "the tension follows the acceleration of the sheave, which this has not everywhere",
                          'sines, or a table with interpolation = "smooth"')  # fmt: skip
    if environment.vessel_heave and not broken and not any(signals_of_the_environment(environment, duration)):
        largest = float(np.abs(heave(environment, np.linspace(0.0, duration, 4001))[0]).max())
        if largest > _LARGEST_HEAVE:
            yield Notice("environment.vessel_heave", f"up to {largest:.4g} m: metres, or millimetres?")
