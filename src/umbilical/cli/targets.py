"""Files a command shall write: refused before the work, not after it."""

from __future__ import annotations

import os
from pathlib import Path

from umbilical.errors import OutputError
from umbilical.files import make_folder

PICTURES = ("png", "pdf", "svg")


def check_target(path: Path, kinds: tuple[str, ...], *, force: bool) -> None:
    """Refuse a file that could not be written later.

    Args:
        path: the file.
        kinds: endings it may have, without the dot.
        force: whether it may replace a file.

    Raises:
        OutputError: another ending, no such folder, a folder that may not be written to, or a file that exists.
    """
    if path.suffix.lower().removeprefix(".") not in kinds:
        raise OutputError(f"{path}: the name must end with {' or '.join('.' + kind for kind in kinds)}")
    if not path.parent.is_dir():
        raise OutputError(f"{path}: there is no folder {path.parent}; make it first")
    if not os.access(path.parent, os.W_OK):
        raise OutputError(f"{path}: the folder {path.parent} may not be written to; name another")
    if path.is_dir():
        raise OutputError(f"{path}: this is a folder; give the name of a file in it")
    if path.exists() and not force:
        raise OutputError(f"{path}: exists already; give another name, or --force to replace it")


def make_room(folder: Path, targets: list[Path], *, force: bool) -> None:
    """Make the folder; refuse what could not be written later.

    Raises:
        OutputError: the folder cannot be made, or holds files of these names.
    """
    make_folder(folder)
    there = [target.name for target in targets if target.exists()]
    if there and not force:
        more = f" and {len(there) - 3} more" if len(there) > 3 else ""
        raise OutputError(f"{folder}: holds {', '.join(there[:3])}{more} already; name another folder, or --force")
