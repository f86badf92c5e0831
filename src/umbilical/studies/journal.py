"""The journal of work under way: one line for each finished piece, which survives whatever happens next.

A line is written, brought to the disk and only then counted; it carries its own checksum. A process that is killed
while it writes leaves half a line, which the next one cuts off; a disk that is full leaves none. A line that is damaged
in the middle of others is nobody's kill, and is refused.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from time import monotonic
from typing import Any
from zlib import crc32

from umbilical.errors import FileError, OutputError

_SYNC_EVERY = 1.0
"""Seconds between two waits for the disk. A killed process loses nothing it wrote; a power cut this much."""
BEGIN_ANEW = "begin anew with --force"


def to_line(entry: Any) -> bytes:
    """Plain data as a line: checksum, then JSON, whose numbers read back bit for bit."""
    text = json.dumps(entry, separators=(",", ":")).encode()
    return b"%08x %s\n" % (crc32(text), text)


def is_whole_line(line: bytes) -> bool:
    """Whether nothing of a line is missing or changed."""
    return line.endswith(b"\n") and line[8:9] == b" " and line[:8] == b"%08x" % crc32(line[9:-1])


def lines(path: Path) -> Iterator[bytes]:
    """Lines of a journal, up to a last one that is not whole.

    Raises:
        FileError: a line is not whole and others that are follow it, which no kill leaves; or it cannot be read.
    """
    try:
        file = path.open("rb")
    except FileNotFoundError:
        return
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror})") from error
    with file:
        for number, line in enumerate(file, start=1):
            if is_whole_line(line):
                yield line
            elif any(map(is_whole_line, file)):
                raise FileError(
                    f"{path}: line {number} is damaged and lines after it are not; remove that line and go on with "
                    f"--resume, or {BEGIN_ANEW}"
                )


def entries(path: Path) -> Iterator[Any]:
    """What was written, in that order, up to a last line that is not whole.

    Raises:
        FileError: the journal is damaged.
    """
    for number, line in enumerate(lines(path), start=1):
        try:
            yield json.loads(line[9:-1])
        except (ValueError, RecursionError) as error:
            raise FileError(f"{path}: line {number} is not what Umbilical writes; {BEGIN_ANEW}") from error


class Journal:
    """A journal that is open for writing."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._size = sum(map(len, lines(path)))
        try:
            self._file = path.open("ab", buffering=0)
            self._file.truncate(self._size)
        except OSError as error:
            raise OutputError(f"{path}: cannot be written ({error.strerror})") from error
        self._synced = monotonic()

    def append(self, entry: Any) -> None:
        """Add a line, whole or not at all.

        Raises:
            OutputError: the disk is full or gone; what was there before still is.
        """
        line = to_line(entry)
        try:
            self._write(line)
            if monotonic() - self._synced > _SYNC_EVERY:
                os.fsync(self._file.fileno())
                self._synced = monotonic()
        except OSError as error:
            self._file.truncate(self._size)
            raise OutputError(
                f"{self._path}: cannot be written ({error.strerror}); all that was finished is kept, "
                "make room and go on with --resume"
            ) from error
        self._size += len(line)

    def _write(self, line: bytes) -> None:
        while line:
            line = line[self._file.write(line) :]

    def close(self) -> None:
        """Bring everything to the disk."""
        os.fsync(self._file.fileno())
        self._file.close()
