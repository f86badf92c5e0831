"""What only the rope knows: what happens across the string's plane, and its grid."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from umbilical.scenario.base import Number, Record, described
from umbilical.scenario.signals import Signal


def _signal(meaning: str, unit: str) -> Any:
    return Field(default=(), description=meaning, json_schema_extra={"unit": unit})


class Rope(Record):
    """What the cable in space has beside the string's keys. Read where ``model = "rope"``.

    x is the direction of the string's displacement y, y is across it, z is up.
    """

    elements: int = Field(
        default=10, ge=2, le=400, description="elements along the cable, four intervals of nodes each"
    )
    vessel_across: Signal = _signal("motion of the vessel in the direction y", "m")
    force_across: Signal = _signal("external force on the body in the direction y", "N")
    force_up: Signal = _signal("external force on the body in the direction z", "N")
    thrust_directions: tuple[Number, ...] | None = Field(default=None, **described("thrust_direction"))
