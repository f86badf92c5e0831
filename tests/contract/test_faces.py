"""Every result shows itself in the same four ways; the command line prints what they give."""

from __future__ import annotations

from importlib import import_module

import pytest

import umbilical
from umbilical import plots
from umbilical.analysis.certificate import Certificate
from umbilical.design.design import Design
from umbilical.design.margins import MarginReport
from umbilical.reproduce.reproduction import Reproduction
from umbilical.result import ResultFaces
from umbilical.run import Run
from umbilical.screening.lower import Lowering
from umbilical.screening.operate import Operability
from umbilical.screening.weather import Weather
from umbilical.studies.results import StudyResult
from umbilical.studies.tune import Tuned
from umbilical.verify import Verification

RESULTS = (
    Run, Certificate, MarginReport, Design, StudyResult, Tuned, Verification, Reproduction, Operability, Lowering,
    Weather,
)  # fmt: skip


@pytest.mark.parametrize("kind", RESULTS)
def test_each_result_has_them(kind: type) -> None:
    for name in ("summary", "to_dict", "plot", "_repr_html_"):
        assert callable(getattr(kind, name, None)), f"{kind.__name__} has no {name}"
    if "to_dict" not in vars(kind) and issubclass(kind, ResultFaces):
        module = import_module(kind.shown_by)
        assert all(callable(getattr(module, name)) for name in ("conclusion", "text", "document"))
    if "plot" not in vars(kind) and issubclass(kind, ResultFaces):
        assert callable(getattr(plots, kind.drawn_by))


def test_they_say_what_the_command_says(capsys: pytest.CaptureFixture[str]) -> None:
    from umbilical.cli import main

    report = umbilical.margins(umbilical.load("ringdown"))
    assert main(["margins", "ringdown", "--grid", "0"]) == 0
    assert capsys.readouterr().out.rstrip() == report.summary().rstrip()
    assert report.to_dict()["verdict"] == "HOLDS"
    assert report._repr_html_().startswith("<details><summary><b>ringdown: stable")
    assert report.plot().axes


def test_a_certificate_that_does_not_hold_says_so_first() -> None:
    found = umbilical.certify(umbilical.load("paper"), cure=False)
    assert found.summary().startswith("paper: not certified")
    assert found.to_dict()["exit_code"] == 7
    assert "not certified" in found._repr_html_()


def test_a_run() -> None:
    run = umbilical.simulate(umbilical.load("crosscheck-none", {"duration": 1.0}))
    assert run.to_dict()["metrics"] == run.metrics
    assert run.plot().axes
