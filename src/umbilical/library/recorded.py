"""Files that a scenario names: their numbers are read into it before it is checked, with the files' hashes."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import ValidationError

from umbilical import files
from umbilical.columns import ColumnChoice, read_columns, series_of
from umbilical.errors import FileError, Problem
from umbilical.library.rao_file import rao_lists
from umbilical.scenario.base import Record
from umbilical.scenario.document import Data, freeze
from umbilical.scenario.fields import element_type, records, tag, word
from umbilical.scenario.problems import problems_of
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.source import FromFile


class Filled(NamedTuple):
    """A table of a document that a file can fill: its key, its data, the lists it must have, and how it is read."""

    key: str
    table: dict[str, Any]
    lists: tuple[str, ...]
    units: tuple[str, str]
    reader: str


def read_files(data: Data, folder: Path, record: type[Record] = Scenario) -> list[Problem]:
    """Fill the tables of a document that name a file, in place; what is wrong is handed back.

    A table that has its numbers and the file's hash is one that was stored: its file is not read again.

    Args:
        data: plain data.
        folder: where relative names start.
        record: what the document is of.
    """
    return [problem for filled in _filled_from_files(data, record, "", "") for problem in _fill(filled, folder)]


def forget(data: Data, keys: Iterable[str], record: type[Record] = Scenario) -> None:
    """Drop numbers whose file was changed by an override, and the file of numbers that were."""
    for key in keys:
        for filled in [*_filled_from_files(data, record, "", "")]:
            file = f"{filled.key}.file"
            if key == file or key.startswith(f"{file}."):
                for part in filled.lists:
                    filled.table.pop(part, None)
                if isinstance(filled.table["file"], dict):
                    filled.table["file"].pop("sha256", None)
            elif key in (f"{filled.key}.{name}" for name in filled.lists):
                del filled.table["file"]


def consequences(problems: Iterable[Problem], of: Iterable[Problem]) -> list[Problem]:
    """Problems without those that a table has only because its file has problems of its own."""
    own = list(of)
    tables = {problem.key.partition(".file")[0] for problem in own}
    return [*dict.fromkeys(p for p in problems if p in own or not _of_table(p, tables))]


def _of_table(problem: Problem, tables: Iterable[str]) -> bool:
    inside = any(f"{problem.key}.".startswith(f"{table}.file.") for table in tables)
    return inside or (problem.value == "missing" and problem.key.rpartition(".")[0] in tables)


def _filled_from_files(data: Any, annotation: Any, key: str, unit: str) -> Iterator[Filled]:
    """Tables with a file, wherever the records allow one."""
    if isinstance(data, list | tuple):
        for number, item in enumerate(data, start=1):
            yield from _filled_from_files(item, element_type(annotation), f"{key}.{number}", unit)
    if not isinstance(data, dict) or (kind := _kind(data, annotation)) is None:
        return
    field = kind.model_fields.get("file")
    extra: Any = field.json_schema_extra if field else None
    if extra and "file" in data:
        units = extra.get("units", ("", ""))
        yield Filled(key, data, tuple(extra["fills"]), (units[0], units[1] or unit), extra.get("reader", "series"))
    for name, item in list(data.items()):
        if (inner := kind.model_fields.get(name)) is not None:
            there = f"{key}.{name}" if key else name
            yield from _filled_from_files(item, inner.annotation, there, word(inner, "unit") or unit)


def _kind(data: Mapping[str, Any], annotation: Any) -> type[Record] | None:
    """Which record a table is of; None where its tag says nothing known."""
    kinds = records(annotation)
    if len(kinds) < 2:
        return kinds[0] if kinds else None
    return next((kind for kind in kinds if data.get(tag(kind)[0]) == tag(kind)[1]), None)


def _fill(filled: Filled, folder: Path) -> Iterator[Problem]:
    table, key = filled.table, f"{filled.key}.file"
    stated = {"name": table["file"]} if isinstance(table["file"], str) else table["file"]
    given = [name for name in filled.lists if name in table]
    if isinstance(stated, dict) and stated.get("sha256") and len(given) == len(filled.lists):
        return
    if given:
        reason = "numbers come from the file or stand here"
        yield Problem(key, "a file", f"no {' and '.join(given)} beside it", reason, "leave out one of both")
        return
    try:
        source = FromFile.model_validate(freeze(stated))
    except ValidationError as error:
        yield from (replace(p, key=f"{key}.{p.key}") for p in problems_of(error, FromFile))
        return
    yield from _read(filled, source, folder)


def _read(filled: Filled, source: FromFile, folder: Path) -> Iterator[Problem]:
    key = f"{filled.key}.file"
    try:
        content = files.read(folder / source.name)
        columns = read_columns(Path(source.name), content)
    except FileError as error:
        there = (folder / source.name).exists()
        fix = "correct it, or save it as CSV or NetCDF" if there else "names are relative to the folder of the scenario"
        yield Problem(f"{key}.name", f'"{source.name}"', "a CSV or NetCDF file", str(error), fix)
        return
    if filled.reader == "rao":
        lists, problems = rao_lists(columns, key)
    else:
        options = source.model_dump(exclude={"name", "sha256"})
        options |= {"jumps": filled.table.get("interpolation") == "linear"}
        found = series_of(columns, ColumnChoice(**options, wanted_across=filled.units[0], wanted=filled.units[1]), key)
        lists, problems = {}, found if isinstance(found, list) else []
        if not isinstance(found, list):
            lists = {name: numbers.tolist() for name, numbers in zip(filled.lists, found[:2], strict=True)}
            source = source.model_copy(update={"start": found.start})
    yield from problems
    if not problems:
        kept = source.model_copy(update={"sha256": hashlib.sha256(content).hexdigest()})  # in place of its name
        filled.table.update(lists, file=kept.model_dump(exclude_none=True))


def files_of(scenario: Scenario) -> dict[str, FromFile]:
    """Files that the numbers of a scenario come from, by the keys of their tables."""
    found = _filled_from_files(scenario.to_dict(), Scenario, "", "")
    return {f.key: FromFile.model_validate(freeze(f.table["file"])) for f in found}
