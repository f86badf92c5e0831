"""One value decides the first line, the object and the exit code."""

from __future__ import annotations

import json
from typing import get_args

import pytest

from umbilical.cli.conclusion import conclude
from umbilical.cli.output import EXIT_CODES
from umbilical.faces.conclusion import Conclusion, Decision


@pytest.mark.parametrize("decision", get_args(Decision))
def test_line_object_and_exit_code_say_the_same(decision, capsys):
    found = Conclusion(decision, "headline")
    parts = {"text": lambda: "details", "document": lambda: {"number": 1.0}, "files": {"plot": "a.png"}}
    code = conclude(found, **parts, as_json=False)
    assert capsys.readouterr().out == "headline\ndetails\n  plot: a.png\n"
    assert conclude(found, **parts, as_json=True) == code
    document = json.loads(capsys.readouterr().out)
    assert document == {
        "verdict": decision, "headline": "headline", "exit_code": code, "files": {"plot": "a.png"}, "number": 1.0
    }  # fmt: skip
    assert code == (0 if decision in ("HOLDS", "NOT_ASKED") else 7)
    assert code in EXIT_CODES
