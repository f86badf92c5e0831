"""An operation in one sea as a scenario of the rope, to hold a limit against the time domain."""

from __future__ import annotations

from math import ceil, pi, sqrt
from typing import Any

from umbilical.errors import Problem, ScenarioError
from umbilical.scenario.scenario import Scenario, validate
from umbilical.screening.operate import steepest_height
from umbilical.screening.operation import Operation

_WATER = 1025.0
_ELEMENT = 300.0
"""Longest element, m; four at the least. Both keep the tension of a sea of 4 s and more within 1e-3."""
_WAVES = 500
"""Components: with 200 a sea of three hours would come back to itself too soon."""
_RAMP, _STORED = 60.0, 0.5
SETTLED = 200.0
"""Seconds after which the sea counts."""


def on_the_rope(
    operation: Operation, *, depth: float, period: float, heading: float, height: float, duration: float
) -> Scenario:
    """Set up the rope in a sea: what hangs, the vessel that heaves it, no current and no control.

    Args:
        operation: vessel, cable, body, without compensation.
        depth: cable paid out, m.
        period, heading, height: Tp, s; direction the waves go to, rad; Hs, m.
        duration: s, that counts; :data:`SETTLED` comes before.

    Raises:
        ScenarioError: the operation has heave compensation, which the rope does not know.

    >>> from umbilical.screening import load_operation
    >>> sea = {"period": 8.0, "heading": 2.36, "height": 1.5}
    >>> case = on_the_rope(load_operation("work-class"), depth=1500.0, duration=600.0, **sea)
    >>> case.model, round(case.cable.water.diameter, 3), case.rope.elements
    ('rope', 0.04, 5)
    """
    if operation.compensation is not None:
        reason = "the winch of a scenario follows its law; one that follows the heave is not among them"
        problem = Problem("compensation", "given", "left out", reason, "confirm the limit without compensation")
        raise ScenarioError([problem], operation.name)
    cable, body = operation.cable, operation.payload
    diameter = sqrt(4.0 * max(cable.line_density - cable.wet_line_density, 0.0) / (pi * _WATER))
    along = cable.tangential_drag / (0.5 * _WATER * pi * diameter) if diameter else 0.0
    system = {
        "significant_height": min(height, float(steepest_height(period)) * 0.999), "peak_period": period,
        "peakedness": operation.sea.peakedness, "heading": heading, "components": _WAVES,
    }  # fmt: skip
    document: dict[str, Any] = {
        "schema_version": 1, "name": f"{operation.name} on the rope", "model": "rope", "ideal_thruster": True,
        "duration": SETTLED + duration,
        "cable": {
            "line_density": cable.line_density, "wet_line_density": cable.wet_line_density, "damping": 0.0,
            "axial_stiffness": cable.axial_stiffness,
        },
        "payload": {
            "mass": body.mass, "wet_weight": body.wet_weight, "damping": 0.0,
            "water": {
                "added_mass": body.added_mass, "vertical_added_mass": body.added_mass,
                "quadratic_drag": body.quadratic_drag, "vertical_drag": body.quadratic_drag,
            },
        },
        "rope": {"elements": max(4, ceil(depth / _ELEMENT))},
        "environment": {
            "gravity": operation.environment.gravity, "vessel_ramp": _RAMP, "payload_force": [], "water": {},
            "sea": {"systems": [system], "vessel": operation.vessel.model_dump(exclude_none=True)},
        },
        "winch": {"law": "constant", "length": depth}, "initial": {"shape": "equilibrium"},
        "control": {"period": 0.05, "law": {"kind": "none"}}, "grid": {"step": 0.05}, "output": {"interval": _STORED},
    }  # fmt: skip
    if diameter:
        document["cable"]["water"] = {"diameter": diameter, "tangential_drag": along}
    return validate(document, operation.name)
