"""The report: every claim, figure, given and assumed value, erratum and version is on it, and it stands alone."""

from __future__ import annotations

import html
from hashlib import sha256

import pytest

from tests.support.pages import read
from umbilical.library import load
from umbilical.papers.rao2022.article import article
from umbilical.papers.rao2022.errata import errata
from umbilical.papers.rao2022.expected import Deviation
from umbilical.papers.rao2022.experiments import EXPERIMENTS, Runs
from umbilical.papers.rao2022.figures import PICTURES
from umbilical.papers.rao2022.ledger import Finding
from umbilical.papers.rao2022.reproduction import Reproduction, show_pictures


@pytest.fixture(scope="module")
def found(runs: Runs, findings: tuple[Finding, ...]) -> Reproduction:
    """With two of the figures."""
    return Reproduction(runs, {}, show_pictures([PICTURES["fig4"], PICTURES["fig9"]], runs, {}), findings)


@pytest.fixture(scope="module")
def report(found: Reproduction) -> str:
    return article(found, [])


def words(page: str) -> str:
    return html.unescape(page).replace("\u00a0", " ")


def test_it_stands_alone(report: str) -> None:
    structure = read(report)
    assert (structure.open, structure.wrong, structure.loaded) == ([], [], [])
    assert [name for name, count in structure.names.items() if count > 1] == []
    assert structure.referred - structure.names.keys() == set()


def test_every_claim_with_its_verdict_and_numbers(report: str, findings: tuple[Finding, ...]) -> None:
    text = words(report)
    for finding in findings:
        assert f'id="{finding.id}"' in report
        for part in (finding.statement, finding.conclusion, finding.because, finding.region, finding.measure):
            assert part in text
        for number in finding.numbers:
            assert number.meaning in text
            assert f"{number.value:.4g}" in text


def test_every_assumed_value_with_its_reason_and_every_run_with_its_hash(report: str, found: Reproduction) -> None:
    text = words(report)
    for name in {EXPERIMENTS[name].preset for name in found.runs}:
        for reason in load(name).assumed.values():
            assert reason in text.replace("<code>", "").replace("</code>", ""), name
    for run in found.runs.values():
        assert run.scenario.hash[:12] in report


def test_table_2_of_the_paper(report: str) -> None:
    """Values as the paper prints them, from the scenario's own words."""
    for row in (
        ("cable.line_density", "2.0", "kg/m", "line density of the cable", "Table 2"),
        ("payload.mass", "500.0", "kg", "mass of the ROV", "Table 2"),
        ("motors.1.inductance", "0.002", "H", "armature inductance", "(15)"),
        ("control.law.position_gain", "100.0", "N/m", "PD position gain", "(66)"),
        ("faults.1.start", "10.0", "s"),
    ):
        key, value, *rest = row
        cells = f'<td><code>{key}</code></td><td class="number">{value}</td>' + "".join(f"<td>{c}</td>" for c in rest)
        assert cells in report


def test_every_erratum(report: str) -> None:
    _, sections = errata()
    count = sum(map(len, sections.values()))
    assert count > 25
    section = report.partition('id="errata"')[2].partition('id="versions"')[0]
    assert section.count("<tr>") == count + len(sections)


def test_what_has_moved_stands_first(found: Reproduction) -> None:
    moved = [Deviation("C1.tip_peak", "11 m", "10.8", "0.11 off")]
    head = article(found, moved).partition("<nav>")[0]
    assert "Not as published" in head
    assert "C1.tip_peak: 11 m, published 10.8, allowed 0.11 off" in head
    assert "as published, within" in article(found, []).partition("<nav>")[0]


def test_versions_and_the_hash_of_every_file_of_data(report: str, found: Reproduction) -> None:
    section = report.partition('id="versions"')[2]
    for package in ("numpy", "h5netcdf", "h5py", "HDF5", "matplotlib"):
        assert f"<td>{package}</td>" in section
    for one in found.shown:
        assert sha256(one.contents["nc"]).hexdigest()[:16] in section


def test_claims_lead_to_their_figures_and_the_paper_is_linked(report: str, findings: tuple[Finding, ...]) -> None:
    """Only to figures that are on the page; every claim has one somewhere."""
    assert '<a href="https://doi.org/10.3390/jmse10111772">' in report
    assert {finding.id for finding in findings} == {c for picture in PICTURES.values() for c in picture.claims.split()}
    claim = report.partition('id="C4"')[2].partition("</article>")[0]
    assert '<a href="#fig4">Fig. 4</a>' in claim
    assert '<a href="#fig3">' not in report
