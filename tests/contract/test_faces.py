"""Every result shows itself in the same four ways; the command line prints what they give."""

from __future__ import annotations

from importlib import import_module

import pytest

import umbilical
import umbilical.errors
from umbilical import plots
from umbilical.analysis.comparison import Comparison
from umbilical.certificate import Certificate
from umbilical.faces.conclusion import Face
from umbilical.papers.rao2022.reproduction import Reproduction
from umbilical.result import ResultFaces
from umbilical.run import Run
from umbilical.screening.lower import Lowering
from umbilical.screening.operate import Operability
from umbilical.screening.weather import Weather
from umbilical.stability.margins import MarginReport
from umbilical.studies.results import StudyResult
from umbilical.studies.tune import Tuned
from umbilical.synthesis.design import Design
from umbilical.verify import Verification

RESULTS = (
    Run, Certificate, MarginReport, Design, StudyResult, Tuned, Verification, Reproduction, Operability, Lowering,
    Weather, Comparison,
)  # fmt: skip


@pytest.mark.parametrize("kind", RESULTS)
def test_each_result_has_them(kind: type) -> None:
    for name in ("summary", "to_dict", "plot", "_repr_html_"):
        assert callable(getattr(kind, name, None)), f"{kind.__name__} has no {name}"
    if issubclass(kind, ResultFaces) and kind is not Run:
        assert isinstance(import_module(kind.shown_by).FACE, Face)
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
    found = umbilical.certify(umbilical.load("paper"), fix=False)
    assert found.summary().startswith("paper: not certified")
    assert found.to_dict()["exit_code"] == 7
    assert "not certified" in found._repr_html_()


def test_a_run() -> None:
    run = umbilical.simulate(umbilical.load("crosscheck-none", {"duration": 1.0}))
    assert run.to_dict()["metrics"] == run.metrics
    assert run.plot().axes


def test_a_comparison_has_the_numbers_of_its_runs(tmp_path, capsys: pytest.CaptureFixture[str]) -> None:
    from umbilical.cli import main

    scenario = umbilical.load("crosscheck-none", {"duration": 1.0})
    runs = [umbilical.simulate(s) for s in (scenario, scenario.replace({"payload.mass": 9000.0}))]
    paths = [run.save(tmp_path / f"{name}.nc") for name, run in zip("ab", runs, strict=True)]
    found = umbilical.compare(*runs, names="ab")
    peaks = [run.metrics["tip_peak"] for run in runs]
    assert found.metrics["tip_peak"] == tuple(peaks)
    assert found.ratios["tip_peak"] == (1.0, peaks[1] / peaks[0])
    assert main(["compare", *map(str, paths)]) == 0
    assert capsys.readouterr().out.rstrip() in found.summary()
    assert [line.get_label() for line in found.plot().lines if line.get_label() in "ab"] == ["a", "b"]
    assert found.to_dict()["runs"][1]["metrics"]["tip_peak"] == peaks[1]
    with pytest.raises(ValueError, match="two or more"):
        umbilical.compare(runs[0])


@pytest.mark.parametrize(
    "function",
    ["simulate", "Episode", "margins", "certify", "design", "to_control", "sweep", "tune", "show", "compare",
     "plot_tip", "plot_overview", "plot_motors", "plot_winch", "plot_study"],
)  # fmt: skip
def test_a_name_where_a_thing_is_needed_is_answered_by_how_to_get_it(function: str) -> None:
    with pytest.raises(TypeError, match=r"is needed here, not 'paper': umbilical\.(load|open)\w*\('paper'\) gives one"):
        getattr(umbilical, function)("paper")


@pytest.mark.parametrize(("wrong", "words"), [("law", "no period"), (umbilical.Episode, "no controller")])
def test_what_is_no_controller_is_refused(wrong: object, words: str) -> None:
    with pytest.raises(umbilical.errors.ControllerError, match=words):
        umbilical.simulate(umbilical.load("crosscheck-none"), wrong)  # type: ignore[arg-type]
