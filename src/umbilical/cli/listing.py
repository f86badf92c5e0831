"""``umbilical presets`` and ``schema``: what comes with the package."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from umbilical.cli.speech import say, table


def presets(
    name: Annotated[str | None, Argument(help="Print this preset's text; all names if left out.")] = None,
    copy: Annotated[
        tuple[str, Path] | None, Option("--copy", metavar="NAME FILE", help="Copy a preset to a file of yours.")
    ] = None,
    force: Annotated[bool, Option("--force", help="Replace an existing file.")] = False,
) -> None:
    """List, print or copy the scenarios that come along.

    \b
    examples
      umbilical presets
      umbilical presets paper-dead
      umbilical presets --copy paper my.toml
    """
    from umbilical.admission import preset_text

    if copy:
        from umbilical import files

        source, target = copy
        written = files.write(target, preset_text(source).encode(), force=force)
        say(f"copied: {written}\n  next: change it; `umbilical show {target}`; `umbilical run {target}`")
    else:
        say(preset_text(name) if name else _descriptions())


def _descriptions() -> str:
    from umbilical.admission import preset_names, preset_text
    from umbilical.scenario.document import read

    texts = {name: read(preset_text(name), name) for name in preset_names()}
    return table([(name, _first_sentence(text["description"])) for name, text in texts.items()])


def _first_sentence(text: str) -> str:
    return text.partition(" Source:")[0]


def schema() -> None:
    """Print the JSON Schema of scenario files, for editors.

    \b
    example
      umbilical schema > scenario.schema.json
    """
    from umbilical.scenario.document import schema_text

    say(schema_text())
