"""One value decides the first line, the object and the exit code."""

from __future__ import annotations

import json
from typing import get_args

import pytest

from umbilical.cli.output import EXIT_CODES, conclude
from umbilical.faces.conclusion import Conclusion, Decision, Face
from umbilical.result import ResultFaces


@pytest.mark.parametrize("decision", get_args(Decision))
def test_line_object_and_exit_code_say_the_same(decision, capsys):
    class Found(ResultFaces):
        face = Face(  # pyright: ignore[reportAssignmentType]
            lambda _: Conclusion(decision, "headline"), lambda _: "details", lambda _: {"number": 1.0}
        )

    code = conclude(Found(), files={"plot": "a.png"}, as_json=False)
    assert capsys.readouterr().out == "headline\ndetails\n  plot: a.png\n"
    assert conclude(Found(), files={"plot": "a.png"}, as_json=True) == code
    document = json.loads(capsys.readouterr().out)
    assert document == {
        "verdict": decision, "headline": "headline", "exit_code": code, "files": {"plot": "a.png"}, "number": 1.0
    }  # fmt: skip
    assert code == (0 if decision in ("HOLDS", "NOT_ASKED") else 7)
    assert code in EXIT_CODES
