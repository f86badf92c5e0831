"""``umbilical presets`` and ``schema``: what comes with the package."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from umbilical.cli.options import Force
from umbilical.cli.speech import say
from umbilical.faces.text import table


def presets(
    name: Annotated[str | None, Argument(help="Print this preset's text; all names if left out.")] = None,
    copy: Annotated[
        tuple[str, Path] | None, Option("--copy", metavar="NAME FILE", help="Copy a preset to a file of yours.")
    ] = None,
    force: Force = False,
) -> None:
    """List, print or copy the scenarios and studies that come along.

    \b
    examples
      umbilical presets
      umbilical presets paper-dead
      umbilical presets --copy paper my.toml
      umbilical presets --copy paper-robustness my-study.toml
    """
    if copy:
        from umbilical import files
        from umbilical.studies.load import study_names

        source, target = copy
        command = "sweep" if source in study_names() else "run"
        written = files.write(target, _text(source).encode(), force=force)
        say(f"copied: {written}\n  next: change it; `umbilical show {target}`; `umbilical {command} {target}`")
    else:
        say(_text(name) if name else _descriptions())


def _text(name: str) -> str:
    """TOML text of a scenario or study that comes along; FileError if there is none."""
    from umbilical.library import preset_text
    from umbilical.studies.load import study_names, study_text

    return study_text(name) if name in study_names() else preset_text(name)


def _descriptions() -> str:
    from umbilical.library import preset_names
    from umbilical.scenario.document import read
    from umbilical.studies.load import study_names

    def described(names: tuple[str, ...]) -> str:
        return table([(name, _first_sentence(read(_text(name), name)["description"])) for name in names])

    return f"scenarios\n{described(preset_names())}\n\nstudies\n{described(study_names())}"


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
