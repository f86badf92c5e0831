"""What only the rope knows: stretch, water, the body in space, and a vessel that heaves."""

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


class Sea(Record):
    """Irregular waves of JONSWAP that heave the sheave by the closed form of a box at zero speed."""

    significant_height: float = quantity(
        "significant_height", ge=0.0, le=20.0, reason="a sea", cure="metres, four standard deviations"
    )
    peak_period: float = quantity(
        "peak_period", ge=2.0, le=30.0, reason="a sea", cure="the period at the peak of the spectrum, e.g. 8 s"
    )
    peakedness: float = quantity("peakedness", 3.3, ge=1.0, le=7.0, reason="1 to 7 are seas", cure="3.3")
    heading: float = quantity(
        "wave_heading", 2.356194490192345, ge=-6.3, le=6.3, reason="an angle", cure="radians: 0 following, pi head sea"
    )
    components: int = Field(default=100, ge=20, le=2000, description="waves of equal energy")
    ship_length: float = quantity("ship_length", gt=0.0, le=500.0, reason="a ship", cure="in metres, at the waterline")
    breadth: float = quantity("ship_breadth", gt=0.0, le=100.0, reason="a ship", cure="in metres, at the waterline")
    draught: float = quantity("ship_draught", gt=0.0, le=30.0, reason="a ship", cure="in metres, at the waterline")
    block_coefficient: float = quantity("block_coefficient", gt=0.3, le=1.0, reason="of a ship", cure="0.5 to 0.9")
    sheave_forward: float = quantity("sheave_forward", 0.0, ge=-500.0, le=500.0, reason="pitch", cure="negative aft")


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
    sea: Sea | None = None
    vessel_across: Signal = _signal("motion of the vessel in the direction y", "m")
    vessel_heave: Signal = _signal("motion of the vessel in the direction z, beside the sea's", "m")
    force_across: Signal = _signal("external force on the body in the direction y", "N")
    force_up: Signal = _signal("external force on the body in the direction z", "N")
    thrust_directions: tuple[Number, ...] | None = Field(default=None, **words("thrust_direction"))
