"""Vessels that waves move: a closed form of a few dimensions, or a table of response amplitude operators (RAOs)."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from umbilical.scenario.base import Number, Record, measured
from umbilical.scenario.source import FromFile

_FORWARD = measured("m", "sheave forward of midship", 0.0, ge=-500.0, le=500.0, reason="pitch")
_PORT = measured("m", "sheave to port of midship", 0.0, ge=-100.0, le=100.0, reason="roll")
_UP = measured("m", "sheave above the waterline", 0.0, ge=-50.0, le=100.0, reason="its lever of roll and pitch")


class BoxShip(Record):
    """A vessel by the closed form of Jensen, Mansour and Olsen, and where its sheave is."""

    kind: Literal["box"] = "box"
    length: float = measured("m", "length at the waterline", gt=0.0, le=500.0, reason="a ship")
    breadth: float = measured("m", "breadth at the waterline", gt=0.0, le=100.0, reason="a ship")
    draught: float = measured("m", "draught", gt=0.0, le=30.0, reason="a ship")
    block_coefficient: float = measured(
        "1", "displaced volume over length, breadth, draught", gt=0.3, le=1.0, reason="of a ship", fix="0.5 to 0.9"
    )
    sheave_forward: float = _FORWARD
    sheave_port: float = _PORT
    sheave_up: float = _UP


def _rows(unit: str, meaning: str, default: Any = ()) -> Any:
    return Field(default, description=meaning, json_schema_extra={"unit": unit})


_FILLS: dict[str, Any] = {"reader": "rao", "fills": ["heading", "frequency", "heave"]}


class RaoShip(Record):
    """A vessel by a table of its RAOs, one row for each heading and frequency, with declared conventions.

    A phase is that of the motion against the crest of a wave at ``phase_origin``. Positions are from midship at the
    waterline: forward, port, up.
    """

    kind: Literal["rao"]
    phase: Literal["lag", "lead"] = Field(description="whether a positive phase is behind the crest or ahead of it")
    axes: Literal["port_up", "starboard_down"] = Field(
        description="y to port and z up (pitch is bow down), or y to starboard and z down (pitch is bow up)"
    )
    waves: Literal["towards", "from"] = Field(
        description="a heading is where the waves go to (0 following) or come from (0 head sea), from x towards y"
    )
    phase_origin: tuple[Number, Number] = _rows("m", "forward, port of midship", (0.0, 0.0))
    motion_point: tuple[Number, Number, Number] = _rows("m", "forward, port, up of what moves so", (0.0, 0.0, 0.0))
    rotations: Literal["per_metre", "per_slope"] = Field(
        default="per_metre", description="rotations in rad per metre of wave amplitude, or per wave slope"
    )
    outside: Literal["refuse", "hold", "zero"] = Field(
        default="refuse",
        description="in waves shorter or longer than the table's: refuse seas of which they hold more than 1 % of the "
        "energy, hold the motions of its last row, or take none",
    )
    sheave_forward: float = _FORWARD
    sheave_port: float = _PORT
    sheave_up: float = _UP
    heading: tuple[Number, ...] = _rows("rad", "heading of each row", ...)
    frequency: tuple[Number, ...] = _rows("rad/s", "angular frequency of each row", ...)
    heave: tuple[Number, ...] = _rows("m/m", "heave over wave amplitude", ...)
    heave_phase: tuple[Number, ...] = _rows("rad", "phase of heave", ...)
    surge: tuple[Number, ...] = _rows("m/m", "surge over wave amplitude; left out, 0")
    surge_phase: tuple[Number, ...] = _rows("rad", "phase of surge")
    sway: tuple[Number, ...] = _rows("m/m", "sway over wave amplitude; left out, 0")
    sway_phase: tuple[Number, ...] = _rows("rad", "phase of sway")
    roll: tuple[Number, ...] = _rows("rad/m", "roll over wave amplitude or slope; left out, 0")
    roll_phase: tuple[Number, ...] = _rows("rad", "phase of roll")
    pitch: tuple[Number, ...] = _rows("rad/m", "pitch over wave amplitude or slope; left out, 0")
    pitch_phase: tuple[Number, ...] = _rows("rad", "phase of pitch")
    yaw: tuple[Number, ...] = _rows("rad/m", "yaw over wave amplitude or slope; left out, 0")
    yaw_phase: tuple[Number, ...] = _rows("rad", "phase of yaw")
    file: FromFile | None = Field(default=None, description="file that the rows come from", json_schema_extra=_FILLS)


MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
Ship = Annotated[BoxShip | RaoShip, Field(discriminator="kind")]
