"""Searches of the default tests are short: what they show does not need the last percent. The slow ones are whole."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def few_steps(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Random steps after the evolution."""
    if "slow" not in request.keywords:
        monkeypatch.setattr("umbilical.synthesis.search.LOCAL_STEPS", 150)
