"""Tables: of anything, of a scenario's values, of runs and of versions."""

from __future__ import annotations

import platform
from collections.abc import Iterable, Iterator, Sequence
from importlib.metadata import version

from umbilical import __version__
from umbilical.report.html import Html, code, element, join, paragraph, prose
from umbilical.run import Run
from umbilical.scenario import Scenario
from umbilical.scenario.inventory import inventory

LONG = 60
"""Characters of a cell from which on it must not become narrow."""
PACKAGES = ("numpy", "scipy", "numba", "xarray", "h5netcdf", "h5py", "matplotlib")


def table(
    head: Sequence[str],
    rows: Iterable[Sequence[str]],
    *,
    caption: str = "",
    numbers: Sequence[int] = (),
    stacked: bool = False,
) -> Html:
    """A table in a box of its own, which scrolls where the page is narrow.

    Args:
        head: names of the columns.
        rows: cells; text is escaped, HTML is not.
        caption: what stands above.
        numbers: columns whose cells are numbers.
        stacked: whether a phone shows the cells of a row below each other, instead of scrolling.
    """
    top = element("thead", element("tr", *(element("th", cell, scope="col") for cell in head)))
    lines = [element("tr", *(_cell(cell, k in numbers) for k, cell in enumerate(row))) for row in rows]
    title = [paragraph(caption, class_="caption")] if caption else []
    inner = element("table", top, element("tbody", *lines))
    look = "scroll stacked" if stacked else "scroll"
    box = element("div", inner, class_=look, tabindex="0", role="region", aria_label=caption or head[0])
    return join([*title, box])


def _cell(content: str, number: bool) -> Html:
    """One cell; one with much to say claims some width, and its table scrolls where the page has less."""
    if number:
        return element("td", content, class_="number")
    return element("td", content, class_="long") if len(content) > LONG else element("td", content)


def given_table(scenario: Scenario, caption: str, keys: Sequence[str] = ()) -> Html:
    """Values that have a source: key, value, unit, meaning and where they stand there; only some ``keys`` if named."""
    rows = [
        (code(e.key), e.value, e.unit, e.meaning, e.source)
        for e in inventory(scenario, scenario.assumed)
        if e.source and not e.assumed and (not keys or e.key in keys)
    ]
    return table(("key", "value", "unit", "meaning", "source"), rows, caption=caption, numbers=(1,))


def assumed_table(scenarios: Iterable[Scenario], caption: str) -> Html:
    """Values that no source gives, each with the reason, of all scenarios; what is assumed to be absent, too.

    A row that an earlier scenario has is not repeated.
    """
    rows = list(dict.fromkeys(row for scenario in scenarios for row in _assumed(scenario)))
    before = ["", *(reason for *_, reason in rows)]
    cells = [
        (code(key), code(value) if value else "none", unit, meaning, "as above" if reason == last else prose(reason))
        for (key, value, unit, meaning, reason), last in zip(rows, before, strict=False)
    ]
    return table(("key", "value", "unit", "meaning", "why"), cells, caption=caption)


def _assumed(scenario: Scenario) -> Iterator[tuple[str, str, str, str, str]]:
    """Key, value, unit, meaning and reason of all that is assumed; no value where it is to be absent."""
    entries = [entry for entry in inventory(scenario, scenario.assumed) if entry.assumed]
    yield from ((e.key, e.value, e.unit, e.meaning, e.reason) for e in entries)
    for key, reason in scenario.assumed.items():
        if not any(f"{entry.key}.".startswith(f"{key}.") for entry in entries):
            yield key, "", "", "", reason


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
    from h5py.version import hdf5_version

    rows = [("umbilical", __version__), ("python", platform.python_version()), *((p, version(p)) for p in PACKAGES)]
    rows += [("HDF5", hdf5_version), ("machine", platform.machine())]
    return table(("package", "version"), rows, caption="Versions")
