"""Reading the records themselves: which field a place in a scenario belongs to, and what its words say."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, Literal, NamedTuple, get_args, get_origin

from pydantic.fields import FieldInfo

from umbilical.scenario.base import Record

TAGS = ("law", "kind", "shape", "method")
"""Keys whose text says which kind of table it is in: ``law = "quintic"``."""


def records(annotation: Any) -> tuple[type[Record], ...]:
    """Kinds of record an annotation admits: one, several for a tagged union, none for anything else."""
    if isinstance(annotation, type) and issubclass(annotation, Record):
        return (annotation,)
    if get_origin(annotation) is Annotated:
        return records(get_args(annotation)[0])
    if get_origin(annotation) in (tuple, dict):
        return ()
    return tuple(record for part in get_args(annotation) for record in records(part))


def element_type(annotation: Any) -> Any:
    """What a list holds: X of ``tuple[X, ...]``, through ``| None``; None for anything else."""
    if get_origin(annotation) is tuple:
        return get_args(annotation)[0]
    return next((found for part in get_args(annotation) if (found := element_type(part)) is not None), None)


def choices(annotation: Any) -> tuple[Any, ...]:
    """Values of a literal, or tags of a tagged union; empty for anything else."""
    if get_origin(annotation) is Literal:
        return get_args(annotation)
    kinds = records(annotation)
    return tuple(tag(kind)[1] for kind in kinds) if len(kinds) > 1 else ()


def tag(record: type[Record]) -> tuple[str, str]:
    """Key and text that tell a kind of record from its siblings, e.g. ``("law", "quintic")``."""
    name = next(name for name in TAGS if name in record.model_fields)
    return name, get_args(record.model_fields[name].annotation)[0]


class Place(NamedTuple):
    """A place in a scenario: its dotted key (lists numbered from 1), its field, and what it may hold."""

    key: str
    field: FieldInfo | None
    annotation: Any


def locate(record: type[Record], place: Sequence[int | str]) -> Place:
    """The place that pydantic names by ``place``, which also holds the tags of tagged unions."""
    annotation: Any = record
    field: FieldInfo | None = None
    steps: list[str] = []
    for step in place:
        kinds = records(annotation)
        if isinstance(step, int):
            steps.append(str(step + 1))
            annotation = element_type(annotation)
            field = _entry(annotation, field)
        elif len(kinds) > 1:
            annotation = next(kind for kind in kinds if tag(kind)[1] == step)
        else:
            steps.append(step)
            field = kinds[0].model_fields.get(step) if kinds else field
            annotation = field.annotation if field else None
    return Place(".".join(steps), field, annotation)


def place_of(step: str, size: int) -> int | None:
    """Index of a list's place that a key counts from 1; None if there is no such place.

    >>> place_of("2", 2), place_of("3", 2), place_of("9" * 5000, 2)
    (1, None, None)
    """
    return int(step) - 1 if step.isdecimal() and len(step) < 10 and 1 <= int(step) <= size else None


def _entry(annotation: Any, of: FieldInfo | None) -> FieldInfo:
    """Field of one entry of a list: its own bounds, and the list's meaning."""
    field = FieldInfo.from_annotation(annotation)
    field.description = of.description if of else None
    return field


def word(field: FieldInfo | None, name: str) -> str:
    """A word attached to a field: its unit, symbol, source, reason or fix; empty where there is none."""
    extra = field.json_schema_extra if field else None
    return str(extra.get(name, "")) if isinstance(extra, dict) else ""


def with_unit(text: str, field: FieldInfo | None) -> str:
    """A number's text with the field's unit behind it, if it has one."""
    unit = word(field, "unit")
    return f"{text} {unit}" if unit not in ("", "1") else text


def bounds(field: FieldInfo | None) -> str:
    """What a field allows, in words, e.g. ``above 0 and at most 10000 kg/m``."""
    named = {"gt": "above", "ge": "at least", "lt": "below", "le": "at most"}
    counted = "characters" if field and field.annotation is str else "entries"
    lengths = {"min_length": f"{{}} or more {counted}", "max_length": f"at most {{}} {counted}"}
    limits, counts = [], []
    for rule in field.metadata if field else []:
        limits += [f"{text} {getattr(rule, name):g}" for name, text in named.items() if hasattr(rule, name)]
        counts += [text.format(getattr(rule, name)) for name, text in lengths.items() if hasattr(rule, name)]
    return " and ".join([with_unit(" and ".join(limits), field)] * bool(limits) + counts)
