"""The structure of an HTML page, read by a parser that knows nothing of ours."""

from __future__ import annotations

import re
from collections import Counter
from html.parser import HTMLParser

VOID = {"meta", "link", "br", "hr", "img"}


class Structure(HTMLParser):
    """Elements that are open, names, what is referred to, and what would be loaded or run."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.wrong: list[str] = []
        self.names: Counter[str] = Counter()
        self.referred: set[str] = set()
        self.loaded: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = {name: value or "" for name, value in attrs}
        if "id" in found:
            self.names[found["id"]] += 1
        for name in ("href", "xlink:href"):
            if found.get(name, "").startswith("#"):
                self.referred.add(found[name][1:])
        self.referred |= set(re.findall(r"url\(#([^)]+)\)", " ".join(found.values())))
        loads = found.get("src", "") or (found.get("href", "") if tag == "link" else "")
        if tag in ("script", "iframe", "object") or (loads and not loads.startswith("data:")):
            self.loaded.append(f"{tag} {loads}")
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


def read(page: str) -> Structure:
    structure = Structure()
    structure.feed(page)
    structure.close()
    return structure
