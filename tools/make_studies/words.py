"""Pieces of a page."""

from __future__ import annotations

import re
from collections.abc import Sequence
from textwrap import fill

_WIDTH = 118


def rows_of(rows: Sequence[Sequence[str]]) -> str:
    """A table; the first row is its head."""
    lines = [rows[0], ["---"] * len(rows[0]), *rows[1:]]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def paragraph(*sentences: str) -> str:
    """Sentences, wrapped as the page is."""
    return fill(" ".join(sentences), _WIDTH, break_long_words=False, break_on_hyphens=False)


def item(*sentences: str) -> str:
    """Sentences as an item of a list."""
    text = "- " + " ".join(sentences)
    return fill(text, _WIDTH, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)


def millimetres(value: float) -> str:
    """A short length in words."""
    return f"{1e3 * value:.3g}\N{NO-BREAK SPACE}mm"


def between(text: str, name: str, content: str) -> str:
    """The page with new content between the marks of a name.

    Raises:
        ValueError: the page has no such marks, or several.
    """
    marks = rf"(<!-- {name}: written by tools/make_studies -->\n).*?(<!-- {name}: end -->)"
    changed, count = re.subn(marks, lambda m: f"{m[1]}{content}\n{m[2]}", text, flags=re.DOTALL)
    if count != 1:
        raise ValueError(f"the page has {count} places for {name}")
    return changed
