"""Files that appear whole or not at all."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from umbilical.errors import FileError, OutputError


def read(path: str | os.PathLike[str]) -> bytes:
    """Everything in a file.

    Raises:
        FileError: the file is missing, a directory, or may not be read.

    >>> from umbilical.errors import FileError
    >>> try:
    ...     read("no such file")
    ... except FileError as error:
    ...     print(error)
    no such file: there is no such file
    """
    try:
        return Path(path).read_bytes()
    except FileNotFoundError:
        raise FileError(f"{path}: there is no such file") from None
    except IsADirectoryError:
        raise FileError(f"{path}: this is a folder, not a file") from None
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({_reason(error)})") from error


def write(path: str | os.PathLike[str], content: bytes, *, force: bool = False) -> Path:
    """Write a file whole or not at all, and return its path.

    The content goes to a temporary file in the same folder, reaches the disk, and takes its name in one step, so that
    whatever happens, ``path`` holds what it held before or all of ``content``. No temporary file is left by a failure.

    Args:
        path: where the file shall be; its folder must exist.
        content: what it shall hold.
        force: replace an existing file. Without it even another process cannot be overwritten unnoticed.

    Raises:
        OutputError: the file exists and ``force`` is false, ``path`` is not an ordinary file, or the folder is
            missing, read-only or full.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write(folder + "/note.txt", b"short").read_bytes()
    b'short'
    """
    target = Path(path)
    part = target.parent / f".umbilical-{secrets.token_hex(8)}.part"
    try:
        _refuse(target, force)
        _write_through(part, content)
        _publish(part, target, force)
    except FileExistsError:
        raise OutputError(f"{path}: exists already; give another name, or force to replace it") from None
    except OSError as error:
        raise OutputError(f"{path}: cannot be written ({_reason(error)}); nothing was left there") from error
    finally:
        _discard(part)
    return target


def make_folder(folder: Path) -> None:
    """Make a folder and those on the way to it; one that is there is left as it is.

    Raises:
        OutputError: it cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: the folder cannot be made ({error.strerror})") from error


def _refuse(target: Path, force: bool) -> None:
    if not target.parent.is_dir():
        raise OutputError(f"{target}: there is no folder {target.parent}; make it first")
    if target.is_dir():
        raise OutputError(f"{target}: this is a folder; give the name of a file in it")
    if target.exists() and not target.is_file():
        raise OutputError(f"{target}: this is not an ordinary file")
    if target.exists() and not force:
        raise FileExistsError


def _write_through(part: Path, content: bytes) -> None:
    with part.open("xb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())


def _publish(part: Path, target: Path, force: bool) -> None:
    """Give the finished file its name; without ``force`` this is what settles a race of two writers."""
    if force:
        part.replace(target)
    elif os.name == "nt":
        part.rename(target)  # refuses to replace, there
    else:
        _link(part, target)


def _link(part: Path, target: Path) -> None:
    """A link refuses to replace a file, which a rename does not; where the disk has no links, a look must do."""
    try:
        target.hardlink_to(part)
    except FileExistsError:
        raise
    except OSError:
        if target.exists():
            raise FileExistsError from None
        part.rename(target)


def _discard(part: Path) -> None:
    # Nothing to discard after a rename, or when the part could never be made.
    try:
        if part.is_file():
            part.unlink()
    except OSError:
        return


def _reason(error: OSError) -> str:
    return error.strerror or str(error) or type(error).__name__
