"""docs/errata.md: where we read the paper otherwise than it is printed."""

from __future__ import annotations

from writing import page, table

from umbilical.papers.rao2022.errata import COLUMNS
from umbilical.papers.rao2022.errata import errata as read


def errata() -> str:
    """Where we read the paper otherwise than it is printed."""
    intro, sections = read()
    tables = [f"## {title}\n\n{table(COLUMNS, entries)}" for title, entries in sections.items()]
    return page("Errata of the paper", intro, *tables)
