"""The values of a scenario as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from pydantic.fields import FieldInfo

from umbilical.scenario.base import Record
from umbilical.scenario.fields import place_of, word
from umbilical.scenario.text import literal

_ELSEWHERE = ("schema_version", "name", "description", "assumed")


class Entry(NamedTuple):
    """One value of a scenario.

    Attributes:
        key, value: dotted key, and the value as TOML writes it.
        unit, symbol, meaning, source: its words; the unit of a pure number is empty.
        reason: why it is what it is, where no source gives it (marked *assumed*, itself or a table it is in).
    """

    key: str
    value: str
    unit: str
    meaning: str
    symbol: str
    source: str
    reason: str

    @property
    def assumed(self) -> bool:
        """Whether no source gives it."""
        return bool(self.reason)


def inventory(whole: Record, assumed: Mapping[str, str]) -> list[Entry]:
    """Every value of a scenario or an operation, but for sections that are left at their defaults and not marked.

    >>> from umbilical.library import load
    >>> paper = load("paper")
    >>> [entry for entry in inventory(paper, paper.assumed) if entry.key == "cable.line_density"][0].value
    '2.0'
    """
    return [entry for entry in _entries(whole, "", assumed) if entry.key not in _ELSEWHERE]


def words_at(scenario: Record, key: str) -> tuple[str, str]:
    """Unit and meaning of the value at a dotted key of this scenario, kinds of tables included; empty where the
    scenario has no such place.

    >>> from umbilical.library import load
    >>> words_at(load("paper"), "environment.payload_force.2.phase")[0]
    'rad'
    """
    here: Any = scenario
    field: FieldInfo | None = None
    units = [""]
    for step in key.split("."):
        if isinstance(here, Record):
            field = type(here).model_fields.get(step)
            units = [unit for unit in word(field, "unit").split(", ") if unit] or units  # a signal's: what it is of
            here = getattr(here, step, None)
        elif isinstance(here, tuple) and (place := place_of(step, len(here))) is not None:
            units = units[place:] or units[-1:]  # one unit for each place of a list, the last for all others
            here = here[place]
        else:
            return "", ""
    if field is None:
        return "", ""
    return "" if isinstance(here, str) else units[0], field.description or ""


def _entries(record: Record, path: str, marks: Mapping[str, str]) -> Iterator[Entry]:
    for name, field in type(record).model_fields.items():
        value, key = getattr(record, name), path + name
        if isinstance(value, Record):
            if value != field.get_default(call_default_factory=True) or _mark(key, marks):
                yield from _entries(value, key + ".", marks)
        elif isinstance(value, tuple) and value and isinstance(value[0], Record):
            for number, item in enumerate(value, start=1):
                yield from _entries(item, f"{key}.{number}.", marks)
        elif value not in (None, (), ""):
            unit, symbol, source = (word(field, name) for name in ("unit", "symbol", "source"))
            text, meaning = literal(value), field.description or ""
            yield Entry(key, text, "" if unit == "1" else unit, meaning, symbol, source, _mark(key, marks))


def _mark(key: str, marks: Mapping[str, str]) -> str:
    """The reason a key, or a table it is in, is marked with; empty where it is not."""
    steps = key.split(".")
    return next((marks[k] for n in range(len(steps), 0, -1) if (k := ".".join(steps[:n])) in marks), "")
