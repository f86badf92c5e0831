"""From pydantic's complaints to ours: key, value with unit, bound, reason, cure."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from typing import Any

from pydantic import ValidationError
from pydantic.fields import FieldInfo

from umbilical.errors import Problem
from umbilical.scenario.base import Record
from umbilical.scenario.fields import bounds, choices, locate, records, with_unit, word

_MANY = 30
_EXPECTED = {
    "float_type": "a number",
    "finite_number": "a finite number",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "bool_type": "true or false",
    "string_type": "text in quotes",
    "tuple_type": "a list in brackets",
    "dict_type": "a table",
    "model_type": "a table",
    "model_attributes_type": "a table",
}


def problems_of(error: ValidationError, record: type[Record]) -> list[Problem]:
    """Every complaint of pydantic about a record, as a problem that can be mended.

    Args:
        error: what validation raised.
        record: the kind of record that was validated.
    """
    complaints = error.errors(include_url=False)
    return [_problem(complaint, record) for complaint in complaints if not _consequence(complaint)]


def nearest(name: str, known: Iterable[str]) -> str:
    """``did you mean 'x'?`` with the known name most like this one; when none is, the names (not a page of them)."""
    known = [str(candidate) for candidate in known]
    close = get_close_matches(name, known, n=1, cutoff=0.5)
    if close:
        return f"did you mean '{close[0]}'?"
    return f"known: {', '.join(known[:_MANY])}{', ...' * (len(known) > _MANY)}"


def shown(value: Any, field: FieldInfo | None = None) -> str:
    """A value as a reader of TOML knows it, with the field's unit if it is a number."""
    if isinstance(value, bool):
        return f"{str(value).lower()} (a truth value)"
    if isinstance(value, int | float):
        return with_unit(repr(value), field)
    if isinstance(value, str):
        return f'"{value}" (text)'
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, list | tuple):
        return f"a list of {len(value)}"
    return f"{value} ({type(value).__name__})"


def _consequence(complaint: Mapping[str, Any]) -> bool:
    """Whether pydantic calls a list too short only because it left out entries that are wrong in themselves."""
    return complaint["type"] == "too_short" and len(complaint["input"]) >= complaint["ctx"]["min_length"]


def _problem(complaint: Mapping[str, Any], record: type[Record]) -> Problem:
    place = locate(record, complaint["loc"])
    build = _SPECIAL.get(complaint["type"], _plain)
    return build(place.key, place.field, complaint, record)


def _plain(key: str, field: FieldInfo | None, complaint: Mapping[str, Any], record: type[Record]) -> Problem:
    expected, allowed = _EXPECTED.get(complaint["type"], ""), bounds(field)
    named = f"one of {', '.join(map(str, choices(field.annotation)))}" if field and choices(field.annotation) else ""
    bound = ", ".join(part for part in (expected, allowed, named) if part) or complaint["msg"]
    return Problem(
        key,
        shown(complaint["input"], field),
        bound,
        word(field, "reason") or (field.description if field else "") or "it must be of the right kind",
        word(field, "cure") or f"give {bound}",
    )


def _unknown(key: str, field: FieldInfo | None, complaint: Mapping[str, Any], record: type[Record]) -> Problem:
    *table, name = complaint["loc"]
    known = list(records(locate(record, table).annotation)[0].model_fields)
    return Problem(
        key,
        shown(complaint["input"]),
        f"one of {', '.join(known)}",
        "there is no such key here, and none is ever ignored",
        nearest(str(name), known),
    )


def _missing(key: str, field: FieldInfo | None, complaint: Mapping[str, Any], record: type[Record]) -> Problem:
    meaning = (field.description if field else "") or "a part every scenario has"
    bound = bounds(field) or "required"
    return Problem(key, "missing", bound, f"required: {meaning}", word(field, "cure") or f"add {key}")


def _unknown_kind(key: str, field: FieldInfo | None, complaint: Mapping[str, Any], record: type[Record]) -> Problem:
    context = complaint["ctx"]
    name, known = context["discriminator"].strip("'"), context["expected_tags"].replace("'", "").split(", ")
    found = str(context["tag"])
    return Problem(
        f"{key}.{name}", shown(found), f"one of {', '.join(known)}", "there is no such kind here", nearest(found, known)
    )


def _missing_kind(key: str, field: FieldInfo | None, complaint: Mapping[str, Any], record: type[Record]) -> Problem:
    name = complaint["ctx"]["discriminator"].strip("'")
    return Problem(f"{key}.{name}", "missing", "required", f"it says which kind {key} is", f"add {key}.{name}")


_SPECIAL: dict[str, Callable[[str, FieldInfo | None, Mapping[str, Any], type[Record]], Problem]] = {
    "extra_forbidden": _unknown,
    "missing": _missing,
    "union_tag_invalid": _unknown_kind,
    "union_tag_not_found": _missing_kind,
}
