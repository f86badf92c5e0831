"""The report of a reproduction: what was run, the ledger, the figures, the assumptions, the errata, the versions."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from hashlib import sha256

from umbilical import load
from umbilical.papers.rao2022.errata import COLUMNS, errata
from umbilical.papers.rao2022.expected import Deviation
from umbilical.papers.rao2022.experiments import EXPERIMENTS, Runs, cell
from umbilical.papers.rao2022.figures import DOI, SOURCE, Picture
from umbilical.papers.rao2022.ledger import Finding, Verdict
from umbilical.papers.rao2022.maps import GRID
from umbilical.papers.rao2022.reproduction import KINDS, Reproduction
from umbilical.report import (
    Html,
    Section,
    assumed_table,
    code,
    drawing,
    element,
    given_table,
    join,
    link,
    page,
    paragraph,
    prose,
    runs_table,
    table,
    versions_table,
)

HASH = 16
"""Digits of the hash of a file that are shown."""
CLASSES = dict(zip(Verdict, ("holds", "part", "fails"), strict=True))


def article(found: Reproduction, moved: list[Deviation]) -> str:
    """The report as one HTML document.

    Args:
        found: the reproduction, with its ledger.
        moved: what is not as published.
    """
    sections = (
        Section("ledger", "Claims", _ledger(found)),
        Section("figures", "Figures", _figures(found)),
        Section("given", "What the paper gives", _given(found.runs)),
        Section("assumed", "What is assumed", _assumed(found.runs)),
        Section("runs", "What was run", _runs(found.runs)),
        Section("errata", "Errata", _errata()),
        Section("versions", "Versions", join([versions_table(), _hashes(found)])),
    )
    title = "Vibration cascade control of a cable and its ROV: the paper, reproduced"
    return page(title, join(_lead(found, moved)), sections)


def _lead(found: Reproduction, moved: list[Deviation]) -> Iterator[Html]:
    holds, part, fails = (sum(f.verdict is verdict for f in found.findings) for verdict in Verdict)
    made = ". Made by ", element("code", "umbilical reproduce"), "; every number and every verdict is computed."
    yield paragraph("Of ", SOURCE.removesuffix(DOI), link(DOI, f"https://doi.org/{DOI}"), *made)
    told = f"{holds} hold, {part} under a condition; not reproduced: {fails}."
    check = "Every number is as published, within its tolerance." if not moved else "Not as published:"
    yield paragraph(f"Of {len(found.findings)} statements {told} {check}")
    if moved:
        yield element("ul", *(element("li", str(one)) for one in moved))
    if not found.mapped:
        yield paragraph("The maps were left out (--no-maps).")


def _ledger(found: Reproduction) -> Html:
    rows = [(link(f.id, f"#{f.id}"), f.statement, _verdict(f)) for f in found.findings]
    ledger = table(("claim", "statement", "verdict"), rows, caption="The ledger", stacked=True)
    pictures = [one.picture for one in found.shown]
    return join([ledger, *(_claim(finding, pictures) for finding in found.findings)])


def _verdict(finding: Finding) -> Html:
    return element("span", finding.conclusion, class_=f"verdict {CLASSES[finding.verdict]}")


def _claim(finding: Finding, shown: Iterable[Picture]) -> Html:
    """One claim; its figures are linked where they are on the page."""
    rows = [(n.meaning, f"{n.value:.4g}", "" if n.unit == "1" else n.unit) for n in finding.numbers]
    links = [link(one.title, f"#{one.name}") for one in shown if finding.id in one.claims.split()]
    numbers = table(("number", "value", "unit"), rows, numbers=(1,))
    return element(
        "article",
        element("h3", f"{finding.id}. {finding.statement}"),
        paragraph("Verdict: ", _verdict(finding), ". ", finding.because),
        paragraph(element("b", "Where. "), finding.region),
        paragraph(element("b", "Measure. "), finding.measure, class_="quiet"),
        *([paragraph(element("b", "Figures. "), join(links, ", "), class_="quiet")] if links else []),
        element("details", element("summary", f"{len(rows)} numbers"), numbers),
        class_="claim",
        id=finding.id,
    )


def _figures(found: Reproduction) -> Html:
    coarse = (
        f"Maps run on {GRID['grid.elements']} elements, figures and all other numbers on the grid of their preset; the "
        "tests compare both."
    )
    drawn = (
        drawing(svg, one.name, one.title, one.caption, [f"{one.name}.{kind}" for kind in KINDS])
        for one, _, _, svg in found.shown
    )
    return join([paragraph(coarse, class_="quiet"), element("div", *drawn, class_="figures")])


def _given(runs: Runs) -> Html:
    gains = ("control.law.position_gain", "control.law.velocity_gain")
    plant, pd, fault = (runs[name].scenario for name in (cell("none", "without"), "pd", cell("stuck", "with")))
    return join(
        [
            given_table(plant, "Table 2 and section 4 of the paper, with our correction of units"),
            given_table(pd, "Gains of the PD baseline", gains),
            given_table(fault, "The fault", ("faults.1.start",)),
        ]
    )


def _assumed(runs: Runs) -> Html:
    names = dict.fromkeys(EXPERIMENTS[name].preset for name in runs)
    words = paragraph(
        "What the paper does not print had to be chosen. The reasons are those of the presets: "
        f"{', '.join(names)}. A later one is named only with what it adds."
    )
    return join([words, assumed_table(map(load, names), "Assumed, in all presets that were run")])


def _runs(runs: Runs) -> Html:
    rows = [
        (one.what, one.preset, ", ".join(f"{key} = {json.dumps(value)}" for key, value in one.changes.items()), run)
        for one, run in ((EXPERIMENTS[name], run) for name, run in runs.items())
    ]
    return runs_table(rows, "Experiments; an empty column of changes means the preset as it is")


def _hashes(found: Reproduction) -> Html:
    rows = [(f"{one.picture.name}.nc", code(sha256(one.contents["nc"]).hexdigest()[:HASH])) for one in found.shown]
    words = f"The first {HASH} digits of SHA-256; the same versions and scenarios give the same data, on any day"
    return table(("file", "hash"), rows, caption=f"The data. {words}")


def _errata() -> Html:
    intro, sections = errata()
    tables = [
        table(COLUMNS, [tuple(map(prose, entry)) for entry in found], caption=title)
        for title, found in sections.items()
    ]
    return join([*(paragraph(prose(part)) for part in intro.split("\n\n")), *tables])
