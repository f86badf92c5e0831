"""A page in a real browser: silent, as wide as the window, light and dark. Skipped, and so reported, without one."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support import browser

pytestmark = [
    pytest.mark.slow,
    pytest.mark.browser,
    pytest.mark.skipif(browser.PROGRAM is None, reason="no Chromium on this machine"),
]
PHONE, DESK = 360, 1280


@pytest.fixture
def stored(small_page: str, tmp_path: Path) -> Path:
    path = tmp_path / "page.html"
    path.write_text(small_page, encoding="utf-8")
    return path


def test_the_console_is_silent(stored: Path) -> None:
    assert browser.console(stored) == []


def test_an_error_on_a_page_is_heard(stored: Path) -> None:
    stored.write_text(stored.read_text(encoding="utf-8").replace("</body>", "<script>lost()</script></body>"))
    assert any("lost is not defined" in line for line in browser.console(stored))


@pytest.mark.parametrize("window", [PHONE, DESK])
def test_the_page_is_no_wider_than_the_window(stored: Path, window: int) -> None:
    """The wide table scrolls in its own box."""
    assert browser.width(stored, window) <= window


def test_a_page_that_is_too_wide_is_noticed(stored: Path) -> None:
    stored.write_text(stored.read_text(encoding="utf-8").replace("overflow-x: auto", "overflow-x: visible"))
    assert browser.width(stored, PHONE) > PHONE


def test_light_and_dark_differ(stored: Path, tmp_path: Path) -> None:
    light = browser.screenshot(stored, tmp_path / "light.png", DESK)
    assert light.startswith(b"\x89PNG")
    assert light != browser.screenshot(stored, tmp_path / "dark.png", DESK, dark=True)
