"""The sea around cable and ROV: density, current, and what they displace, drag and move along."""

from __future__ import annotations

from pydantic import Field

from umbilical.scenario.base import Number, Record, quantity
from umbilical.scenario.signals import Signal, signal_field

_DRAGS = {"ge": 0.0, "reason": "drag brakes", "fix": "0 for none"}
_MOVES_ALONG = {"ge": 0.0, "le": 1e9, "reason": "water moves along", "fix": "0 for none"}


class CableInWater(Record):
    """What water does to a metre of cable, by Morison's formula."""

    diameter: float = quantity(
        "cable_diameter", gt=0.0, le=0.5, reason="no umbilical is half a metre thick", fix="metres, not millimetres"
    )
    normal_drag: float = quantity("normal_drag", 1.2, ge=0.0, le=10.0, reason="drag brakes", fix="0.8 to 2, 1.2 usual")
    tangential_drag: float = quantity(
        "tangential_drag", 0.01, ge=0.0, le=1.0, reason="drag brakes", fix="about 0.01, over the circumference"
    )
    added_mass: float = quantity("added_mass", 1.0, ge=0.0, le=5.0, reason="water moves along", fix="1 for a cylinder")
    strumming: float = quantity(
        "strumming", 0.0, ge=0.0, le=2.0, reason="an amplitude over the diameter", fix="0 for none, up to about 1"
    )


class BodyInWater(Record):
    """What water does to the ROV."""

    added_mass: float = quantity("body_horizontal_added_mass", 0.0, **_MOVES_ALONG)
    vertical_added_mass: float = quantity("body_vertical_added_mass", 0.0, **_MOVES_ALONG)
    displaced_mass: float = quantity("body_displaced", 0.0, **_MOVES_ALONG)
    linear_drag: float = quantity("body_linear_drag", 0.0, **_DRAGS)
    quadratic_drag: float = quantity("body_quadratic_drag", 0.0, **_DRAGS)
    vertical_drag: float = quantity("body_vertical_drag", 0.0, **_DRAGS)
    across_added_mass: float | None = quantity("body_across_added_mass", None, **_MOVES_ALONG)
    across_drag: float | None = quantity("body_across_drag", None, **_DRAGS)


class Current(Record):
    """Horizontal speed of the water in the cable's plane, linear between depths; constant above the first."""

    depths: tuple[Number, ...] = Field(
        min_length=2, max_length=100, description="increasing depths below the sheave's mean height, m"
    )
    speeds: tuple[Number, ...] = Field(min_length=2, max_length=100, description="speed at each depth, m/s")
    speeds_across: tuple[Number, ...] | None = Field(
        default=None, max_length=100, description="speed across the plane at each depth, m/s; only the rope feels it"
    )
    variation: Signal = signal_field("1", "what is added to 1 as the factor of all speeds")


class Water(Record):
    """The water."""

    density: float = quantity("water_density", 1025.0, gt=0.0, le=2e4, reason="a density", fix="1025 kg/m3 at sea")
    current: Current | None = None
