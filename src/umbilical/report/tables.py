"""Tables: of anything, of a scenario's values, of runs and of versions."""

from __future__ import annotations

import platform
from collections.abc import Iterable, Sequence
from importlib.metadata import version

from umbilical import __version__
from umbilical.report.html import Html, code, element, prose
from umbilical.run import Run
from umbilical.scenario import Scenario
from umbilical.scenario.inventory import inventory

LONG = 60
"""Characters of a cell from which on it must not become narrow."""
PACKAGES = ("numpy", "scipy", "numba", "xarray", "matplotlib")


def table(
    head: Sequence[str], rows: Iterable[Sequence[str]], *, caption: str = "", numbers: Sequence[int] = ()
) -> Html:
    """A table in a box of its own, which scrolls where the page is narrow.

    Args:
        head: names of the columns.
        rows: cells; text is escaped, HTML is not.
        caption: what stands above.
        numbers: columns whose cells are numbers.
    """
    top = element("thead", element("tr", *(element("th", cell, scope="col") for cell in head)))
    lines = [element("tr", *(_cell(cell, k in numbers) for k, cell in enumerate(row))) for row in rows]
    title = [element("caption", caption)] if caption else []
    inner = element("table", *title, top, element("tbody", *lines))
    return element("div", inner, class_="scroll", tabindex="0", role="region", aria_label=caption or head[0])


def _cell(content: str, number: bool) -> Html:
    """One cell; one with much to say claims some width, and its table scrolls where the page has less."""
    if number:
        return element("td", content, class_="number")
    return element("td", content, class_="long") if len(content) > LONG else element("td", content)


def given_table(scenario: Scenario, caption: str, keys: Sequence[str] = ()) -> Html:
    """Values that have a source: key, value, unit, meaning and where they stand there; only some ``keys`` if named."""
    rows = [
        (code(e.key), e.value, e.unit, e.meaning, e.source)
        for e in inventory(scenario)
        if e.source and not e.assumed and (not keys or e.key in keys)
    ]
    return table(("key", "value", "unit", "meaning", "source"), rows, caption=caption, numbers=(1,))


def assumed_table(scenario: Scenario, caption: str) -> Html:
    """Values that no source gives, each with the reason; what is assumed to be absent, too."""
    entries = [entry for entry in inventory(scenario) if entry.assumed]
    told = {entry.key for entry, before in zip(entries[1:], entries[:-1], strict=True) if entry.reason == before.reason}
    rows = [
        (code(e.key), code(e.value), e.unit, e.meaning, "as above" if e.key in told else prose(e.reason))
        for e in entries
    ]
    rows += [
        (code(key), "none", "", "", prose(reason))
        for key, reason in scenario.assumed.items()
        if not any(f"{entry.key}.".startswith(f"{key}.") for entry in entries)
    ]
    return table(("key", "value", "unit", "meaning", "why"), rows, caption=caption)


def runs_table(rows: Iterable[tuple[str, str, str, Run]], caption: str) -> Html:
    """Runs by what they are, their preset and its changes, how they ended, and their scenario's hash."""
    cells = [
        (
            what,
            code(preset),
            code(changes) if changes else "",
            f"{run.status.name}, {run.end_time:.4g} s",
            code(run.scenario.hash[:12]),
        )
        for what, preset, changes, run in rows
    ]
    return table(("what", "preset", "changes", "ended", "scenario"), cells, caption=caption)


def versions_table() -> Html:
    """What the numbers were made with."""
    rows = [("umbilical", __version__), ("python", platform.python_version()), *((p, version(p)) for p in PACKAGES)]
    rows.append(("machine", platform.machine()))
    return table(("package", "version"), rows, caption="Versions")
