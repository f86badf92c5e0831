"""A page with everything a page can have."""

from __future__ import annotations

import pytest

from umbilical.plots.figure import new_figure, render
from umbilical.report import Section, drawing, join, page, paragraph, table


@pytest.fixture(scope="session")
def small_page() -> str:
    figure = new_figure(3.0, 2.0)
    axes = figure.add_subplot()
    axes.plot([0.0, 1.0], [0.0, 1.0], color="#000000", label="$x_1$")
    axes.legend()
    svg = render(figure, "svg")
    drawn = join([drawing(svg, name, f"Picture {name}", "a line", [f"{name}.nc"]) for name in ("one", "two")])
    wide = table([f"column {k}" for k in range(30)], [["0123456789"] * 30], caption="wide")
    return page("A page", paragraph("Lead."), [Section("a", "First", drawn), Section("b", "Second", wide)])
