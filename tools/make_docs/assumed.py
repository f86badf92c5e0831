"""docs/assumed.md: every number of the presets that no source gives."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping

from writing import code, page, table

from umbilical.library import load, preset_names, preset_text
from umbilical.scenario.document import look_up
from umbilical.scenario.text import literal
from umbilical.studies.load import load_study, study_names


def assumed() -> str:
    """Every number of the presets that no source gives."""
    return page(
        "Assumed numbers",
        "What the paper does not print had to be chosen. Each such value is marked in its preset, with the reason; the "
        "marks travel into every result and every printed scenario, and a mark disappears when its value is changed. "
        "A preset that extends another keeps the marks of the values it keeps; only what it adds is listed.",
        *filter(None, map(assumptions, sorted(preset_names(), key=lambda name: (name != "paper", name)))),
        "# Assumed ranges of the studies",
        "What a study varies, and how far, is ours.",
        *map(ranges, study_names()),
    )


def ranges(name: str) -> str:
    """What a study assumes."""
    rows = ((code(what), reason) for what, reason in load_study(name).assumed.items())
    return f"## `{name}`\n\n{table(('what', 'reason'), rows)}"


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
    data = preset.to_dict()
    return {key: (literal(look_up(data, key)), reason) for key, reason in preset.assumed.items()}
