"""Run what stands in a page of the documentation, block after block, in a folder of its own.

    .venv/bin/python tools/pages.py docs/tutorial-own-law.md --into out/own-law

Tests run all pages this way. Of a block's language:

- ``toml``, ``python``, ``csv`` and ``c`` whose first line is ``# name.ext`` (C: ``//``): the file of that
  name (csv: without that line);
- ``python`` without a name: executed, all of a page in one namespace;
- ``bash``: executed; a line may end in ``# exit code N`` where that is what the page is about;
- ``output``: what the block before it prints. Numbers hold within 2 %, and ``...`` stands for anything;
- ``text``: no command and no file.

Commands that take longer than a test may, or need a network, are listed in tools/pages.toml with what is run instead.
With ``--full`` every command that can run is run as it stands.
"""

from __future__ import annotations

import argparse
import contextlib
import doctest
import io
import math
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.DOTALL | re.MULTILINE)
_NAME = re.compile(r"(?:#|//) ([\w-]+\.(?:toml|py|csv|c))\n")
_CODE = re.compile(r"\s#.*\bexit code (\d+)$")
_REMARK = re.compile(r"\s+#\s.*$")
_LOOSE = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
COMMANDS = Path(sys.executable).parent
"""Where ``umbilical`` and ``python`` of this environment are."""


class PageError(Exception):
    """A block did not do what its page says."""


@dataclass(frozen=True)
class Block:
    """One block of a page: its language, its text, and the line it begins at."""

    language: str
    text: str
    line: int

    @property
    def file(self) -> str:
        """Name of the file it is, empty for one that is run."""
        found = _NAME.match(self.text)
        return found[1] if found else ""


@dataclass(frozen=True)
class Command:
    """A line of bash without its remark, and the exit code it says it ends with."""

    text: str
    code: int = 0


def blocks(page: Path) -> Iterator[Block]:
    """All blocks of a page, in their order."""
    text = page.read_text(encoding="utf-8")
    for found in _BLOCK.finditer(text):
        yield Block(found[1], found[2], text.count("\n", 0, found.start()) + 1)


def commands(block: Block) -> list[Command]:
    """The commands of a ``bash`` block, continued lines joined."""
    lines = re.sub(r"\\\n\s*", "", block.text).splitlines()
    return [_command(line) for line in lines if line.strip() and not line.startswith("#")]


def _command(line: str) -> Command:
    code = _CODE.search(line)
    return Command(_REMARK.sub("", line), int(code[1]) if code else 0)


def replacements(page: str) -> Mapping[str, str]:
    """The commands of a page that are not run as they stand, and what is run: see tools/pages.toml."""
    listed = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    return {text: _replacement(text, entry) for text, entry in listed.get(page, {}).items()}


def _replacement(text: str, entry: Mapping[str, str]) -> str:
    return f"{text} {entry['add']}" if "add" in entry else entry.get("run", "")


def run_page(page: Path, folder: Path, instead: Mapping[str, str] = {}) -> None:
    """Run a page's blocks in a folder.

    Args:
        page: the Markdown file.
        folder: exists; files of the page are written into it.
        instead: commands of the page, and what is run in their place; an empty text leaves one out.

    Raises:
        PageError: a block failed, or printed something else than the page shows.
    """
    names: dict[str, Any] = {"__name__": page.stem}
    printed, whole = "", True
    run: dict[str, Callable[[Block], str]] = {
        "python": lambda block: _run_python(page, block, folder, names),
        "bash": lambda block: "".join(_run_command(command, folder, instead) for command in commands(block)),
    }
    for block in blocks(page):
        try:
            if block.file:
                _write(block, folder)
            elif block.language in run:
                printed = run[block.language](block)
                whole = block.language == "python" or not {c.text for c in commands(block)} & set(instead)
            elif block.language == "output" and whole:
                compare(block.text, printed)
        except Exception as error:
            raise PageError(f"{page.name}, line {block.line}: {error}") from error


def _write(block: Block, folder: Path) -> None:
    text = block.text.split("\n", 1)[1] if block.language == "csv" else block.text
    (folder / block.file).write_text(text, encoding="utf-8")


def _run_python(page: Path, block: Block, folder: Path, names: dict[str, Any]) -> str:
    printed = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(printed):
        exec(compile("\n" * block.line + block.text, page.name, "exec"), names)
    return printed.getvalue()


def _run_command(command: Command, folder: Path, instead: Mapping[str, str]) -> str:
    """What a command prints, or what is run in its place.

    Raises:
        PageError: it ends with another exit code than its line says.
    """
    path = f"{COMMANDS}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "COLUMNS": "120", "OPENBLAS_NUM_THREADS": "1"}
    text = instead.get(command.text, command.text)
    done = subprocess.run(
        ["bash", "-c", text], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    if done.returncode != (command.code if text else 0):
        raise PageError(f"{text}\nended with exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def compare(wanted: str, printed: str) -> None:
    """Compare line by line, numbers within 2 %; a line ``...`` stands for any number of lines.

    Raises:
        PageError: a line that is wanted does not come.
    """
    rest, skip = iter(filter(str.strip, printed.splitlines())), False
    for line in filter(str.strip, wanted.splitlines()):
        if line.strip() == "...":
            skip = True
            continue
        found = any(_alike(line, other) for other in rest) if skip else _alike(line, next(rest, ""))
        skip = False
        if not found:
            raise PageError(f"the page shows\n{line}\nand this was printed\n{printed}")


def _alike(wanted: str, printed: str) -> bool:
    """Whether two lines are the same but for spaces, what ``...`` stands for, and 2 % of their numbers."""
    if "..." in wanted:
        return doctest.OutputChecker().check_output(wanted + "\n", printed + "\n", _LOOSE)
    words = [_NUMBER.sub("#", line).split() for line in (wanted, printed)]
    numbers = [[float(number) for number in _NUMBER.findall(line)] for line in (wanted, printed)]
    return words[0] == words[1] and all(math.isclose(a, b, rel_tol=0.02) for a, b in zip(*numbers, strict=True))


def main() -> int:
    """Run one page and leave what it makes in a folder."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("--into", type=Path, required=True)
    parser.add_argument("--full", action="store_true", help="run long commands as they stand")
    given = parser.parse_args()
    given.into.mkdir(parents=True, exist_ok=True)
    instead = replacements(given.page.name)
    run_page(given.page.resolve(), given.into.resolve(), _left_out(instead) if given.full else instead)
    return 0


def _left_out(instead: Mapping[str, str]) -> dict[str, str]:
    return {text: run for text, run in instead.items() if not run}


if __name__ == "__main__":
    raise SystemExit(main())
