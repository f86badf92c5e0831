"""Pieces of HTML: what goes in as text comes out as text."""

from __future__ import annotations

import pytest

from umbilical.report import Html, element, join, link, paragraph, prose, table

HOSTILE = '<script>alert("x")</script> & \' "'


def test_text_stays_text() -> None:
    for made in (paragraph(HOSTILE), element("td", HOSTILE), prose(HOSTILE), join([HOSTILE]), link(HOSTILE, "#a")):
        assert "<script>" not in made
        assert "&lt;script&gt;" in made
        assert "&amp;" in made


def test_attributes_cannot_be_left() -> None:
    made = element("p", "x", title='" onclick="y', class_="a", aria_label="b")
    assert made == '<p title="&quot; onclick=&quot;y" class="a" aria-label="b">x</p>'


def test_html_is_not_escaped_again() -> None:
    assert paragraph(element("b", "a < b")) == "<p><b>a &lt; b</b></p>"


def test_prose_knows_code_emphasis_and_links() -> None:
    made = prose("a `x < l` *not* **b** [here](https://doi.org/1)")
    assert made == 'a <code>x &lt; l</code> <em>not</em> **b** <a href="https://doi.org/1">here</a>'


@pytest.mark.parametrize("address", ["javascript:alert(1)", " JavaScript:x", "data:text/html,x"])
def test_a_link_that_runs_something_is_refused(address: str) -> None:
    with pytest.raises(ValueError, match="not a link"):
        link("x", address)


def test_a_table_scrolls_in_its_own_box_and_escapes_its_cells() -> None:
    made = table(("name", "value"), [(HOSTILE, "1"), (Html("<b>2</b>"), "2")], caption="what", numbers=(1,))
    assert made.startswith(
        '<p class="caption">what</p><div class="scroll" tabindex="0" role="region" aria-label="what">'
    )
    assert '<td class="number">1</td>' in made
    assert "<b>2</b>" in made
    assert "<script>" not in made
