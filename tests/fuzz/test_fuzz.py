"""Whatever comes in, what comes out is a documented exit code and a plain text; never a bug of ours, never a hang.

``UMBILICAL_FUZZ=2000 pytest tests/fuzz -m slow -s`` tries some 2000 inputs (200 if left out) and prints what came
of them; ``UMBILICAL_FUZZ_SEED`` others, ``UMBILICAL_FUZZ_OUT`` names a file for those that went wrong.
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from tests.fuzz.inputs import (
    SCENARIOS,
    STUDY,
    Case,
    as_text,
    assigned,
    result_files,
    scenario_files,
    spoilt,
    study_files,
    words,
)
from tests.fuzz.runner import Hangs, answer, faults
from umbilical import simulate
from umbilical.cli.output import EXIT_CODES
from umbilical.formats import to_netcdf
from umbilical.scenario.scenario import validate
from umbilical.studies.engines import threads
from umbilical.studies.sweep import sweep

INPUTS = int(os.environ.get("UMBILICAL_FUZZ", "200"))
SEED = int(os.environ.get("UMBILICAL_FUZZ_SEED", "0"))
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def stored() -> dict[str, xarray.Dataset]:
    """A result of a run and one of a study."""
    run = simulate(validate(SCENARIOS["paper"], "paper"))
    return {"run": run.data, "study": sweep(STUDY, engine=threads(1)).data}


WAYS = ("attribute", "attribute", "attribute", "variable", "cut", "bytes", "bytes", "nothing")
CUTS = (0, slice(0, 0), slice(0, 1), slice(1, None), slice(None, None, -1))


def altered(draw: Callable[..., Any], data: xarray.Dataset) -> bytes:
    """A result with an attribute or a variable changed or gone, cut in one dimension, or with damaged bytes."""
    what = draw(
        st.sampled_from(["attribute", "attribute", "attribute", "variable", "cut", "bytes", "bytes", "nothing"])
    )
    if what == "bytes":
        return draw(spoilt(to_netcdf(data)))
    data = data.copy()
    if what == "attribute":
        owner = draw(st.sampled_from([data, data, *(data[name] for name in list(data.variables)[:6])]))
        name = draw(st.sampled_from(sorted(map(str, owner.attrs)) or ["kind"]))
        if draw(st.integers(0, 2)) == 0:
            owner.attrs.pop(name, None)
        else:
            plain = st.one_of(st.text("abc[]{}1=\n\x1b", max_size=9), st.integers(-9, 9), st.just(np.arange(3.0)))
            owner.attrs[name] = draw(plain)
    elif what == "variable":
        data = data.drop_vars(draw(st.sampled_from(list(data.variables))))
    elif what == "cut":
        dim = draw(st.sampled_from(sorted(map(str, data.sizes))))
        data = data.isel(
            {dim: draw(st.sampled_from([0, slice(0, 0), slice(0, 1), slice(1, None), slice(None, None, -1)]))}
        )
    return to_netcdf(data)


UNWATCHED = (HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much)
SHARES = {"scenario": 0.55, "set": 0.15, "study": 0.15, "result": 0.1, "words": 0.05}


@pytest.fixture(scope="module")
def seen() -> Counter[str]:
    """What came of all inputs so far."""
    return Counter()


@pytest.mark.parametrize("kind", SHARES)
def test_no_input_is_answered_by_a_bug(stored, seen, kind):
    """All inputs are tried, and what went wrong with any of them comes at once, with what reproduces it."""
    wanted, tried, wrong = round(SHARES[kind] * INPUTS), set[Case](), list[str]()
    cases = {
        "scenario": scenario_files(),
        "set": assigned(),
        "study": study_files(),
        "result": result_files(lambda draw, which: altered(draw, stored[which])),
        "words": words(),
    }[kind]

    @settings(max_examples=3 * wanted, deadline=None, database=None, derandomize=not SEED,
              suppress_health_check=UNWATCHED, phases=[Phase.generate])  # fmt: skip
    @given(cases)
    def check(case: Case) -> None:
        if len(tried) < wanted and case not in tried:
            tried.add(case)
            wrong.extend(_wrong(case, seen))

    (seed(SEED)(check) if SEED else check)()
    if file := os.environ.get("UMBILICAL_FUZZ_OUT"):
        with Path(file).open("a") as kept:
            kept.write("".join(f"{text}\n\n" for text in wrong))
    assert not wrong, f"{len(wrong)} of {len(tried)}\n" + "\n\n".join(text[:2000] for text in wrong[:20])


def _wrong(case: Case, seen: Counter[str]) -> list[str]:
    try:
        found = answer(case)
    except Hangs as error:
        return [f"hangs for {error}: {case}"]
    except BaseException as error:
        return [f"raises {error!r}: {case}"]
    seen.update(["inputs", f"{case.kind} inputs", f"code {found.code}"])
    seen["reached the engine"] += bool(found.simulations)
    return [f"{fault}: {case}" for fault in faults(case, found)]


def test_enough_of_them_reached_the_engine(seen):
    """After the tests above."""
    print("\n" + "\n".join(f"{name:24} {count}" for name, count in sorted(seen.items())))
    if not seen:
        pytest.skip("needs the inputs above")
    # 0.33 of 2000 inputs did; of a small sample by chance fewer.
    assert seen["reached the engine"] >= 0.2 * seen["inputs"]
    assert {"code 0", "code 2", "code 4"} <= seen.keys()


LEAVES = """
import multiprocessing, os
from umbilical import Command
class Law:
    period = 1e-3
    def __init__(self, scenario): pass
    def start(self, measurement): return None
    def update(self, t, measurement, state):
        if multiprocessing.parent_process():
            os._exit(1)
        return Command(thrust=0.0), state
"""
LATE = ("duration=4", "payload.mass=250", "grid.elements=16", "sensors.tip_displacement.latency=1.0")
"""A second behind, the law drives the loop apart."""


def test_every_documented_exit_code_occurs_by_input(monkeypatch):
    """0, 2, 3, 4 and 7 by what is asked; 5 by a controller that ends its process; 6 without an optional package."""
    scenario, study = as_text(SCENARIOS["paper"]), as_text(STUDY.to_dict())
    stiff = [{"key": "control.law.damping_gain", "distribution": {"kind": "choice", "values": [1e8]}}]
    refused = STUDY.replace({"factors": stiff, "campaigns": [], "arms": [{"name": "one"}], "limits": {}})
    leaves = STUDY.replace({"arms": [{"name": "one", "controller": "leaves:Law"}]})
    late = [word for change in LATE for word in ("--set", change)]
    sweep_it = ("sweep", "{a.toml}", "--out", "{out}/s")
    monkeypatch.setattr("umbilical.studies.engines._LIVES", 1)
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.setattr("sys.path", [*sys.path])
    found = {
        0: _code(scenario, "run", "{a.toml}"),
        2: _code(b"[[", "run", "{a.toml}"),
        3: _code(scenario, "run", "{a.toml}", *late),
        4: _code(scenario, "run", "{a.toml}", "--out", "{out}/no/a.nc"),
        5: _code(as_text(leaves.to_dict()), *sweep_it, "--trust", "--jobs", "1", **{"leaves.py": LEAVES.encode()}),
        6: _code(study, *sweep_it, "--dask", "local"),
        7: _code(as_text(refused.to_dict()), *sweep_it),
    }
    assert found == {code: code for code in found}
    assert found.keys() | {1, 130} == EXIT_CODES.keys()


@pytest.mark.parametrize(("error", "code"), [(KeyboardInterrupt, 130), (RuntimeError, 1)])
def test_those_that_no_input_reaches_occur_when_that_happens(monkeypatch, error, code):
    """Ctrl-C, and a bug of ours, which is what no input above may find."""

    def happens(*_: Any) -> None:
        raise error

    monkeypatch.setattr("umbilical.engine.simulate.stretch", happens)
    assert _code(as_text(SCENARIOS["paper"]), "run", "{a.toml}") == code


def _code(content: bytes, *arguments: str, **files: bytes) -> int:
    return answer(Case("code", arguments, (("a.toml", content), *files.items()))).code
