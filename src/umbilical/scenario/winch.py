"""Winch laws: the cable length over the whole run. Each is twice differentiable between its published jumps."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from umbilical.scenario.base import Number, Record, quantity
from umbilical.scenario.source import FromFile, from_file

_SHORTEST = {
    "ge": 1.0, "le": 2e4, "fix": "lengths are in metres",
    "reason": "a cable under 1 m is no string in transverse vibration, one over 20 km is a slip of the unit",
}  # fmt: skip


class ConstantLength(Record):
    """The winch stands still."""

    law: Literal["constant"]
    length: float = quantity("length", **_SHORTEST)


class ConstantSpeed(Record):
    """``length = start_length + speed * t``: the winch runs at one speed from before the start."""

    law: Literal["speed"]
    start_length: float = quantity("winch_start_length", **_SHORTEST)
    speed: float = quantity("payout_speed")


class Quintic(Record):
    """From one length to another with zero speed and acceleration at both ends.

    ``l = l0 + (l1 - l0) (10 q^3 - 15 q^4 + 6 q^5)``, ``q = (t - start)/duration`` held to [0, 1].
    """

    law: Literal["quintic"]
    start_length: float = quantity("winch_start_length", **_SHORTEST)
    end_length: float = quantity("winch_end_length", **_SHORTEST)
    start: float = quantity("winch_start", 0.0, ge=0.0, reason="the run starts at 0", fix="0 or later")
    duration: float = quantity("winch_duration", gt=0.0, reason="it divides the time", fix="how long the winch runs, s")


class Trapezoid(Record):
    """Accelerate, hold a top speed, brake: the acceleration jumps at four published instants."""

    law: Literal["trapezoid"]
    start_length: float = quantity("winch_start_length", **_SHORTEST)
    end_length: float = quantity("winch_end_length", **_SHORTEST)
    top_speed: float = quantity("winch_top_speed", gt=0.0, reason="the direction follows from the lengths")
    acceleration: float = quantity("winch_acceleration", gt=0.0, reason="it divides the speed")
    start: float = quantity("winch_start", 0.0, ge=0.0, reason="the run starts at 0", fix="0 or later")


class Cosine(Record):
    """``length = start_length + amplitude (1 - cos(frequency t))``: a winch that comes and goes."""

    law: Literal["cosine"]
    start_length: float = quantity("winch_start_length", **_SHORTEST)
    amplitude: float = quantity("winch_amplitude", ge=-2e4, le=2e4)
    frequency: float = quantity("winch_frequency", gt=0.0, le=1e3, reason="it must move", fix="or use constant")


class TabulatedLength(Record):
    """Lengths at times, joined by a cubic spline (continuous acceleration)."""

    law: Literal["table"]
    times: tuple[Number, ...] = Field(min_length=4, description="increasing instants, s; they must cover the run")
    lengths: tuple[Number, ...] = Field(min_length=4, description="cable length at each instant, m")
    file: FromFile | None = from_file("times", "lengths", unit="m")


Winch = Annotated[
    ConstantLength | ConstantSpeed | Quintic | Trapezoid | Cosine | TabulatedLength, Field(discriminator="law")
]
