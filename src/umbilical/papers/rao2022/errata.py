"""Where we read the paper otherwise than it is printed."""

from __future__ import annotations

from umbilical.papers.rao2022.experiments import read_data

COLUMNS = ("where", "printed", "ours", "why")
"""Where it stands, what is printed, what we read, and why; with `code` as Markdown writes it."""


def errata() -> tuple[str, dict[str, list[tuple[str, ...]]]]:
    """The introduction, and the errata by section, each with an entry for every column."""
    data = read_data("errata.toml")
    sections = {
        one["title"]: [tuple(entry[key] for key in COLUMNS) for entry in one["entries"]] for one in data["sections"]
    }
    return data["intro"].strip(), sections
