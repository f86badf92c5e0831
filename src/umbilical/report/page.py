"""A page: title, contents, sections, and drawings that follow the reader's light or dark."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache
from importlib import resources
from typing import NamedTuple

from umbilical.report.html import Html, element, join, link


class Section(NamedTuple):
    """A part of a page: the anchor it is found by, its heading, and what is in it."""

    anchor: str
    heading: str
    content: Html


def page(title: str, lead: Html, sections: Sequence[Section]) -> str:
    """A complete HTML document that needs nothing beside it.

    Args:
        title: of the document, also its first heading.
        lead: what stands before the contents.
        sections: the parts, in order.
    """
    head = element(
        "head",
        element("meta", charset="utf-8"),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
        element("link", rel="icon", href="data:,"),  # else a browser asks for one
        element("title", title),
        element("style", Html(_style())),
    )
    contents = element("nav", *(link(section.heading, f"#{section.anchor}") for section in sections))
    parts = [element("section", element("h2", s.heading), s.content, id=s.anchor) for s in sections]
    body = element("body", element("main", element("h1", title), lead, contents, *parts))
    return "<!DOCTYPE html>\n" + element("html", head, body, lang="en") + "\n"


def drawing(svg: bytes, name: str, title: str, caption: str, files: Sequence[str] = ()) -> Html:
    """An SVG picture inline, with its caption and links to files beside the page.

    Args:
        svg: as matplotlib writes it, without a background.
        name: anchor; keeps the picture's own names apart from those of others on the page.
        title, caption: what it is, and what is seen.
        files: names of files that hold it or its data.
    """
    links = join([link(file.rpartition(".")[2].upper(), file) for file in files], " ")
    words = element("figcaption", element("b", title), ". ", caption, " ", links)
    return element("figure", inline_svg(svg, name, f"{title}. {caption}"), words, id=name)


def inline_svg(svg: bytes, name: str, words: str) -> Html:
    """The SVG element alone, its names made unique, its black the text's colour, described for those who cannot see."""
    text = svg.decode()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>\s*", "", text, flags=re.DOTALL)
    text = re.sub(r'\bid="([^"]+)"', rf'id="{name}-\1"', text)
    text = re.sub(r'href="#([^"]+)"', rf'href="#{name}-\1"', text)
    text = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", text)
    text = re.sub(r"(stroke|fill): #000000", r"\1: currentColor", text)
    described = element("svg", role="img", aria_label=words).removesuffix("></svg>")
    return Html(text.replace("<svg", described, 1))


@lru_cache(maxsize=1)
def _style() -> str:
    return (resources.files("umbilical.report") / "style.css").read_text(encoding="utf-8")
