"""Files a command shall write: refused before the work, not after it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from umbilical import files
from umbilical.errors import OutputError

PICTURES = ("png", "pdf", "svg")
SCHEMA = "scenario.schema.json"
SCHEMA_LINE = f"#:schema ./{SCHEMA}\n"
"""First line of a scenario's file: where editors find its schema."""


def check_target(path: Path | None, kinds: tuple[str, ...], *, force: bool) -> None:
    """Refuse a file that could not be written later.

    Args:
        path: the file; None where none was asked for.
        kinds: endings it may have, without the dot.
        force: whether it may replace a file.

    Raises:
        OutputError: another ending, or as for :func:`umbilical.files.check_free`.
    """
    if path is None:
        return
    if path.suffix.lower().removeprefix(".") not in kinds:
        raise OutputError(f"{path}: the name must end with {' or '.join('.' + kind for kind in kinds)}")
    files.check_free(path, force=force)


def draw_files(picture: Callable[[], Any], path: Path | None, *, force: bool) -> dict[str, str]:
    """Store what a function draws, axes or a figure, where a path was given; the file by its role."""
    if path is None:
        return {}
    from umbilical.plots import as_figure, save_figure

    return {"plot": str(save_figure(as_figure(picture()), path, force=force))}


def make_room(folder: Path, targets: list[Path], *, force: bool) -> None:
    """Make the folder; refuse what could not be written later.

    Raises:
        OutputError: the folder cannot be made, or holds files of these names.
    """
    files.make_folder(folder)
    there = [target.name for target in targets if target.exists() or target.is_symlink()]
    if there and not force:
        more = f" and {len(there) - 3} more" if len(there) > 3 else ""
        raise OutputError(f"{folder}: holds {', '.join(there[:3])}{more} already; name another folder, or --force")


def write_scenario(path: Path, text: str, *, force: bool) -> dict[str, str]:
    """Write a scenario and beside it, unless a file has that name, the schema of scenarios; the files by role."""
    from umbilical.scenario.schema import schema_text

    written = {"scenario": str(files.write(path, (SCHEMA_LINE + text).encode(), force=force))}
    schema = path.parent / SCHEMA
    return written if schema.exists() else written | {"schema": str(files.write(schema, schema_text().encode()))}
