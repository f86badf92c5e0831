"""Searches of these tests are short: what they show does not need the last percent."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def few_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Random steps after the evolution."""
    monkeypatch.setattr("umbilical.synthesis.search.LOCAL_STEPS", 150)
