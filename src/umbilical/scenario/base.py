"""What every record of a scenario is made of: frozen, strict, closed models and fields that carry words."""

from __future__ import annotations

import hashlib
import json
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from umbilical.quantities import PARAMETERS

LARGEST = 1e12
"""No quantity of this model is larger, in any of its units: beyond it a number is a slip of the unit."""

Number = Annotated[float, Field(ge=-LARGEST, le=LARGEST)]
"""An entry of a list of numbers."""


class Record(BaseModel):
    """A frozen piece of a scenario: no unknown keys, no coercion from strings, no NaN, no infinity."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        strict=True,
        allow_inf_nan=False,
        ser_json_inf_nan="constants",
        defer_build=True,  # until a record is first made: one that stands in another has no need of its own validator
    )


def quantity(name: str, default: Any = ..., *, reason: str = "", fix: str = "", **bounds: float) -> Any:
    """A field whose unit, symbol and meaning come from the table of words.

    Args:
        name: key of :data:`umbilical.quantities.PARAMETERS`.
        default: as for a pydantic field; omitted, the key is required.
        reason: why the bound is there, shown when it is broken.
        fix: what to do when it is broken.
        bounds: ``gt``, ``ge``, ``lt``, ``le``; without an upper or lower one, :data:`LARGEST` stands in.
    """
    return Field(default, **_limits(bounds), **described(name, reason, fix))


def described(name: str, reason: str = "", fix: str = "") -> Any:
    """What the table of words says about a name, as arguments of a pydantic field; as for :func:`quantity`."""
    word = PARAMETERS[name]
    extra = {"unit": word.unit, "symbol": word.symbol, "source": word.source, "reason": reason, "fix": fix}
    return {"description": word.meaning, "json_schema_extra": extra}


def measured(
    unit: str, meaning: str, default: Any = ..., *, reason: str = "", fix: str = "", source: str = "", **bounds: float
) -> Any:
    """A field of a number with its unit, meaning and bounds (``gt``, ``ge``, ``lt``, ``le``)."""
    extra: Any = {"unit": unit, "symbol": "", "source": source, "reason": reason, "fix": fix}
    return Field(default, description=meaning, json_schema_extra=extra, **_limits(bounds))


def _limits(bounds: dict[str, float]) -> Any:
    """Bounds with :data:`LARGEST` on a side that has none."""
    upper = {} if {"lt", "le"} & bounds.keys() else {"le": LARGEST}
    lower = {} if {"gt", "ge"} & bounds.keys() else {"ge": -LARGEST}
    return upper | lower | bounds


def fingerprint(data: dict[str, Any]) -> str:
    """SHA-256 of plain data as canonical JSON: sorted keys, shortest numbers, no spaces."""
    text = json.dumps(data, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()
