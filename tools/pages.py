"""Run what stands in a page of the documentation, block after block, in a folder of its own.

    .venv/bin/python tools/pages.py docs/tutorial-own-law.md --into out/own-law

Tests run the pages of ``COMPLETE`` in tests/contract/test_docs.py this way, and the Python of all others. Of a block's
language:

- ``toml``, ``python`` and ``csv`` whose first line is ``# name.ext``: the file of that name (csv: without that line);
- ``python`` without a name: executed, all of a page in one namespace;
- ``bash``: executed; a line may end in ``# exit code N`` where that is what the page is about;
- ``output``: what the block before it prints, with ``...`` for what differs from machine to machine;
- anything else is text.
"""

from __future__ import annotations

import argparse
import contextlib
import doctest
import io
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.DOTALL | re.MULTILINE)
_NAME = re.compile(r"# ([\w-]+\.(?:toml|py|csv))\n")
_CODE = re.compile(r"# exit code (\d+)$")
_LOOSE = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
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


def blocks(page: Path) -> Iterator[Block]:
    """All blocks of a page, in their order."""
    text = page.read_text(encoding="utf-8")
    for found in _BLOCK.finditer(text):
        yield Block(found[1], found[2], text.count("\n", 0, found.start()) + 1)


def commands(block: Block) -> list[str]:
    """The commands of a ``bash`` block, continued lines joined."""
    lines = re.sub(r"\\\n\s*", "", block.text).splitlines()
    return [line for line in lines if line.strip() and not line.startswith("#")]


def run_page(
    page: Path, folder: Path, *, languages: tuple[str, ...] = ("bash", "python"), instead: Mapping[str, str] = {}
) -> None:
    """Run a page's blocks in a folder.

    Args:
        page: the Markdown file.
        folder: exists; files of the page are written into it.
        languages: of the blocks that are run.
        instead: commands of the page, and what is run in their place; an empty text leaves one out.

    Raises:
        PageError: a block failed, or printed something else than the page shows.
    """
    names: dict[str, Any] = {"__name__": page.stem}
    printed = ""
    run: dict[str, Callable[[Block], str]] = {
        "python": lambda block: _run_python(page, block, folder, names),
        "bash": lambda block: "".join(run_command(instead.get(c, c), folder) for c in commands(block)),
    }
    for block in blocks(page):
        try:
            if block.file:
                _write(block, folder)
            elif block.language in languages:
                printed = run[block.language](block)
            elif block.language == "output" and set(languages) == set(run):
                _compare(block.text, printed)
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


def run_command(command: str, folder: Path) -> str:
    """What a line of bash prints.

    Raises:
        PageError: it ends with another exit code than its line says, which is 0 where it says none.
    """
    said = _CODE.search(command)
    path = f"{COMMANDS}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "COLUMNS": "120", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(
        ["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    if done.returncode != (int(said[1]) if said else 0):
        raise PageError(f"{command}\nended with exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def _compare(wanted: str, printed: str) -> None:
    if not doctest.OutputChecker().check_output(wanted, printed, _LOOSE):
        raise PageError(f"the page shows\n{wanted}and this was printed\n{printed}")


def main() -> int:
    """Run one page and leave what it makes in a folder."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("--into", type=Path, required=True)
    given = parser.parse_args()
    given.into.mkdir(parents=True, exist_ok=True)
    run_page(given.page.resolve(), given.into.resolve())
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
