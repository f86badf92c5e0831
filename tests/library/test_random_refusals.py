"""Random scenarios that break a rule are refused before the first step, with a message that names the key."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings

from tests.support.random_scenarios import few, inadmissible
from umbilical.errors import ScenarioError
from umbilical.library import load


@settings(few, max_examples=150)
@given(inadmissible)
def test_the_message_names_the_key(broken: tuple[dict[str, Any], tuple[str, ...]]) -> None:
    overrides, keys = broken
    with pytest.raises(ScenarioError) as caught:
        load("paper", overrides)
    named = {problem.key for problem in caught.value.problems}
    assert named & set(keys), f"{keys} not among {sorted(named)}"
    for key in named & set(keys):
        assert f"{key} = " in str(caught.value)
