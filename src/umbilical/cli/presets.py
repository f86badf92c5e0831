"""``umbilical presets``, ``examples`` and ``schema``: what comes with the package."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from umbilical.cli.options import Force, source
from umbilical.cli.output import print_result
from umbilical.cli.targets import write_scenario
from umbilical.errors import FileError
from umbilical.tables import text_table

if TYPE_CHECKING:
    from umbilical.scenario.presets import Presets


def presets_command(
    name: Annotated[
        str | None,
        source("Print this preset's text; all names if left out.", "scenario", "studies", "screening"),
    ] = None,
    copy: Annotated[
        tuple[str, Path] | None, Option("--copy", metavar="NAME FILE", help="Copy a preset to a file of yours.")
    ] = None,
    force: Force = False,
) -> None:
    """List, print or copy the scenarios, studies and operations that come along.

    \b
    examples
      umbilical presets
      umbilical presets paper-dead
      umbilical presets --copy paper my.toml
      umbilical presets --copy paper-robustness my-study.toml
      umbilical presets --copy work-class my-operation.toml
    """
    if not copy:
        print_result(_find(name)[1] if name else _descriptions())
        return
    from umbilical import files

    preset, target = copy
    verb, text = _find(preset)
    text, beside = _marked(text, preset, target), ""
    if verb == "run":
        written = write_scenario(target, text, force=force)
        beside = f"  schema for editors: {written['schema']}\n" if "schema" in written else ""
    else:
        files.write(target, text.encode(), force=force)
    print_result(f"copied: {target}\n{beside}  next: change it; `umbilical show {target}`; `umbilical {verb} {target}`")


def _marked(text: str, source: str, target: Path) -> str:
    """The text of a preset under the file's name; its description and reasons, which changes make untrue, marked."""
    from umbilical.scenario.text import literal

    head = f"# Copied from {source}: its description, and its reasons behind what is assumed, until you change them.\n"
    text = text.replace(f'name = "{source}"', f"name = {literal(target.stem[:80])}", 1)
    return head + re.sub(r'^description = ("""|")', rf"\g<0>Copied from {source}. ", text, count=1, flags=re.MULTILINE)


def examples_command(
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

    installed = Path(__file__).parents[1] / "examples"
    folder = installed if installed.is_dir() else Path(__file__).parents[3] / "examples"
    found = {
        path.relative_to(folder).as_posix(): path
        for path in sorted(folder.rglob("*"))
        if path.suffix in (".py", ".ipynb")
    }
    if copy is None:
        print_result(text_table([(name, _purpose(path)) for name, path in found.items()]))
        return
    for name, path in found.items():
        files.make_folder((copy / name).parent)
        files.write(copy / name, path.read_bytes(), force=force)
    print_result(f"copied: {len(found)} files to {copy}\n  next: python {copy / 'first_run.py'}")


def _purpose(path: Path) -> str:
    """First line of an example's own words."""
    import json
    from ast import get_docstring, parse

    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        return json.loads(text)["cells"][0]["source"][0].strip("# \n")
    return (get_docstring(parse(text)) or "").partition("\n")[0]


def _kinds() -> dict[str, tuple[str, Presets]]:
    """What comes along, by what it is: the command that takes it, and where it is."""
    from umbilical.library.load import PRESETS
    from umbilical.screening.load import OPERATIONS
    from umbilical.studies.load import STUDIES

    return {"scenarios": ("run", PRESETS), "studies": ("sweep", STUDIES), "operations": ("operate", OPERATIONS)}


def _find(name: str) -> tuple[str, str]:
    """The command that takes what has this name, and its TOML text; FileError if there is none."""
    from umbilical.scenario.problems import nearest

    for verb, presets in _kinds().values():
        if name in presets.names:
            return verb, presets.text(name)
    known = [known for _, presets in _kinds().values() for known in presets.names]
    raise FileError(f"{name}: there is no preset of this name; {nearest(name, known)}")


def _descriptions() -> str:
    from umbilical.scenario.document import read_document

    def described(presets: Presets) -> str:
        texts = {name: read_document(presets.text(name), name)["description"] for name in presets.names}
        return text_table([(name, text.partition(" Source:")[0]) for name, text in texts.items()])

    return "\n\n".join(f"{kind}, for `umbilical {verb}`\n{described(own)}" for kind, (verb, own) in _kinds().items())


def schema_command(
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
    from umbilical.scenario.schema import schema_text

    print_result(f"schema: {files.write(out, schema_text().encode(), force=force)}" if out else schema_text())
