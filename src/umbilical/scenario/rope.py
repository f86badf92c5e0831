"""What only the rope knows: stretch, water, the body in space, and a vessel that moves in it."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

from umbilical.scenario.base import Number, Record, quantity, words
from umbilical.scenario.signals import Signal

Vector = Annotated[tuple[Number, Number, Number], Field()]


def _signal(meaning: str, unit: str) -> Any:
    return Field(default=(), description=meaning, json_schema_extra={"unit": unit})


class WaterLevel(Record):
    """Velocity of the water at one height, linear between levels; the highest and the lowest hold beyond."""

    height: float = quantity("water_height", le=0.0, ge=-2e4, reason="0 is the surface", cure="metres, negative below")
    x: float = quantity("water_speed", 0.0, ge=-10.0, le=10.0, reason="a current", cure="m/s, not knots")
    y: float = quantity("water_speed", 0.0, ge=-10.0, le=10.0, reason="a current", cure="m/s, not knots")


class Rope(Record):
    """The cable in space: elastic, slack where nothing pulls, in water. Read where ``model = "rope"``.

    x is the direction of the string's displacement y, y is across it, z is up.
    """

    elements: int = Field(
        default=10, ge=2, le=400, description="elements along the cable, four intervals of nodes each"
    )
    axial_stiffness: float | None = quantity(
        "axial_stiffness", None, gt=0.0, reason="the cable is elastic",
        cure="newton, from the maker; left out: ten thousand times the static tension at the vessel, assumed",
    )  # fmt: skip
    line_weight: float | None = quantity(
        "line_weight", None, ge=-1e5, le=1e5, reason="negative floats",
        cure="N/m in water; left out, it follows from cable.wet_line_density or cable.line_density",
    )  # fmt: skip
    diameter: float = quantity(
        "cable_diameter", 0.0, ge=0.0, le=0.5, reason="metres, not millimetres", cure="0 is a cable without water"
    )
    normal_drag: float = quantity("normal_drag", 1.2, ge=0.0, le=10.0, reason="drag brakes", cure="1.2, strumming 2")
    tangential_drag: float = quantity("tangential_drag", 0.01, ge=0.0, le=1.0, reason="drag brakes", cure="0.01")
    added_mass: float = quantity("added_mass", 1.0, ge=0.0, le=5.0, reason="water moves along", cure="1 for a cable")
    body_added_mass: Vector = Field(default=(0.0, 0.0, 0.0), **words("body_added_mass"))
    body_drag: Vector = Field(default=(0.0, 0.0, 0.0), **words("body_drag"))
    body_displaced: float = quantity("body_displaced", 0.0, ge=0.0, le=1e8, reason="a mass", cure="kg of sea water")
    current: tuple[WaterLevel, ...] = Field(default=(), max_length=200, description="velocity of the water, downwards")
    vessel_across: Signal = _signal("motion of the vessel in the direction y", "m")
    vessel_heave: Signal = _signal("motion of the vessel in the direction z, beside what environment.sea gives", "m")
    force_across: Signal = _signal("external force on the body in the direction y", "N")
    force_up: Signal = _signal("external force on the body in the direction z", "N")
    thrust_directions: tuple[Number, ...] | None = Field(default=None, **words("thrust_direction"))
