"""``umbilical presets``, ``examples`` and ``schema``: what comes with the package."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from umbilical.cli.options import Force
from umbilical.cli.output import print_result
from umbilical.cli.targets import SCHEMA_LINE, schema_beside
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
        study = source in study_names()
        text = _marked(_text(source), source, target)
        written = files.write(target, (text if study else SCHEMA_LINE + text).encode(), force=force)
        beside = {} if study else schema_beside(written)
        lines = [f"copied: {written}", *(f"  {role} for editors: {path}" for role, path in beside.items())]
        print_result("\n".join(lines))
        verb = "sweep" if study else "run"
        print_result(f"  next: change it; `umbilical show {target}`; `umbilical {verb} {target}`")
    else:
        print_result(_text(name) if name else _descriptions())


def _marked(text: str, source: str, target: Path) -> str:
    """The text of a preset under the file's name; its description and reasons, which changes make untrue, marked."""
    from umbilical.scenario.text import literal

    head = f"# Copied from {source}: its description, and its reasons behind what is assumed, until you change them.\n"
    text = text.replace(f'name = "{source}"', f"name = {literal(target.stem[:80])}", 1)
    return head + re.sub(r'^description = ("""|")', rf"\g<0>Copied from {source}. ", text, count=1, flags=re.MULTILINE)


def examples(
    copy: Annotated[
        Path | None, Option("--copy", metavar="DIR", help="Copy them to a folder of yours, made if need be.")
    ] = None,
    force: Force = False,
) -> None:
    """List or copy the examples: scripts in Python, and a notebook.

    \b
    examples
      umbilical examples
      umbilical examples --copy tries
    """
    from umbilical import files

    found = {
        path.relative_to(folder).as_posix(): path
        for folder in [_examples()]
        for path in sorted(folder.rglob("*"))
        if path.suffix in (".py", ".ipynb")
    }
    if copy is None:
        print_result(table([(name, _purpose(path)) for name, path in found.items()]))
        return
    for name, path in found.items():
        files.make_folder((copy / name).parent)
        files.write(copy / name, path.read_bytes(), force=force)
    print_result(f"copied: {len(found)} files to {copy}\n  next: python {copy / 'first_run.py'}")


def _examples() -> Path:
    """Where the scripts are: in the installed package, or beside its source."""
    installed = Path(__file__).parents[1] / "examples"
    return installed if installed.is_dir() else Path(__file__).parents[3] / "examples"


def _purpose(path: Path) -> str:
    """First line of an example's own words."""
    import json
    from ast import get_docstring, parse

    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        return json.loads(text)["cells"][0]["source"][0].strip("# \n")
    return (get_docstring(parse(text)) or "").partition("\n")[0]


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


def schema(
    out: Annotated[Path | None, Option("--out", metavar="FILE.json", help="Write it to a file instead.")] = None,
    force: Force = False,
) -> None:
    """Print or write the JSON Schema of scenario files, with which editors check and complete them.

    \b
    examples
      umbilical schema --out scenario.schema.json
      umbilical schema > scenario.schema.json

    A first line "#:schema ./scenario.schema.json" in a scenario names it; `presets --copy` writes both.
    """
    from umbilical import files
    from umbilical.scenario.document import schema_text

    print_result(f"schema: {files.write(out, schema_text().encode(), force=force)}" if out else schema_text())
