"""A scenario as a complete, commented TOML text: every key with unit, meaning and whether it is assumed."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from inspect import getdoc
from typing import Any, get_args

from pydantic.fields import FieldInfo

from umbilical.scenario.base import Record
from umbilical.scenario.fields import TAGS, choices, element_type, records, word
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.signals import Term

_TERMS = get_args(get_args(Term)[0])
_COMMENT_COLUMN = 32


def to_toml(scenario: Scenario) -> str:
    """Complete TOML text of a scenario; reading it back gives an equal scenario.

    >>> from umbilical.library import load
    >>> print(load("paper").to_toml().splitlines()[4])
    name = "paper"                  # short name, also of the result file
    """
    lines = [
        "# A scenario of Umbilical. SI units and radians throughout; x runs along the cable from the vessel (0) down",
        "# to the ROV (l), y is the transverse displacement. What stands behind '#' is a comment.",
        "",
        *_table(scenario, "", scenario.assumed),
        *_marks(scenario.assumed),
    ]
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
        value, key = getattr(record, name), path + name
        if isinstance(value, Record):
            yield from ["", *_about(value, marks.get(key)), f"[{_header(key)}]"]
            yield from _table(value, key + ".", marks, choices(fields[name].annotation))
        else:
            for number, item in enumerate(value, start=1):
                yield from ["", *_about(item, marks.get(key)), f"[[{_header(key)}]]  # {number}"]
                yield from _table(item, f"{key}.{number}.", marks, choices(element_type(fields[name].annotation)))


def _header(key: str) -> str:
    """A key as TOML names tables: inside a list it means the list's last table, without its number."""
    return ".".join(step for step in key.split(".") if not step.isdecimal())


def _has_tables(value: Any) -> bool:
    """Whether a value is written as tables of its own; the terms of a signal are one line each instead."""
    return isinstance(value, Record) or (
        isinstance(value, tuple) and bool(value) and isinstance(value[0], Record) and not isinstance(value[0], _TERMS)
    )


def _leaf(name: str, value: Any, field: FieldInfo, comment: str) -> list[str]:
    if value is None:
        kinds = records(field.annotation)
        return [_with_comment(f"# [{name}] left out" if kinds else f"# {name} left out", comment)]
    kinds = records(element_type(field.annotation))
    if value == () and kinds and kinds != _TERMS:  # an empty list here would forbid adding [[name]] below
        return [_with_comment(f"# [[{name}]] none", comment)]
    if isinstance(value, tuple) and value and isinstance(value[0], Record):
        terms = [f"  {literal(term.model_dump(mode='json', exclude_none=True))}," for term in value]
        return [_with_comment(f"{name} = [", comment), *terms, "]"]
    return [_with_comment(f"{name} = {literal(list(value) if isinstance(value, tuple) else value)}", comment)]


def _with_comment(text: str, comment: str) -> str:
    return f"{text:<{_COMMENT_COLUMN - 1}} # {comment}" if comment else text


def _comment(name: str, field: FieldInfo, mark: str | None, siblings: tuple[Any, ...]) -> str:
    known = siblings if name in TAGS else choices(field.annotation)
    parts = [
        word(field, "unit") if word(field, "unit") != "1" else "",
        field.description or "",
        f"one of: {', '.join(map(str, known))}" if len(known) > 1 else "",
        word(field, "source"),
        _assumed(mark),
    ]
    return " | ".join(part for part in parts if part)


def _about(record: Record, mark: str | None) -> list[str]:
    """Comment above a table: the first line of what is said about its kind."""
    lines = [f"# {(getdoc(type(record)) or '').splitlines()[0]}"]
    return [*lines, f"# {_assumed(mark)}"] if mark else lines


def _assumed(mark: str | None) -> str:
    """The mark as part of a comment, which must stay on its line."""
    return "assumed: " + "".join(c if c.isprintable() else " " for c in mark) if mark else ""


def _marks(assumed: Mapping[str, str]) -> list[str]:
    if not assumed:
        return []
    marks = [f"{literal(key)} = {literal(reason)}" for key, reason in assumed.items()]
    return ["", "# Values that no source gives: assumed, each with the reason.", "[assumed]", *marks]
