"""The values of a scenario as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from umbilical.cli.speech import shown_unit
from umbilical.scenario.base import Record
from umbilical.scenario.fields import word
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.text import literal

_ELSEWHERE = ("schema_version", "name", "description", "assumed")


class Entry(NamedTuple):
    """One value: dotted key, TOML text, unit, meaning, and whether it is marked *assumed*."""

    key: str
    value: str
    unit: str
    meaning: str
    assumed: bool


def inventory(scenario: Scenario) -> list[Entry]:
    """Every value of a scenario, but for sections that are left at their defaults and not marked.

    >>> from umbilical.admission import load
    >>> [entry for entry in inventory(load("paper")) if entry.key == "cable.line_density"][0].value
    '2.0'
    """
    return [entry for entry in _entries(scenario, "", scenario.assumed) if entry.key not in _ELSEWHERE]


def _entries(record: Record, path: str, marks: Mapping[str, str]) -> Iterator[Entry]:
    for name, field in type(record).model_fields.items():
        value, key = getattr(record, name), path + name
        if isinstance(value, Record):
            if value != field.get_default(call_default_factory=True) or _is_marked(key, marks):
                yield from _entries(value, key + ".", marks)
        elif _is_list_of_tables(value):
            for number, item in enumerate(value, start=1):
                yield from _entries(item, f"{key}.{number}.", marks)
        elif value not in (None, (), ""):
            unit, text = shown_unit(word(field, "unit")), literal(_data(value))
            yield Entry(key, text, unit, field.description or "", _is_marked(key, marks))


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, tuple) and bool(value) and isinstance(value[0], Record)


def _data(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value


def _is_marked(key: str, marks: Mapping[str, str]) -> bool:
    """Whether the key, or a table it is in, is marked."""
    steps = key.split(".")
    return any(".".join(steps[:count]) in marks for count in range(1, len(steps) + 1))
