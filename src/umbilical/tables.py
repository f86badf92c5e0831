"""Rows of cells as text as wide as the terminal, as Markdown and as HTML; data as JSON holds it."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from html import escape
from sys import maxsize
from textwrap import wrap
from typing import Any

_NARROWEST = 20
"""Characters of the narrowest column that texts are wrapped in."""


def plain(value: Any, *, finite: bool = False) -> Any:
    """The same data as dicts, lists, texts and numbers: records by their fields, arrays as lists.

    Args:
        value: what is to be shown.
        finite: whether numbers that are not become None, for JSON holds none of them.

    >>> plain({"a": (1.0, float("nan"))}, finite=True)
    {'a': [1.0, None]}
    """
    if hasattr(value, "tolist"):  # of numpy
        value = value.tolist()
    if isinstance(value, float):
        return None if finite and not math.isfinite(value) else value
    if is_dataclass(value):
        value = attributes(value, " ".join(field.name for field in fields(value)))
    if hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, Mapping):
        return {str(key): plain(item, finite=finite) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item, finite=finite) for item in value]
    return value


def attributes(found: Any, names: str) -> dict[str, Any]:
    """Attributes of an object by their names, which have spaces between."""
    return {name: getattr(found, name) for name in names.split()}


def shown_unit(unit: str) -> str:
    """A unit as it stands behind a number: nothing for a pure number."""
    return "" if unit == "1" else unit


def text_table(rows: Sequence[Sequence[str]], right: Sequence[int] = ()) -> str:
    """Rows of cells as aligned columns; those numbered in ``right`` are flush right. Of a line that is too long for the
    terminal (or for ``COLUMNS``) the last cell is wrapped.

    >>> print(text_table([("a", "1"), ("bb", "10")], right=[1]))
      a    1
      bb  10
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)] if rows else []
    last = len(widths) - 1
    indent = sum(widths[:-1]) + 2 * len(widths)
    room = max((width() or maxsize) - indent, _NARROWEST)
    lines = []
    for row in rows:
        cells = [f"{c:>{w}}" if k in right else f"{c:<{w}}" for k, (c, w) in enumerate(zip(row, widths, strict=True))]
        if cells and last not in right:
            cells[-1] = f"\n{' ' * indent}".join(wrap(row[-1], room)) if len(row[-1]) > room else row[-1]
        lines.append(("  " + "  ".join(cells)).rstrip())
    return "\n".join(lines)


def markdown(rows: Sequence[Sequence[str]]) -> str:
    """Rows of cells as a table in Markdown, the first of them its head.

    >>> print(markdown([("a",), ("b|c",)]))
    | a |
    | --- |
    | b\\|c |
    """
    lines = [rows[0], ["---"] * len(rows[0]), *rows[1:]]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in lines)


def html_table(rows: Iterable[Sequence[str]]) -> str:
    """Rows of cells as a table in HTML.

    >>> html_table([("a < b", "1")])
    '<table><tr><td>a &lt; b</td><td>1</td></tr></table>'
    """
    cells = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows)
    return f"<table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"


def wrapped(text: str) -> str:
    """A text in lines that the terminal (or ``COLUMNS``) has room for; as it is where there is neither."""
    return "\n".join(wrap(text, max(room, _NARROWEST))) if (room := width()) else text


def width() -> int | None:
    """Characters of a line: what ``COLUMNS`` or the terminal says; None where output goes to a file or a pipe."""
    columns = os.environ.get("COLUMNS", "")
    if columns.isdecimal() and int(columns[:6]) > 0:
        return int(columns[:6])
    try:
        return os.get_terminal_size(1).columns or None
    except OSError:
        return None
