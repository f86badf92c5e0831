"""Write the generated pages of docs/ from the source: `.venv/bin/python tools/make_docs`.

With `--check` nothing is written; the pages that are not current are named, and the exit code is 1 if there are any.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from assumed import assumed
from command_line import command_line
from errata import errata
from notation import notation
from paper import paper
from scenario import scenario

from umbilical.scenario.schema import schema_text

DOCS = Path(__file__).resolve().parents[2] / "docs"

PAGES: dict[str, Callable[[], str]] = {
    "notation.md": notation,
    "scenario.md": scenario,
    "assumed.md": assumed,
    "cli.md": command_line,
    "errata.md": errata,
    "paper.md": paper,
    "scenario.schema.json": schema_text,
}


def is_current(name: str, docs: Path = DOCS) -> bool:
    """Whether a page is what the source says."""
    page = docs / name
    return page.exists() and page.read_text(encoding="utf-8") == PAGES[name]()


def main() -> int:
    """Write, or with `--check` only look."""
    check = "--check" in sys.argv
    stale = [name for name in PAGES if not is_current(name)]
    for name in stale:
        if not check:
            (DOCS / name).write_text(PAGES[name](), encoding="utf-8")
        print(f"docs/{name}: {'not current' if check else 'written'}")
    return 1 if stale and check else 0


if __name__ == "__main__":
    raise SystemExit(main())
