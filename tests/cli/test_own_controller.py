"""``--controller``: a law of one's own is run, judged and never taken for the scenario's."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

LAWS = """
from umbilical import Command

class Damper:
    period = 2e-3

    def start(self, measurement):
        return measurement.tip_displacement, 0.0

    def update(self, t, measurement, state):
        before, velocity = state
        now = measurement.tip_displacement
        velocity += 0.04 * ((now - before) / self.period - velocity)
        return Command(thrust=-1e3 * velocity), (now, velocity)

class Bang(Damper):
    def update(self, t, measurement, state):
        return Command(thrust=-10.0 if measurement.tip_displacement > 0.0 else 10.0), state

class Broken:
    period = 1e-3

class Failing(Damper):
    def update(self, t, measurement, state):
        raise ValueError("lost")
"""


@pytest.fixture
def laws(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    (tmp_path / "laws_of_a_user.py").write_text(LAWS, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    yield "laws_of_a_user"
    sys.modules.pop("laws_of_a_user", None)


def test_run(umbilical, laws):
    done = umbilical("run", "paper", "--set", "duration=0.5", "--controller", f"{laws}:Damper", "--json")
    document = done.document()
    assert (done.code, document["controller"]) == (0, f"{laws}:Damper")
    text = umbilical("run", "paper", "--set", "duration=0.5", "--controller", f"{laws}:Damper").out
    assert f"controller: {laws}:Damper in place of the scenario's own" in text


def test_margins(umbilical, laws):
    done = umbilical("margins", "ringdown", "--controller", f"{laws}:Damper", "--grid", "0")
    assert done.code == 0
    assert done.out.startswith("ringdown with Damper: stable")
    assert "Damper linearised with the ROV at rest" in done.out


def test_margins_that_nothing_speaks_for_are_unresolved(umbilical, laws, tmp_path):
    picture = tmp_path / "margins.png"
    done = umbilical("margins", "ringdown", "--controller", f"{laws}:Bang", "--plot", picture)
    assert done.code == 7
    assert done.out.startswith("ringdown with Bang: UNRESOLVED, ")
    assert not picture.exists()
    document = umbilical("margins", "ringdown", "--controller", f"{laws}:Bang", "--json").document()
    assert (document["verdict"], document["stable"], document["lengths"]) == ("UNRESOLVED", False, [])


@pytest.mark.parametrize("command", ["run", "margins"])
@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("Broken", "no start, update"),
        ("Missing", "has no attribute"),
        ("Failing", "run: Failing failed at t = 0 s: ValueError: lost ("),
    ],
)
def test_what_is_no_controller_is_refused_before_the_work(umbilical, laws, command, name, why):
    done = umbilical(command, "ringdown", "--controller", f"{laws}:{name}")
    assert done.code == 2
    assert why in done.err
    assert "Traceback" not in done.err


def test_a_result_says_what_decided_and_never_passes_for_the_scenarios_own(umbilical, laws, tmp_path):
    own, result = f"{laws}:Damper", tmp_path / "own.nc"
    umbilical("run", "paper", "--set", "duration=0.5", "--controller", own, "--out", result)
    assert umbilical("show", result).out.startswith(f"paper with {own}: COMPLETED")
    assert umbilical("show", result, "--json").document()["controller"] == own
    again = umbilical("run", result)
    assert f"this run had the controller {own}" in again.err
    assert again.out.startswith("paper: COMPLETED")
    assert "controller" not in umbilical("run", result, "--controller", own).err


def test_names_of_a_module_are_told_where_one_is_missing(umbilical, laws):
    assert "did you mean 'Damper'?" in umbilical("run", "paper", "--controller", f"{laws}:Dampr").err
    assert f" {laws}:NAME" in umbilical("run", "paper", "--controller", f"{laws}.py:Damper").err
    assert (
        " elsewhere:NAME, in the folder of elsewhere.py" in umbilical("run", "paper", "--controller", "elsewhere:A").err
    )
    assert "known: Damper, Bang, Broken, Failing" in umbilical("run", "paper", "--controller", laws).err
