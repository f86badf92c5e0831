"""The one place that writes to standard output and standard error.

What is printed may hold texts of somebody else's: names, file names, attributes of a result. A terminal obeys some
characters instead of showing them, so whatever it could obey is escaped here.
"""

from __future__ import annotations

import os
import re
import sys
import unicodedata
from contextlib import suppress
from pathlib import Path
from typing import TextIO

from umbilical.errors import OutputError

_MAYBE = re.compile(r"[^\n\t -~]")
_JOINERS = "\u200c\u200d"  # ordinary letters of some scripts


def printable(text: str) -> str:
    """The text with every character escaped that is not shown as itself; line ends and tabs stay.

    >>> printable("beta = 5, \\x1b[31mred")
    'beta = 5, \\\\x1b[31mred'
    """
    return _MAYBE.sub(lambda found: _shown(found.group()), text)


def _shown(character: str) -> str:
    if character.isprintable() or character in _JOINERS or unicodedata.category(character) == "Zs":
        return character
    return character.encode("unicode_escape").decode()


def print_result(text: str) -> None:
    """What was asked for, to standard output.

    Raises:
        BrokenPipeError: the reader has gone.
        OutputError: it cannot be written otherwise: the disk is full, the stream is closed.
    """
    if sys.stdout is None:
        raise OutputError("standard output: cannot be written (it is closed)")
    try:
        _write(sys.stdout, text)
    except BrokenPipeError:
        _silence(sys.stdout)
        raise
    except (OSError, ValueError) as error:
        _silence(sys.stdout)
        raise OutputError(f"standard output: cannot be written ({getattr(error, 'strerror', error)})") from error


def report(text: str) -> None:
    """News and errors, to standard error; where that cannot be written, nobody wants them."""
    if sys.stderr is not None:
        try:
            _write(sys.stderr, text)
        except (OSError, ValueError):
            _silence(sys.stderr)


def occupy_closed_streams() -> None:
    """Give the numbers of closed standard streams to the null device: the next file would be taken for one of them."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)


def _write(stream: TextIO, text: str) -> None:
    coding = stream.encoding or "utf-8"
    stream.write(printable(text.rstrip("\n") + "\n").encode(coding, "backslashreplace").decode(coding))
    stream.flush()


def _silence(stream: TextIO) -> None:
    """Let what is left in a stream that failed go nowhere, instead of failing again when Python ends."""
    with suppress(OSError, ValueError), Path(os.devnull).open("w") as nowhere:
        os.dup2(nowhere.fileno(), stream.fileno())
