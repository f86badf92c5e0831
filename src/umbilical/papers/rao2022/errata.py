"""Where we read the paper otherwise than it is printed."""

from __future__ import annotations

import tomllib
from functools import lru_cache
from importlib import resources
from typing import NamedTuple


class Erratum(NamedTuple):
    """Where it stands, what is printed, what we read, and why; with `code` as Markdown writes it."""

    where: str
    printed: str
    ours: str
    why: str


@lru_cache(maxsize=1)
def errata() -> tuple[str, dict[str, tuple[Erratum, ...]]]:
    """The introduction, and the errata by section."""
    text = (resources.files("umbilical.papers.rao2022") / "errata.toml").read_text(encoding="utf-8")
    data = tomllib.loads(text)
    sections = {
        section["title"]: tuple(Erratum(**entry) for entry in section["entries"]) for section in data["sections"]
    }
    return data["intro"].strip(), sections
