"""The benchmark's rows mean what they say; how large they are is the machine's affair."""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks import by_hand, measure, rope
from benchmarks.measure import Row, measure_all
from umbilical import load, simulate
from umbilical.verify.references import paper as reference


@pytest.fixture(scope="module")
def ours() -> tuple[np.ndarray, np.ndarray]:
    """Instants, and our displacement of the paper's cable at the nodes of the plain script."""
    run = simulate(load("paper", {"duration": 4.0})).data.isel(time=slice(None, None, 10))
    rows = [np.interp(reference.XI, run["sigma"].values, row) for row in run["displacement"].values]
    return run["time"].values, np.array(rows)


def agree(plain: np.ndarray, ours: np.ndarray) -> bool:
    """At the ROV to 1 %, along the cable to 3.5 % rms: what second order on 100 nodes makes of the wave front."""
    error, size = plain - ours, np.abs(ours).max()
    return bool(np.abs(error[:, -1]).max() < 0.01 * size and np.sqrt((error**2).mean() / (ours**2).mean()) < 0.035)


def test_the_plain_script_is_the_same_system(ours):
    times, displacement = ours
    assert agree(reference.displacement(times), displacement)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "value"), [("RHO", 1.0), ("BETA", 1.0), ("K_S", 2.5), ("K_A", 5e3), ("DAMPING", 0.1)])
def test_another_system_would_be_noticed(ours, monkeypatch, name, value):
    times, displacement = ours
    monkeypatch.setattr(reference, name, value)
    assert not agree(reference.displacement(times), displacement)


needs_compiler = pytest.mark.skipif(by_hand.compiler() is None, reason="no C compiler")


@needs_compiler
def test_the_program_in_c_is_the_same_system(ours, tmp_path):
    """As far as second order on 100 intervals goes: within 1 % of the peak, each second."""
    times, displacement = ours
    tip = by_hand.run(by_hand.build(tmp_path))[1]
    mine = np.interp(np.arange(5.0), times, displacement[:, -1])
    assert np.abs(tip[:5] - mine).max() < 0.01 * np.abs(mine).max()


@pytest.mark.slow
@needs_compiler
@pytest.mark.parametrize(("said", "instead"), [("BETA = 0.01", "BETA = 1.0"), ("K_S = 5.0", "K_S = 2.5")])
def test_another_system_in_c_would_be_noticed(ours, tmp_path, monkeypatch, said, instead):
    text = by_hand.SOURCE.read_text()
    assert said in text
    (tmp_path / "other.c").write_text(text.replace(said, instead))
    monkeypatch.setattr(by_hand, "SOURCE", tmp_path / "other.c")
    with pytest.raises(AssertionError):
        test_the_program_in_c_is_the_same_system(ours, tmp_path)


@pytest.mark.slow
def test_moordyn_swings_as_the_rope_does():
    """What the row of equal accuracy asks of both: the same physics in the limit, each on its own grids."""
    pytest.importorskip("moordyn")
    exact = rope.ours(rope.FINE)
    mine, coarse, fine = rope.ours(4).off(exact), rope.theirs(15).off(exact), rope.theirs(50).off(exact)
    assert mine[0] < rope.ENOUGH
    assert fine[0] < 0.15 * coarse[0]
    assert fine[0] < rope.ENOUGH / 3.0


def test_parts_add_up_to_the_loop():
    times = {name: {"loop_s": 1.0 + k, "outside_s": 0.5} for k, name in enumerate(measure.VARIANTS)}
    assert sum(measure._parts(times).values()) == pytest.approx(times["full"]["loop_s"] + times["full"]["outside_s"])


@pytest.mark.slow
def test_every_row_is_measured():
    found = measure_all(1, members=6)
    assert {row.name.strip() for row in found.rows} >= {
        "compiled loop, 50 s",
        "Python loop, 50 s",
        "rope, 1000 m, control at 5 ms, 60 s",
        "string in drag and current over calm, held",
        "numpy + scipy solve_ivp, 50 s",
        "umbilical run paper --json",
        "umbilical --help",
        "1000 members, 2 threads",
        "speed-up from 1 to 2 threads",
        "1000 members, numpy + scipy",
        "umbilical sweep, peak memory",
    }
    assert all(isinstance(row, Row) and np.isfinite(row.value) for row in found.rows)
    assert "numba" in found.headline
