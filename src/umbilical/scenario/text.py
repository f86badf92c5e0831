"""A scenario as a complete, commented TOML text: every key with unit, meaning and whether it is assumed."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from inspect import getdoc
from typing import Any, get_args

from pydantic.fields import FieldInfo

from umbilical.scenario.base import Record
from umbilical.scenario.fields import TAGS, choices, element_type, records, word
from umbilical.scenario.signals import Term

_TERMS = get_args(get_args(Term)[0])
_COMMENT_COLUMN = 32


def to_toml(scenario: Record) -> str:
    """Complete TOML text of a scenario; reading it back gives an equal scenario.

    >>> from umbilical.library import load
    >>> print(load("paper").to_toml().splitlines()[4])
    name = "paper"                  # short name, also of the result file
    """
    assumed: Mapping[str, str] = getattr(scenario, "assumed", {})
    lines = [
        "# A scenario of Umbilical. SI units and radians throughout; x runs along the cable from the vessel (0) down",
        "# to the ROV (l), y is the transverse displacement. What stands behind '#' is a comment.",
        "",
        *_table(scenario, "", assumed),
    ]
    if assumed:
        lines += ["", "# Values that no source gives: assumed, each with the reason.", "[assumed]"]
        lines += [f"{literal(key)} = {literal(reason)}" for key, reason in assumed.items()]
    return "\n".join(lines) + "\n"


def literal(value: Any) -> str:
    """A value in TOML, on one line."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {literal(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(literal, value)) + "]"
    return repr(value)


def _table(record: Record, path: str, marks: Mapping[str, str], siblings: tuple[Any, ...] = ()) -> Iterator[str]:
    """Lines of a table: its own keys first, as TOML wants it, then the tables inside it."""
    fields = {name: field for name, field in type(record).model_fields.items() if name != "assumed"}
    inner = [name for name in fields if _has_tables(getattr(record, name))]
    for name in fields:
        if name not in inner:
            note = _comment(name, fields[name], marks.get(path + name), siblings)
            yield from _leaf(name, getattr(record, name), fields[name], note)
    for name in inner:
        value, key, annotation = getattr(record, name), path + name, fields[name].annotation
        listed = isinstance(value, tuple)
        kinds = choices(element_type(annotation) if listed else annotation)
        for number, item in enumerate(value if listed else (value,), start=1):
            head = f"[[{_header(key)}]]  # {number}" if listed else f"[{_header(key)}]"
            yield from ["", *_about(item, marks.get(key)), head]
            yield from _table(item, f"{key}.{number}." if listed else f"{key}.", marks, kinds)


def _header(key: str) -> str:
    """A key as TOML names tables: inside a list it means the list's last table, without its number."""
    return ".".join(step for step in key.split(".") if not step.isdecimal())


def _has_tables(value: Any) -> bool:
    """Whether a value is written as tables of its own; the terms of a signal are one line each instead."""
    first = value[0] if isinstance(value, tuple) and value else value
    return isinstance(first, Record) and not isinstance(first, _TERMS)


def _leaf(name: str, value: Any, field: FieldInfo, comment: str) -> list[str]:
    kinds, terms = records(element_type(field.annotation)), []
    if value is None:
        text = f"# [{name}] left out" if records(field.annotation) else f"# {name} left out"
    elif value == () and kinds and kinds != _TERMS:  # an empty list here would forbid adding [[name]] below
        text = f"# [[{name}]] none"
    elif isinstance(value, tuple) and value and isinstance(value[0], Record):
        text = f"{name} = ["
        terms = [*(f"  {literal(term.model_dump(mode='json', exclude_none=True))}," for term in value), "]"]
    else:
        text = f"{name} = {literal(value)}"
    return [f"{text:<{_COMMENT_COLUMN - 1}} # {comment}" if comment else text, *terms]


def _comment(name: str, field: FieldInfo, mark: str | None, siblings: tuple[Any, ...]) -> str:
    known = siblings if name in TAGS else choices(field.annotation)
    unit, kinds = word(field, "unit"), f"one of: {', '.join(map(str, known))}" if len(known) > 1 else ""
    parts = ("" if unit == "1" else unit, field.description, kinds, word(field, "source"), _assumed(mark))
    return " | ".join(part for part in parts if part)


def _about(record: Record, mark: str | None) -> list[str]:
    """Comment above a table: the first line of what is said about its kind."""
    lines = [f"# {(getdoc(type(record)) or '').splitlines()[0]}"]
    return [*lines, f"# {_assumed(mark)}"] if mark else lines


def _assumed(mark: str | None) -> str:
    """The mark as part of a comment, which must stay on its line."""
    return "assumed: " + "".join(c if c.isprintable() else " " for c in mark) if mark else ""
