"""Files that appear whole or not at all, and files that are read without trust in what they are."""

from __future__ import annotations

import os
import re
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any

from umbilical.errors import FileError, OutputError

MOST_TEXT = 50_000_000
"""Bytes of the largest text that is read."""
_PART = re.compile(r"\.umbilical-[0-9a-f]{16}\.part")


def read(path: str | os.PathLike[str]) -> bytes:
    """Everything in an ordinary file.

    Raises:
        FileError: the file is missing, a folder, a pipe or a device, or may not be read.

    >>> from umbilical.errors import FileError
    >>> try:
    ...     read("no such file")
    ... except FileError as error:
    ...     print(error)
    no such file: there is no such file
    """
    with _opened(path) as file:
        if not Path(path).is_file():
            raise FileError(f"{path}: this is not an ordinary file")
        return file.read()


def read_text(path: str | os.PathLike[str]) -> str:
    """Text of a UTF-8 file or pipe, line ends as they are in Python.

    Raises:
        FileError: as for :func:`read`, or it is too large to be such a text, or is not UTF-8.
    """
    with _opened(path) as file:
        content = file.read(MOST_TEXT + 1)
    if len(content) > MOST_TEXT:
        raise FileError(f"{path}: larger than {MOST_TEXT // 1_000_000} MB, which no text read here is")
    try:
        return content.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise FileError(f"{path}: this is not UTF-8 text (line {line}); save it with that encoding") from error


@contextmanager
def _opened(path: str | os.PathLike[str]) -> Iterator[IO[bytes]]:
    try:
        with Path(path).open("rb") as file:
            yield file
    except FileNotFoundError as error:
        raise FileError(f"{path}: there is no such file") from error
    except IsADirectoryError:
        raise FileError(f"{path}: this is a folder, not a file") from None
    except (OSError, ValueError) as error:  # a name that no file can have is a ValueError
        raise FileError(f"{path}: cannot be read ({_reason(error)})") from error


def write(path: str | os.PathLike[str], content: bytes, *, force: bool = False) -> Path:
    """Write a file whole or not at all, and return its path.

    The content goes to a temporary file in the same folder, reaches the disk, and takes its name in one step, so that
    whatever happens, ``path`` holds what it held before or all of ``content``. No temporary file is left by a failure,
    and what a killed process left in that folder is removed.

    Args:
        path: where the file shall be; its folder must exist. A link is followed.
        content: what it shall hold.
        force: replace an existing file. Without it even another process cannot be overwritten unnoticed.

    Raises:
        OutputError: as for :func:`check_free`, or the disk is full.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write(folder + "/note.txt", b"short").read_bytes()
    b'short'
    """
    check_free(path, force=force)
    named = Path(path)
    target = named.resolve() if named.is_symlink() else named
    try:
        remove_stale_parts(target.parent)
        with _part_beside(target, content) as part:
            _publish(part, target, force)
    except FileExistsError:
        raise OutputError(f"{path}: exists already; give another name, or force to replace it") from None
    except (OSError, ValueError) as error:
        raise OutputError(f"{path}: cannot be written ({_reason(error)}); nothing was left there") from error
    return named


def check_free(path: str | os.PathLike[str], *, force: bool = False) -> None:
    """Refuse a file that :func:`write` could not write, as far as that can be seen beforehand.

    Raises:
        OutputError: the file exists and ``force`` is false, ``path`` is a link that leads nowhere or no ordinary file,
            or the folder is missing or read-only.
    """
    target = Path(path)
    try:
        if reason := _refusal(target, force):
            raise OutputError(f"{target}: {reason}")
    except (OSError, ValueError) as error:
        raise OutputError(f"{path}: cannot be written ({_reason(error)})") from error


def make_folder(folder: Path) -> None:
    """Make a folder and those on the way to it; one that is there is left as it is.

    Raises:
        OutputError: it cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise OutputError(f"{folder}: the folder cannot be made ({_reason(error)})") from error


def remove_stale_parts(folder: Path) -> None:
    """Remove the temporary files of processes that were killed while they wrote into a folder.

    A process holds a lock on its temporary file for as long as it lives, so that none is taken from under it.
    """
    with suppress(OSError):
        for part in [entry for entry in folder.iterdir() if _PART.fullmatch(entry.name)]:
            with suppress(OSError):
                _remove_if_stale(part)


def try_lock(file: IO[bytes], *, wait: bool = False) -> bool:
    """Lock an open file for this process, until it is closed or the process ends; False if another holds it."""
    try:
        if os.name == "nt":
            import msvcrt

            locking: Any = msvcrt
            locking.locking(file.fileno(), locking.LK_LOCK if wait else locking.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except OSError:
        return False
    return True


def _remove_if_stale(part: Path) -> None:
    if part.is_symlink() or not part.is_file() or (os.name != "nt" and part.stat().st_uid != os.geteuid()):
        return
    if os.name == "nt":
        part.unlink()  # refused while its writer has it open
        return
    with part.open("ab") as file:
        if try_lock(file):
            part.unlink()


def _refusal(target: Path, force: bool) -> str:
    """Why a file cannot be written; empty if nothing speaks against it."""
    if target.is_symlink() and not target.exists():
        return f"this is a link to {target.readlink()}, which is not there; remove it or give another name"
    folder = (target.resolve() if target.is_symlink() else target).parent
    if not folder.is_dir():
        return f"there is no folder {folder}; make it first"
    if target.is_dir():
        return "this is a folder; give the name of a file in it"
    if target.exists() and not target.is_file():
        return "this is not an ordinary file"
    if target.exists() and not force:
        return "exists already; give another name, or force to replace it"
    if not os.access(folder, os.W_OK, effective_ids=os.access in os.supports_effective_ids):
        return f"cannot be written (Permission denied: the folder {folder}); name another"
    return ""


@contextmanager
def _part_beside(target: Path, content: bytes) -> Iterator[Path]:
    """A temporary file with the content on the disk, locked until it has its name or is discarded."""
    part, file = _new_part(target.parent)
    try:
        with file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
            if os.name != "nt":  # there a file cannot be renamed while it is open
                yield part
        if os.name == "nt":
            yield part
    finally:
        with suppress(OSError):  # nothing is there after a rename
            part.unlink()


def _new_part(folder: Path) -> tuple[Path, IO[bytes]]:
    """A new temporary file, locked; another one if it was taken for stale before it had its lock."""
    while True:
        part = folder / f".umbilical-{secrets.token_hex(8)}.part"
        file = part.open("xb")
        if os.name != "nt":
            try_lock(file, wait=True)  # where the disk has no locks nothing is taken for stale, either
        if part.exists():
            return part, file
        file.close()


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


def _reason(error: OSError | ValueError) -> str:
    return getattr(error, "strerror", None) or str(error) or type(error).__name__
