"""Faults of the motors, eq. (16): a timeline of what each motor no longer does.

A fault acts on the delivered signed square of the speed (``target = "thrust"``) or on the drive
voltage (``target = "voltage"``): ``delivered = effectiveness * wanted + stuck value``. Faults of one
motor that overlap multiply their effectiveness; a dead or stuck motor delivers nothing else.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from umbilical.scenario.base import Record, quantity

_SHARE = {
    "ge": 0.0, "le": 1.0, "reason": "it is the share still delivered: 0 nothing, 1 healthy",
    "fix": "a number from 0 to 1",
}  # fmt: skip


class _Fault(Record):
    motor: int = Field(ge=1, le=1000, description="number of the motor, from 1")
    target: Literal["thrust", "voltage"] = Field(default="thrust", description="what it spoils")
    start: float = quantity("fault_start", ge=0.0, reason="the run starts at 0", fix="0 for a fault from the start")
    end: float | None = quantity(
        "fault_end", None, gt=0.0, reason="recovery follows failure", fix="leave out for a fault that stays"
    )


class Partial(_Fault):
    """The motor still delivers a share of what it should."""

    kind: Literal["partial"]
    effectiveness: float = quantity("effectiveness", **_SHARE)


class Dead(_Fault):
    """The motor delivers nothing."""

    kind: Literal["dead"]


class Stuck(_Fault):
    """The motor delivers one value whatever it is told."""

    kind: Literal["stuck"]
    value: float = quantity("stuck_value")


class Ramp(_Fault):
    """Wear: effectiveness falls (or rises) in a straight line from 1 to its final value over ``over``, then stays."""

    kind: Literal["ramp"]
    effectiveness: float = quantity("effectiveness", **_SHARE)
    over: float = quantity("fault_ramp", gt=0.0, reason="it divides the time", fix="seconds the ramp takes")


class Intermittent(_Fault):
    """Comes and goes: present during the first ``duty`` of each ``cycle``."""

    kind: Literal["intermittent"]
    effectiveness: float = quantity("effectiveness", 0.0, **_SHARE)
    cycle: float = quantity("fault_cycle", gt=0.0, reason="it divides the time", fix="seconds from failure to failure")
    duty: float = quantity("duty", gt=0.0, lt=1.0, reason="a share of the cycle", fix="between 0 and 1")


Fault = Annotated[Partial | Dead | Stuck | Ramp | Intermittent, Field(discriminator="kind")]
