"""A page stands alone: nothing to load, nothing that runs, every name once, every element closed."""

from __future__ import annotations

from tests.support.pages import read


def test_every_element_is_closed(small_page: str) -> None:
    structure = read(small_page)
    assert (structure.open, structure.wrong) == ([], [])


def test_nothing_is_loaded_and_nothing_runs(small_page: str) -> None:
    assert read(small_page).loaded == []
    assert "@import" not in small_page
    assert " on" + "load=" not in small_page


def test_every_name_is_there_once_and_every_reference_leads_to_one(small_page: str) -> None:
    """Two drawings by matplotlib name their parts alike; on one page they must not."""
    structure = read(small_page)
    assert [name for name, count in structure.names.items() if count > 1] == []
    assert structure.referred - structure.names.keys() == set()
    assert any(name.startswith("two-") for name in structure.referred)


def test_a_page_fits_a_phone_and_the_dark(small_page: str) -> None:
    assert 'name="viewport" content="width=device-width, initial-scale=1"' in small_page
    assert "prefers-color-scheme: dark" in small_page
    assert "stroke: currentColor" in small_page
    assert "#000000" not in small_page


def test_drawings_say_what_they_are(small_page: str) -> None:
    assert small_page.count('role="img" aria-label="Picture') == 2


def test_what_is_wrong_is_noticed() -> None:
    bad = '<p><b>x</p><img src="https://a.b/c.png"><i id="a"></i><i id="a"></i><a href="#gone">x</a>'
    structure = read(bad)
    assert structure.wrong
    assert structure.loaded == ["img https://a.b/c.png"]
    assert structure.names["a"] == 2
    assert structure.referred == {"gone"}
