#!/usr/bin/env python3
"""Write the generated pages of docs/ from the source: `.venv/bin/python tools/make_docs.py`.

With `--check` nothing is written; the pages that are not current are named, and the exit code is 1 if there are any.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import copy
from inspect import getdoc
from pathlib import Path
from typing import Any

from pydantic.fields import FieldInfo

from umbilical.admission import load, preset_names, preset_text
from umbilical.quantities import CHANNELS, METRICS, PARAMETERS, Quantity
from umbilical.run import SECOND_DIMENSION
from umbilical.scenario.base import LARGEST, Record
from umbilical.scenario.document import look_up, schema_text, to_dict
from umbilical.scenario.fields import TAGS, bounds, choices, element, records, tag, word
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.signals import Signal
from umbilical.scenario.text import literal

DOCS = Path(__file__).resolve().parents[1] / "docs"
Kinds = tuple[type[Record], ...]
TERMS: Kinds = records(element(Signal))


def page(title: str, *parts: str) -> str:
    """A generated page: its title, how to change it, and its parts."""
    note = "<!-- Written by tools/make_docs.py from the source; edit there, not here. -->"
    return "\n\n".join([f"# {title}", note, *parts]) + "\n"


def table(head: Sequence[str], rows: Iterator[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *([cell.replace("|", "\\|") for cell in row] for row in rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def code(text: str) -> str:
    """Text in the face of code, nothing where there is none."""
    return f"`{text}`" if text else ""


# --- notation -------------------------------------------------------------------------------------------------------


def notation() -> str:
    """The table of words: symbols of the paper, names of this software, units."""
    places = keys_by_meaning()
    rows = ((code(", ".join(places.get(q.meaning, [name])).replace(", ", "`, `")), q) for name, q in PARAMETERS.items())
    head = ("symbol", "name", "unit", "meaning", "in the paper", "take care")
    channels = ((f"`{name}`", q) for name, q in CHANNELS.items())
    metrics = ((f"`{name}`", q) for name, q in METRICS.items())
    return page(
        "Notation",
        "SI units and radians throughout. `x` runs along the cable from the vessel (0) down to the ROV (`l`), `y` is "
        "the transverse displacement, paying out is positive. A number in parentheses is an equation of the paper; "
        "[theory.md](theory.md) says which file holds it. *Take care* names the other thing the paper writes with "
        "the same symbol. The source of this page is `src/umbilical/quantities.py`, which also feeds the units in "
        "result files and the labels of the axes.",
        "## Parameters: what a scenario says",
        "Names are keys of a scenario; [scenario.md](scenario.md) gives their bounds and defaults.",
        table(head, (words(name, q) for name, q in rows)),
        "## Channels: what a run holds",
        f"Every channel is over `time`; {dimensions()}",
        table(head, (words(name, q) for name, q in channels)),
        "## Metrics: single numbers of a run",
        "Peaks and root mean squares are taken over every control sample, not over the stored ones.",
        table(("name", "unit", "meaning"), ((name, q.unit, q.meaning) for name, q in metrics)),
    )


def words(name: str, q: Quantity) -> tuple[str, ...]:
    """One row of a table of words."""
    return (f"${q.symbol}$" if q.symbol else "", name, q.unit, q.meaning, q.source, q.clash)


def dimensions() -> str:
    """Which channels have a second dimension."""
    of = {second: [n for n, d in SECOND_DIMENSION.items() if d == second] for second in SECOND_DIMENSION.values()}
    return "; ".join(f"over `{second}` too: {', '.join(map(code, names))}" for second, names in of.items()) + "."


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


# --- scenario -------------------------------------------------------------------------------------------------------


def scenario() -> str:
    """Every key of a scenario file."""
    return page(
        "Every key of a scenario",
        "A scenario is a TOML file. `umbilical presets --copy paper my.toml` writes a complete one with every key "
        'commented; a file that starts with `extends = "paper"` needs only what differs. Unknown keys are refused. '
        "Lists are numbered from 1 in `--set` and in messages (`motors.2.inertia`). A dash means there is no unit. "
        "Editors can use the [JSON Schema](scenario.schema.json). Checks between keys, such as the plant's step "
        "against the wave speed, are in `src/umbilical/admission/`.",
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
    return records(field.annotation) or records(element(field.annotation))


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
        return "tables" if element(field.annotation) else "table"
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


# --- assumed --------------------------------------------------------------------------------------------------------


def assumed() -> str:
    """Every number of the presets that no source gives."""
    return page(
        "Assumed numbers",
        "What the paper does not print had to be chosen. Each such value is marked in its preset, with the reason; the "
        "marks travel into every result and every printed scenario, and a mark disappears when its value is changed. "
        "A preset that extends another keeps the marks of the values it keeps; only what it adds is listed.",
        *filter(None, map(assumptions, sorted(preset_names(), key=lambda name: (name != "paper", name)))),
    )


def assumptions(name: str) -> str:
    """Assumed values that a preset adds to those of the one it extends."""
    base = tomllib.loads(preset_text(name)).get("extends")
    marks, known = marked(name), marked(base) if base else {}
    new = {key: mark for key, mark in marks.items() if known.get(key) != mark}
    rows = [(code(key), code(value), reason) for key, (value, reason) in new.items()]
    if not rows:
        return ""
    title = f"## `{name}`" + (f", which extends `{base}`" if base else "")
    return f"{title}\n\n{table(('key', 'value', 'reason'), iter(rows))}"


def marked(name: str) -> Mapping[str, tuple[str, str]]:
    """Value, as it stands in the file, and reason of every mark of a preset."""
    preset = load(name)
    data = to_dict(preset)
    return {key: (literal(look_up(data, key)), reason) for key, reason in preset.assumed.items()}


PAGES: dict[str, Callable[[], str]] = {
    "notation.md": notation,
    "scenario.md": scenario,
    "assumed.md": assumed,
    "scenario.schema.json": schema_text,
}


def stale() -> list[str]:
    """Names of the pages that are not what the source says."""
    return [name for name, make in PAGES.items() if not (DOCS / name).exists() or (DOCS / name).read_text() != make()]


def main() -> int:
    """Write, or with `--check` only look."""
    names = stale()
    for name in names:
        print(f"docs/{name}: {'not current' if '--check' in sys.argv else 'written'}")
        if "--check" not in sys.argv:
            (DOCS / name).write_text(PAGES[name](), encoding="utf-8")
    return 1 if names and "--check" in sys.argv else 0


if __name__ == "__main__":
    raise SystemExit(main())
