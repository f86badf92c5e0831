"""``umbilical reproduce``: what it writes, what it refuses, and when it says that a number has moved."""

from __future__ import annotations

import json

import pytest
import xarray

from tests.support import browser
from umbilical.papers.rao2022 import expected, reproduction
from umbilical.papers.rao2022.article import article


def test_some_figures_with_their_data(umbilical, tmp_path) -> None:
    outcome = umbilical("reproduce", "fig9", "fig5", "--out", tmp_path / "figures", "--json")
    assert outcome.code == 0
    document = outcome.document()
    assert document["claims"] == []
    assert (document["verdict"], document["headline"]) == ("NOT_ASKED", "reproduced: 2 figures")
    assert list(document["files"]["figures"]) == ["fig9", "fig5"]
    names = {f"{name}.{kind}" for name in ("fig5", "fig9") for kind in reproduction.KINDS}
    assert {path.name for path in (tmp_path / "figures").iterdir()} == names
    with xarray.open_dataset(tmp_path / "figures" / "fig9.nc") as data:
        assert data["disturbance"].attrs["units"] == "N"
        assert "10.3390/jmse10111772" in data.attrs["source"]


def test_an_unknown_figure_is_refused_with_the_known_ones(umbilical, tmp_path) -> None:
    outcome = umbilical("reproduce", "fig3", "fig99", "kapa", "--out", tmp_path / "x")
    assert outcome.code == 2
    assert "fig99, kapa" in outcome.err
    assert "map-rates" in outcome.err
    assert not (tmp_path / "x").exists()


def test_nothing_is_replaced_unasked_and_nothing_is_run_for_it(umbilical, tmp_path, monkeypatch) -> None:
    (tmp_path / "fig5.csv").write_text("mine")
    monkeypatch.setattr(reproduction, "reproduce", lambda *_, **__: pytest.fail("it ran"))
    outcome = umbilical("reproduce", "fig5", "--out", tmp_path)
    assert outcome.code == 4
    assert "fig5.csv" in outcome.err
    assert (tmp_path / "fig5.csv").read_text() == "mine"


def test_folders_on_the_way_are_made_and_a_figure_named_twice_is_made_once(umbilical, tmp_path) -> None:
    outcome = umbilical("reproduce", "fig5", "fig5", "--out", tmp_path / "a" / "b", "--json")
    assert outcome.code == 0
    assert len(list((tmp_path / "a" / "b").iterdir())) == len(reproduction.KINDS)


def test_a_folder_that_cannot_be_made_is_said(umbilical, tmp_path) -> None:
    (tmp_path / "file").write_text("")
    outcome = umbilical("reproduce", "fig5", "--out", tmp_path / "file" / "b")
    assert outcome.code == 4
    assert "cannot be made" in outcome.err


@pytest.mark.parametrize(
    ("words", "why"),
    [(("map-time", "--no-maps"), "leaves maps out"), (("fig5", "--check"), "hold no published number")],
)
def test_what_would_do_nothing_is_refused(umbilical, tmp_path, words: tuple[str, str], why: str) -> None:
    outcome = umbilical("reproduce", *words, "--out", tmp_path / "x")
    assert outcome.code == 2
    assert why in " ".join(outcome.err.split())
    assert not (tmp_path / "x").exists()


@pytest.mark.slow
def test_the_whole_without_maps(umbilical, tmp_path, monkeypatch) -> None:
    """All figures and the report, which a browser shows in silence; --check is content until a number moves."""
    outcome = umbilical("reproduce", "--no-maps", "--check", "--out", tmp_path / "paper", "--json")
    assert (outcome.code, outcome.err) == (0, "")
    document = outcome.document()
    assert {claim["id"] for claim in document["claims"]} >= {"C1", "C9", "A3"}
    assert document["not_as_published"] == []
    assert document["verdict"] == "HOLDS"
    report = tmp_path / "paper" / "report.html"
    assert report.read_text(encoding="utf-8").count("<svg") == len(reproduction.choose([], maps=False))

    moved = json.loads(json.dumps(expected.published()))
    moved["C1"]["tip_peak"]["value"] *= 1.1
    monkeypatch.setattr(expected, "published", lambda: moved)
    outcome = umbilical("reproduce", "--no-maps", "--check", "--out", tmp_path / "paper", "--force")
    assert outcome.code == 7
    assert "not as published: C1.tip_peak" in outcome.err
    assert "1 number or verdict is NOT as published" in outcome.out.splitlines()[0]
    assert "C1.tip_peak" in report.read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.browser
@pytest.mark.skipif(browser.PROGRAM is None, reason="no Chromium on this machine")
def test_a_browser_shows_the_report_in_silence(tmp_path) -> None:
    """With the maps, at the widths of a phone, a tablet and a desk."""
    found = reproduction.reproduce()
    report = tmp_path / "report.html"
    report.write_text(article(found, []), encoding="utf-8")
    assert browser.console(report) == []
    for window in (360, 500, 1280):
        assert browser.width(report, window) <= window
    assert browser.screenshot(report, tmp_path / "report.png", 500, dark=True).startswith(b"\x89PNG")
