"""Python controllers of a study: trusted or not imported, tried before the first member; their failures are rows."""

from __future__ import annotations

import sys

import pytest

from tests.support.controllers import Answering
from tests.support.studies import small_study
from umbilical import Command, load, simulate
from umbilical.errors import ControllerError, ScenarioError
from umbilical.studies import engines
from umbilical.studies.controllers import describe_error
from umbilical.studies.study import Study
from umbilical.studies.sweep import sweep
from umbilical.studies.tune import tune

CODE = """
import sys
from umbilical import Command

class Law:
    period = 1e-3
    def __init__(self, gain=100.0): self.gain = gain
    def start(self, measurement): return None
    def update(self, t, measurement, state): return Command(thrust=-self.gain * measurement.tip_displacement), state

class Late(Law):
    def update(self, t, measurement, state):
        return sys.exit(3) if t > 0.005 else super().update(t, measurement, state)

def law(scenario): return Law()
def two(scenario, other): return Law()
def nothing(scenario): return None
def half(scenario): return type("Half", (), {"period": 1e-3})()
def quits(scenario): sys.exit(3)
def quits_at_once(scenario): return type("Quits", (Law,), {"start": lambda self, measurement: sys.exit(3)})()
def raises(scenario): raise ValueError("x" * 10_000)
def late(scenario): return Late() if scenario.payload.mass == 400.0 else Law()
def all_late(scenario): return Late()
def odd(scenario): return type("Odd", (Law,), {"period": 1.5e-3})()
number = 5
"""


SHORT = load("paper", {"duration": 0.01, "grid.elements": 8})


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.path", [*sys.path])
    monkeypatch.delitem(sys.modules, "laws", raising=False)
    (tmp_path / "laws.py").write_text(CODE)
    (tmp_path / "quitting.py").write_text("import sys; sys.exit(3)")
    yield
    sys.modules.pop("laws", None)


def study_of(*controllers: str, **changes) -> Study:
    mass = {"kind": "choice", "values": [400.0, 500.0]}
    return small_study(
        design="grid",
        campaigns=[],
        scenario__duration=0.01,
        factors=[{"key": "payload.mass", "distribution": mass}],
        arms=[{"name": path, "controller": path} for path in controllers],
        limits={},
        **changes,
    )


def test_code_is_not_imported_without_the_users_word():
    with pytest.raises(ScenarioError, match="trust=True"):
        sweep(study_of("laws:law"))
    assert "laws" not in sys.modules
    tuning = {"arm": "laws:law", "objectives": [{"metric": "tip_peak"}]}
    gains = {"gains": [{"key": "control.law.damping_gain", "low": 1.0, "high": 2.0}]}
    with pytest.raises(ScenarioError, match="trust=True"):
        tune(study_of("laws:law", tuning={**tuning, **gains}))
    assert "laws" not in sys.modules


WRONG = {
    "laws:Law": "bad operand type for unary -: 'Scenario'",
    "laws:two": "missing 1 required positional argument",
    "laws:nothing": "gives NoneType, which has no period, start, update",
    "laws:half": "gives Half, which has no start, update",
    "laws:number": "'int' object is not callable",
    "laws:nobody": "has no attribute 'nobody'",
    "laws": "TypeError|has no attribute|AttributeError",
    "nowhere:law": "No module named 'nowhere'",
    ":law": "Empty module name",
    "laws:quits": "SystemExit: 3",
    "laws:quits_at_once": "SystemExit: 3",
    "laws:raises": r"ValueError: x{100,300}\.\.\.",
    "laws:odd": "a multiple of control.period",
    "quitting:law": "SystemExit: 3",
}


@pytest.mark.parametrize("path", WRONG)
def test_what_makes_no_controller_is_refused_before_the_first_member(path, monkeypatch):
    monkeypatch.setattr("umbilical.studies.sweep.run_member", lambda *_: pytest.fail("it ran"))
    with pytest.raises(ScenarioError, match=WRONG[path]) as caught:
        sweep(study_of(path), engine=engines.threads(1), trust=True)
    assert [problem.key for problem in caught.value.problems] == ["arms.1.controller"]


def test_all_that_is_wrong_comes_at_once():
    with pytest.raises(ScenarioError) as caught:
        sweep(study_of("laws:law", *WRONG), trust=True)
    assert len(caught.value.problems) == len(WRONG)


@pytest.mark.parametrize("engine", [engines.threads(2), pytest.param(engines.processes(1), marks=pytest.mark.slow)])
def test_a_controller_that_ends_the_program_is_a_failed_member(engine):
    result = sweep(study_of("laws:late", "laws:all_late"), engine=engine, trust=True)
    assert result["status"].values.tolist() == [[3, 3], [0, 3]]
    assert str(result["reason"].values[0, 0]).startswith("Late failed at t = 0.006 s: SystemExit: 3 (laws.py, line ")
    assert result.lost == ("laws:all_late",)


def test_so_is_one_alone():
    quitting = Answering(lambda t: sys.exit(3) if t > 0.005 else Command(thrust=0.0))
    with pytest.raises(ControllerError, match="SystemExit: 3") as caught:
        simulate(SHORT, quitting)
    assert caught.value.run is not None
    assert 0.004 < caught.value.run.end_time < 0.006


def test_an_interruption_is_none():
    def interrupt(t):
        raise KeyboardInterrupt

    assert simulate(SHORT, Answering(interrupt)).status.name == "INTERRUPTED"


def test_reasons_stay_short():
    assert len(describe_error(ValueError("x" * 10**6))) < 400
    assert describe_error(SystemExit()) == "SystemExit"
