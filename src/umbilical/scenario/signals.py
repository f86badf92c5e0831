"""Signals of time, composed by adding terms. Used for every load, disturbance and the vessel's motion."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from umbilical.scenario.base import Number, Record, quantity
from umbilical.scenario.source import FromFile, from_file


class Constant(Record):
    """The same value at all times."""

    kind: Literal["constant"]
    value: float = quantity("signal_value")


class Sine(Record):
    """``amplitude * sin(frequency * t + phase)``."""

    kind: Literal["sine"]
    amplitude: float = quantity("signal_value")
    frequency: float = quantity("signal_frequency", ge=0.0, reason="a negative frequency is a phase", fix="use phase")
    phase: float = quantity("signal_phase", 0.0)


class Bell(Record):
    """Generalised bell ``amplitude / (1 + |(t - center)/width|^(2 exponent))``."""

    kind: Literal["bell"]
    amplitude: float = quantity("signal_value")
    center: float = quantity("signal_time")
    width: float = quantity("signal_width", gt=0.0, reason="it divides the time", fix="give a positive width")
    exponent: float = quantity("signal_exponent", gt=0.0, le=100.0, reason="it is half a power", fix="2 is usual")


class Step(Record):
    """0 before ``time``, ``value`` from it on. The jump is a published instant."""

    kind: Literal["step"]
    value: float = quantity("signal_value")
    time: float = quantity(
        "signal_time", ge=0.0, reason="the run starts at 0", fix="use a constant for a step at the start"
    )


class Pulse(Record):
    """``value`` from ``start`` to ``end``, 0 otherwise. Both jumps are published instants."""

    kind: Literal["pulse"]
    value: float = quantity("signal_value")
    start: float = quantity("signal_time", ge=0.0, reason="the run starts at 0", fix="start the pulse at 0 or later")
    end: float = quantity("signal_time", gt=0.0, reason="the run starts at 0", fix="end the pulse after its start")


class Table(Record):
    """Values at times, with a smooth (cubic, twice differentiable), monotone (PCHIP) or linear curve between them.

    A smooth curve may leave its data by 5 % of their range at most; it is told from 1 % on. Where a linear table has
    an instant twice, it jumps.
    """

    kind: Literal["table"]
    times: tuple[Number, ...] = Field(min_length=2, description="increasing instants, s; they must cover the run")
    values: tuple[Number, ...] = Field(min_length=2, description="value at each instant")
    interpolation: Literal["smooth", "pchip", "linear"] = Field(
        default="smooth", description="curve between the instants"
    )
    file: FromFile | None = from_file("times", "values")


class Waves(Record):
    """A sum of regular waves ``amplitude * cos(frequency * t + phase)``: what a sea is, as numbers."""

    kind: Literal["waves"]
    frequencies: tuple[Number, ...] = Field(min_length=1, description="of each wave, rad/s, at most 30")
    amplitudes: tuple[Number, ...] = Field(min_length=1, description="of each wave")
    phases: tuple[Number, ...] = Field(min_length=1, description="of each wave, rad")


Term = Annotated[Constant | Sine | Bell | Step | Pulse | Table | Waves, Field(discriminator="kind")]
Signal = tuple[Term, ...]
"""A sum of terms; empty means zero."""


def signal_field(unit: str, meaning: str, default: Any = ()) -> Any:
    """A field of a signal: unit and meaning of its values; left out, there is none."""
    return Field(default, description=meaning, json_schema_extra={"unit": unit})
