"""docs/scenario.md: every key of a scenario file, from the records."""

from __future__ import annotations

import re
from copy import copy
from inspect import getdoc
from typing import Any

from pydantic.fields import FieldInfo
from writing import code, page, table

from umbilical.scenario.base import LARGEST, Record
from umbilical.scenario.fields import TAGS, bounds, choices, element_type, records, tag, word
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.signals import Signal
from umbilical.scenario.text import literal

Kinds = tuple[type[Record], ...]
TERMS: Kinds = records(element_type(Signal))


def scenario() -> str:
    """Every key of a scenario file."""
    return page(
        "Every key of a scenario",
        "A scenario is a TOML file. `umbilical presets --copy paper my.toml` writes a complete one with every key "
        'commented; a file that starts with `extends = "paper"` needs only what differs. Unknown keys are refused. '
        "Lists are numbered from 1 in `--set` and in messages (`motors.2.inertia`). A dash means there is no unit. "
        "Editors can use the [JSON Schema](scenario.schema.json). Checks between keys, such as the plant's step "
        "against the wave speed, are in `src/umbilical/plant/checks/` and in the parts of `src/umbilical/control/`.",
        *(section(keys, kinds) for kinds, keys in sections().items()),
    )


def sections() -> dict[Kinds, list[str]]:
    """Every kind of table with the keys it stands at, in the order of the file; signals come last."""
    found: dict[Kinds, list[str]] = {}
    collect((Scenario,), "", found)
    found[TERMS] = found.pop(TERMS)
    return found


def collect(kinds: Kinds, key: str, found: dict[Kinds, list[str]]) -> None:
    """Walk down from a table to all the tables in it."""
    if kinds in found:
        found[kinds].append(key)
        return
    found[kinds] = [key]
    for kind in kinds:
        for name, field in kind.model_fields.items():
            if inner := inside(field):
                collect(inner, f"{key}.{name}".strip("."), found)


def inside(field: FieldInfo) -> Kinds:
    """Kinds of table a field holds, itself or in a list."""
    return records(field.annotation) or records(element_type(field.annotation))


def section(keys: list[str], kinds: Kinds) -> str:
    """A table of the scenario: what it is, and its keys, kind by kind."""
    heads = {(Scenario,): "## The run", TERMS: "## Signals"}
    parts = [heads.get(kinds, f"## `{keys[0]}`")]
    if kinds == TERMS:
        parts.append("A signal is a list of terms that are added; an empty list is zero. Its unit is that of its key.")
    elif len(keys) > 1:
        parts.append(f"The same keys stand in {', '.join(map(code, keys[1:]))}.")
    for kind in kinds:
        if len(kinds) > 1:
            parts.append(f"### `{tag(kind)[0]} = {literal(tag(kind)[1])}`")
        fields = {name: f for name, f in kind.model_fields.items() if len(kinds) == 1 or name not in TAGS}
        parts.append(re.sub(r"\s*>>>.*", "", getdoc(kind) or "", flags=re.DOTALL).replace("``", "`"))
        if fields:
            parts.append(table(("key", "unit", "default", "allowed", "meaning"), map(row, fields, fields.values())))
    return "\n\n".join(parts)


def row(name: str, field: FieldInfo) -> tuple[str, ...]:
    """A key: unit, default, what is allowed, meaning."""
    unit = word(field, "unit")
    return code(name), unit if unit not in ("", "1") else "-", default(field), allowed(field), meaning(field)


def default(field: FieldInfo) -> str:
    """The value of a key that is left out."""
    if field.is_required():
        return "required"
    value = field.get_default(call_default_factory=True)
    if isinstance(value, Record):
        return ""
    return "none" if value is None or value in ((), {}) else code(literal(value))


def allowed(field: FieldInfo) -> str:
    """Bounds of a key, without those that only catch slips of the unit."""
    if (inner := inside(field)) == TERMS:
        return "[signal](#signals)"
    if inner:
        return "tables" if element_type(field.annotation) else "table"
    plain = copy(field)
    plain.metadata = [rule for rule in field.metadata if LARGEST not in map(abs, limits(rule))]
    named = {bool: "true, false", str: "text"}
    return bounds(plain) or named.get(field.annotation or object) or ", ".join(map(literal, choices(field.annotation)))


def limits(rule: Any) -> list[float]:
    """Numbers in a rule of a field."""
    return [getattr(rule, side) for side in ("ge", "le") if hasattr(rule, side)]


def meaning(field: FieldInfo) -> str:
    """What a key says, with the equation of the paper, and where its table is described."""
    inner = inside(field)
    title = sections()[inner][0] if inner and inner != TERMS else ""
    link = f"see [{title}](#{title.replace('.', '')})" if title else ""
    source = f"({word(field, 'source')})".replace("((", "(").replace("))", ")") if word(field, "source") else ""
    return ", ".join(part for part in (f"{field.description or ''} {source}".strip(), link) if part)


def keys_by_meaning() -> dict[str, list[str]]:
    """Keys of the scenario by the meaning that stands at them, each record at the first place it occurs."""
    found: dict[str, list[str]] = {}
    for kinds, (first, *_) in sections().items():
        prefix = "(signal)." if kinds == TERMS else f"{first}." if first else ""
        for name, field in ((n, f) for kind in kinds for n, f in kind.model_fields.items()):
            keys = found.setdefault(field.description or "", [])
            if prefix + name not in keys:
                keys.append(prefix + name)
    return found
