"""From pydantic's complaints to ours: key, value with unit, bound, reason, fix."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from math import log10
from typing import Any

from pydantic import ValidationError
from pydantic.fields import FieldInfo

from umbilical.errors import Problem
from umbilical.scenario.base import Record
from umbilical.scenario.fields import bounds, choices, locate, records, with_unit, word

_MANY = 30
_NEAR = 0.75
"""Likeness of two names, 0 to 1, from which one may be a slip of the other: half of the letters is not enough."""
_WORD = re.compile(r"[^\W_]+")
_LONG = 200
"""Characters of a text that is shown as it is."""
_EXPECTED = {
    "float_type": "a number", "finite_number": "a finite number", "int_type": "a whole number",
    "int_from_float": "a whole number", "bool_type": "true or false", "string_type": "text in quotes",
    "tuple_type": "a list in brackets", "dict_type": "a table", "model_type": "a table",
    "model_attributes_type": "a table",
}  # fmt: skip


def problems_of(error: ValidationError, record: type[Record]) -> list[Problem]:
    """Every complaint of pydantic about a record, as a problem that can be mended.

    Args:
        error: what validation raised.
        record: the kind of record that was validated.
    """
    return [_problem(found, record) for found in error.errors(include_url=False) if not _consequence(found)]


def nearest(name: str, known: Iterable[str]) -> str:
    """``did you mean 'x'?`` with the name that this one is a slip of; where there is none, the names (not a page).

    >>> nearest("slope_gian", ["slope_gain", "midpoint"]), nearest("limit", ["voltage_limit", "inertia"])
    ("did you mean 'slope_gain'?", "did you mean 'voltage_limit'?")
    >>> nearest("current_limit", ["voltage_limit", "inertia"])
    'known: voltage_limit, inertia'
    """
    known = [str(candidate) for candidate in known]
    words = set(_WORD.findall(name))
    close = get_close_matches(name, known, n=1, cutoff=_NEAR)
    close = close or [candidate for candidate in known if words and words < set(_WORD.findall(candidate))]
    if len(close) == 1:
        return f"did you mean '{close[0]}'?"
    return f"known: {', '.join(known[:_MANY])}{', ...' * (len(known) > _MANY)}"


def shown(value: Any, field: FieldInfo | None = None) -> str:
    """A value as a reader of TOML knows it, with the field's unit if it is a number."""
    if isinstance(value, bool):
        return f"{str(value).lower()} (a truth value)"
    if isinstance(value, int | float):
        return with_unit(_digits(value), field)
    if isinstance(value, str):
        return f'"{abridged(value)}" (text)'
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, list | tuple):
        return f"a list of {len(value)}"
    return f"{abridged(str(value))} ({type(value).__name__})"


def abridged(text: str) -> str:
    """A text of somebody else's as it stands in a message: the beginning of a long one.

    >>> abridged("a" * 1000)[-22:]
    'a... (1000 characters)'
    """
    return text if len(text) <= _LONG else f"{text[: _LONG // 2]}... ({len(text)} characters)"


def _digits(value: float) -> str:
    """A number; of a whole one that fills lines (or that Python refuses to print) how many there are."""
    if isinstance(value, int) and value.bit_length() > 4 * _LONG:
        return f"a whole number of some {round(value.bit_length() * log10(2.0))} digits"
    return repr(value)


def _consequence(complaint: Mapping[str, Any]) -> bool:
    """Whether pydantic calls a list too short only because it left out entries that are wrong in themselves."""
    return complaint["type"] == "too_short" and len(complaint["input"]) >= complaint["ctx"]["min_length"]


def _problem(complaint: Mapping[str, Any], record: type[Record]) -> Problem:
    kind, found = complaint["type"], complaint["input"]
    place = locate(record, complaint["loc"])
    key, field = abridged(place.key), place.field
    if kind == "extra_forbidden":
        return _unknown(key, complaint, record)
    if kind == "missing":
        meaning = (field.description if field else "") or "a part every scenario has"
        fix = word(field, "fix") or f"add {key}"
        return Problem(key, "missing", bounds(field) or "required", f"required: {meaning}", fix)
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        return _unknown_kind(key, complaint["ctx"])
    named = f"one of {', '.join(map(str, choices(field.annotation)))}" if field and choices(field.annotation) else ""
    bound = ", ".join(filter(None, (_EXPECTED.get(kind), bounds(field), named))) or complaint["msg"]
    reason = word(field, "reason") or (field.description if field else "") or "it must be of the right kind"
    return Problem(
        key, shown(found, field), bound, reason, word(field, "fix") or f"give {bound}{_keys(place.annotation)}"
    )


def _keys(annotation: Any) -> str:
    """Which keys a table has that was expected: those it needs, or all."""
    kinds = records(annotation)
    if len(kinds) != 1:
        return ""
    needed = [name for name, field in kinds[0].model_fields.items() if field.is_required()]
    return f" with {', '.join(needed or kinds[0].model_fields)}"


def _unknown(key: str, complaint: Mapping[str, Any], record: type[Record]) -> Problem:
    *table, name = complaint["loc"]
    known = list(records(locate(record, table).annotation)[0].model_fields)
    fix = f"it is {_MOVED[key]}, for the string and the rope alike" if key in _MOVED else nearest(str(name), known)
    reason = "there is no such key here, and none is ever ignored"
    return Problem(key, shown(complaint["input"]), f"one of {', '.join(known)}", reason, fix)


def _unknown_kind(key: str, context: Mapping[str, Any]) -> Problem:
    name = key + "." + context["discriminator"].strip("'")
    if "tag" not in context:
        return Problem(name, "missing", "required", f"it says which kind {key} is", f"add {name}")
    found, known = str(context["tag"]), context["expected_tags"].replace("'", "").split(", ")
    return Problem(
        name, shown(found), f"one of {', '.join(known)}", "there is no such kind here", nearest(found, known)
    )


_MOVED = {
    "rope.axial_stiffness": "cable.axial_stiffness",
    "rope.line_weight": "cable.wet_line_density, in kg/m, which over g is the weight in water; negative floats",
    "rope.diameter": "cable.water.diameter",
    "rope.normal_drag": "cable.water.normal_drag",
    "rope.tangential_drag": "cable.water.tangential_drag",
    "rope.added_mass": "cable.water.added_mass",
    "rope.body_added_mass": "payload.water.added_mass, across_added_mass and vertical_added_mass",
    "rope.body_drag": "payload.water.quadratic_drag, across_drag and vertical_drag",
    "rope.body_displaced": "payload.water.displaced_mass",
    "rope.current": "environment.water.current, with depths, speeds and speeds_across",
    "rope.vessel_heave": "environment.vessel_heave",
}
"""Keys that the rope once had for what the string's keys say, and which."""
