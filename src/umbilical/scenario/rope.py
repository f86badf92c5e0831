"""What only the rope knows: what happens across the string's plane, and its grid."""

from __future__ import annotations

from pydantic import Field

from umbilical.scenario.base import Number, Record, described
from umbilical.scenario.signals import Signal, signal_field


class Rope(Record):
    """What the cable in space has beside the string's keys. Read where ``model = "rope"``.

    x is the direction of the string's displacement y, y is across it, z is up.
    """

    elements: int = Field(
        default=10, ge=2, le=400, description="elements along the cable, four intervals of nodes each"
    )
    vessel_across: Signal = signal_field("m", "motion of the vessel in the direction y")
    force_across: Signal = signal_field("N", "external force on the body in the direction y")
    force_up: Signal = signal_field("N", "external force on the body in the direction z")
    thrust_directions: tuple[Number, ...] | None = Field(default=None, **described("thrust_direction"))
