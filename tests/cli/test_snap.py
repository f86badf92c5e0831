"""`umbilical snap`: first line and exit code follow from one verdict."""

from __future__ import annotations

import pytest

SHORT = ("snap", "work-class-3000m", "--seeds", "2", "--set", "duration=20", "--set", "rope.elements=4")


@pytest.mark.parametrize(("risk", "code", "word"), [("1.0", 0, "within"), ("0.001", 7, "more seeds are needed")])
def test_the_accepted_risk_is_judged(umbilical, risk, code, word):
    done = umbilical(*SHORT, "--risk", risk)
    assert done.code == code
    assert word in done.out.splitlines()[0]
    assert "2 seeds of 20 s, roughly" in done.err


def test_a_string_is_refused(umbilical):
    done = umbilical("snap", "paper")
    assert done.code == 2
    assert 'model = "string"' in done.err
