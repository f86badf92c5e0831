"""Checks of the sea around cable and ROV: dry, wet, displaced and added masses told apart, current and heave."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.errors import Problem
from umbilical.plant.checks.motion import sampled_top
from umbilical.plant.checks.tables import TableOf, problems_of_a_table
from umbilical.plant.checks.timeline import signals_of_the_environment
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
_FASTEST_CURRENT, _LARGEST_HEAVE = 5.0, 10.0


def water_is_there(cable: Cable, payload: Payload, environment: Environment) -> Iterator[Finding]:
    """What is in water has water around it."""
    for key, section in (("cable.water", cable.water), ("payload.water", payload.water)):
        if section is not None and environment.water is None:
            yield Problem(
                key,
                "given",
                "together with environment.water",
                "drag and added mass need the density of the water",
                "add [environment.water] with a density of 1025.0 kg/m3, or leave the section out",
            )


def only_the_rope(model: str, cable: Cable, payload: Payload, environment: Environment) -> Iterator[Finding]:
    """A cable that floats is no string; what acts across its plane is left out, and that is told."""
    if model == "rope":
        return
    if cable.wet_line_density is not None and cable.wet_line_density < 0.0:
        yield Problem(
            "cable.wet_line_density",
            amount(cable.wet_line_density, "kg/m"),
            'at least 0 kg/m, or model = "rope"',
            "a cable that floats bends upwards and its tension vanishes: that needs a full model of the cable",
            'model = "rope", or the weight of a metre in water over g: 0 floats',
        )
    current = environment.water.current if environment.water else None
    across = {
        "payload.water.across_added_mass": payload.water and payload.water.across_added_mass,
        "payload.water.across_drag": payload.water and payload.water.across_drag,
        "environment.water.current.speeds_across": current and current.speeds_across,
    }
    for key, given in across.items():
        if given is not None:
            yield Notice(key, 'nothing across the plane counts for the string; model = "rope" reads it')


def cable_displaces(cable: Cable, payload: Payload, environment: Environment, model: str) -> Iterator[Finding]:
    """A cable in water has its weight there; a string is heavier than the water it displaces."""
    if cable.water is None or environment.water is None:
        return
    displaced, dry, wet = in_water(cable, payload, environment).displaced, cable.line_density, cable.wet_line_density
    if dry < displaced and model != "rope":
        yield Problem(
            "cable.line_density",
            amount(dry, "kg/m"),
            f"at least the {displaced:.6g} kg/m of water that {cable.water.diameter:g} m of diameter displace",
            "a cable that floats bends upwards and its tension vanishes: that needs a full model of the cable",
            'the dry mass of a metre, flooded water included, and the diameter in metres; or model = "rope"',
        )
    elif wet is None:
        yield Problem(
            "cable.wet_line_density",
            "left out",
            "given for a cable in water",
            "left out it would weigh as in air, and drag as in water",
            f"{dry - displaced:.6g} kg/m, which is {dry:g} less the {displaced:.6g} kg/m that it displaces",
        )
    elif abs(wet - (dry - displaced)) > _APART * dry:
        yield Notice(
            "cable.wet_line_density",
            f"{wet:g} kg/m, but {dry:g} kg/m less the displaced {displaced:.4g} kg/m are {dry - displaced:.4g} kg/m: "
            "is the cable flooded, or the diameter another?",
        )


def payload_displaces(payload: Payload, environment: Environment) -> Iterator[Finding]:
    """A ROV in water has its weight there."""
    if payload.water is None:
        return
    displaced, weight = payload.water.displaced_mass, payload.wet_weight
    if weight is None:
        yield Problem(
            "payload.wet_weight",
            "left out",
            "given for a ROV in water",
            "left out it would weigh m g as in air, and drag as in water",
            "its weight in water in newton: what a load cell shows when it hangs there",
        )
    elif displaced > 0.0:
        of_masses = payload.mass - displaced
        found = mass_of_weight(weight, environment.gravity)
        if abs(found - of_masses) > _APART * payload.mass:
            yield Notice(
                "payload.wet_weight",
                f"{weight:g} N are the weight of {found:.4g} kg, but mass less displaced_mass is {of_masses:.4g} kg: "
                "is one of the three a slip?",
            )


def current_profile(environment: Environment, winch: Winch, duration: float) -> Iterator[Finding]:
    """The current is known down to the ROV, all through the run."""
    current = environment.water.current if environment.water else None
    if current is None:
        return
    place = TableOf("environment.water.current", "depths", "speeds", (current.depths[0], current.depths[-1]))
    across = current.speeds_across
    broken = tuple(problems_of_a_table(place, current.depths, len(current.speeds)))
    if across is not None and not broken:
        broken = tuple(problems_of_a_table(place._replace(values="speeds_across"), current.depths, len(across)))
    yield from broken
    fastest = max(map(abs, (*current.speeds, *(across or ()))))
    if fastest > _FASTEST_CURRENT:
        yield Problem(
            "environment.water.current.speeds",
            amount(fastest, "m/s"),
            f"at most {_FASTEST_CURRENT:g} m/s",
            "no current at sea is faster",
            "metres per second: a knot is 0.514 m/s",
        )
    if broken or any(True for _ in signals_of_the_environment(environment, duration)):
        return
    if sampled := sampled_top(winch, environment, duration):
        depth = float(np.max(sampled[1].length - sampled[1].heave))
        if not reaches(current.depths[-1], depth, depth):
            yield Problem(
                "environment.water.current.depths",
                f"down to {current.depths[-1]:g} m",
                f"at least to the ROV, which reaches {depth:.6g} m",
                "nothing is known of the water below",
                "one more depth, with the speed there",
            )


def heave_is_smooth(environment: Environment, duration: float) -> Iterator[Finding]:
    """The tension follows the heave's acceleration, and its work the rate of that: a heave has three derivatives."""
    broken = False
    for number, term in enumerate(environment.vessel_heave or (), start=1):
        linear = getattr(term, "interpolation", "") == "linear"
        if linear or isinstance(term, Step | Pulse | Bell):
            broken = True
            yield Problem(
                f"environment.vessel_heave.{number}.{'interpolation' if linear else 'kind'}",
                '"linear"' if linear else f'"{term.kind}"',
                "constant, sine or a smooth table",
                "the tension follows the acceleration of the sheave, which this has not everywhere",
                'sines, or a table with interpolation = "smooth"',
            )
    if environment.vessel_heave and not broken and not any(signals_of_the_environment(environment, duration)):
        largest = float(np.abs(heave(environment, np.linspace(0.0, duration, 4001))[0]).max())
        if largest > _LARGEST_HEAVE:
            yield Notice("environment.vessel_heave", f"up to {largest:.4g} m: metres, or millimetres?")
