"""Pieces of HTML that cannot be wrong: text is escaped, and what is HTML already says so by its type."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape

_VOID = ("meta", "br", "hr", "img", "link")


class Html(str):
    """Text that is HTML already. Everything else is escaped when it gets into an element."""

    __slots__ = ()


def safe(piece: str) -> Html:
    """The piece itself if it is HTML, else its text escaped.

    >>> safe("a < b")
    'a &lt; b'
    """
    return piece if isinstance(piece, Html) else Html(escape(piece, quote=False))


def join(pieces: Iterable[str], between: str = "") -> Html:
    """Pieces one after the other."""
    return Html(safe(between).join(safe(piece) for piece in pieces))


def element(tag: str, *content: str, **attributes: str) -> Html:
    """An element; a trailing ``_`` of an attribute's name is dropped, another becomes ``-``.

    >>> element("p", "2 < 3", class_="note")
    '<p class="note">2 &lt; 3</p>'
    """
    named = "".join(f' {name.rstrip("_").replace("_", "-")}="{escape(value)}"' for name, value in attributes.items())
    if tag in _VOID:
        return Html(f"<{tag}{named}>")
    return Html(f"<{tag}{named}>{join(content)}</{tag}>")


def paragraph(*content: str, **attributes: str) -> Html:
    """A paragraph."""
    return element("p", *content, **attributes)


def code(text: str) -> Html:
    """Text as code."""
    return element("code", text)


def link(text: str, to: str) -> Html:
    """A link; only to the web, to a file beside the page, or to a place on it.

    >>> link("data", "fig3.nc")
    '<a href="fig3.nc">data</a>'
    """
    if re.match(r"^\s*(javascript|data|vbscript):", to, flags=re.IGNORECASE):
        raise ValueError(f"{to}: not a link for a report")
    return element("a", text, href=to)


def prose(text: str) -> Html:
    """A line of text with `code`, *emphasis* and [links](https://...), as Markdown writes them.

    >>> prose("`x < l` is *inside*")
    '<code>x &lt; l</code> is <em>inside</em>'
    """
    pattern = re.compile(r"`([^`]+)`|(?<![\w*])\*([^*\s][^*]*)\*|\[([^\]]+)\]\((https://[^)\s]+)\)")
    pieces: list[str] = []
    at = 0
    for found in pattern.finditer(text):
        pieces.append(text[at : found.start()])
        of_code, stressed, words, address = found.groups()
        if of_code:
            pieces.append(code(of_code))
        elif stressed:
            pieces.append(element("em", stressed))
        else:
            pieces.append(link(words, address))
        at = found.end()
    return join([*pieces, text[at:]])
