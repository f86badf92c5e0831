"""Reports: one HTML file that opens from disk, on a phone, in the light and in the dark, with nothing to load.

``html`` makes safe pieces of HTML, ``page`` puts them on a page, ``tables`` shows scenarios and runs. Nothing here
knows which report it makes.
"""

from umbilical.report.html import Html, code, element, join, link, paragraph, prose
from umbilical.report.page import Section, drawing, page
from umbilical.report.tables import assumed_table, given_table, runs_table, table, versions_table

__all__ = [
    "Html",
    "Section",
    "assumed_table",
    "code",
    "drawing",
    "element",
    "given_table",
    "join",
    "link",
    "page",
    "paragraph",
    "prose",
    "runs_table",
    "table",
    "versions_table",
]
