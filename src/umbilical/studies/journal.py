"""The journal of a study under way: one line for each finished member, which survives whatever happens next.

A line is written, brought to the disk and only then counted; it carries its own checksum. A process that is killed
while it writes leaves half a line, which the next one cuts off; a disk that is full leaves none.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from time import monotonic
from zlib import crc32

from umbilical.errors import OutputError
from umbilical.studies.rows import Cell, Row

_SYNC_EVERY = 1.0
"""Seconds between two waits for the disk. A killed process loses nothing it wrote; a power cut this much."""


def to_line(row: Row) -> bytes:
    """A row as a line: checksum, then JSON, whose numbers read back bit for bit."""
    text = json.dumps([row.number, row.cells], separators=(",", ":")).encode()
    return b"%08x %s\n" % (crc32(text), text)


def from_line(line: bytes) -> Row | None:
    """The row of a line; None if the line is not whole."""
    if not line.endswith(b"\n") or line[8:9] != b" " or line[:8] != b"%08x" % crc32(line[9:-1]):
        return None
    number, cells = json.loads(line[9:-1])
    return Row(number, tuple(Cell(status, reason, end, tuple(metrics)) for status, reason, end, metrics in cells))


def rows(path: Path) -> Iterator[Row]:
    """Rows of a journal, up to the first that is not whole."""
    if path.exists():
        with path.open("rb") as file:
            for line in file:
                if (row := from_line(line)) is None:
                    return
                yield row


class Journal:
    """A journal that is open for writing."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._size = sum(len(to_line(row)) for row in rows(path))
        try:
            self._file = path.open("ab", buffering=0)
            self._file.truncate(self._size)
        except OSError as error:
            raise OutputError(f"{path}: cannot be written ({error.strerror})") from error
        self._synced = monotonic()

    def append(self, row: Row) -> None:
        """Add a row, whole or not at all.

        Raises:
            OutputError: the disk is full or gone; what was there before still is.
        """
        line = to_line(row)
        try:
            self._write(line)
            if monotonic() - self._synced > _SYNC_EVERY:
                os.fsync(self._file.fileno())
                self._synced = monotonic()
        except OSError as error:
            self._file.truncate(self._size)
            raise OutputError(
                f"{self._path}: cannot be written ({error.strerror}); all members up to then are kept, "
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
