"""Control instants, plant steps and published jumps."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.engine.schedule import SNAP, Clock, Stretch, make_clock, stretch

pytestmark = pytest.mark.nojit

PERIOD = 1e-3


def whole(jumps: tuple[float, ...], substeps: int = 2, periods: int = 10) -> Stretch:
    return stretch(Clock(PERIOD, periods, substeps, np.array(jumps)), 0, periods)


@pytest.mark.parametrize(
    ("largest", "substeps"), [(1e-3, 1), (2e-3, 1), (9.99e-4, 2), (5e-4, 2), (1e-3 / 3, 3), (1e-4, 10), (1.1e-4, 10)]
)
def test_as_few_steps_as_the_largest_allows(largest: float, substeps: int) -> None:
    clock = make_clock(0.01, PERIOD, largest, ())
    assert (clock.substeps, clock.periods) == (substeps, 10)


def test_without_jumps_all_steps_are_equal() -> None:
    part = whole(())
    np.testing.assert_allclose(part.steps.end - part.steps.start, PERIOD / 2, rtol=1e-12)
    np.testing.assert_array_equal(part.first, np.arange(11) * 2)
    np.testing.assert_array_equal(part.steps.start[1:], part.steps.end[:-1])


def test_a_jump_on_a_step_takes_no_step_of_its_own() -> None:
    jump = 0.0035 * (1.0 + 1e-16) + 1e-14
    part = whole((jump,))
    assert part.steps.start.size == 20
    assert jump in part.steps.start, "the knot is the jump's own number"
    assert part.steps.jumps.tolist() == [jump]


@pytest.mark.parametrize("off", [10.0 * SNAP, -10.0 * SNAP, 0.3, -0.3])
def test_a_jump_between_steps_divides_one(off: float) -> None:
    jump = 0.0035 + off * PERIOD / 2
    part = whole((jump,))
    assert part.steps.start.size == 21
    assert jump in part.steps.start
    assert jump in part.steps.end
    assert (part.steps.end > part.steps.start).all()
    begins = part.steps.start[part.first[:-1]]
    np.testing.assert_allclose(begins, np.arange(10) * PERIOD, atol=1e-18)


def test_several_jumps_in_one_step() -> None:
    jumps = (0.0031, 0.0032, 0.00325, 0.0035, 0.0042)
    part = whole(jumps)
    assert set(jumps) <= set(part.steps.start)
    assert part.steps.start.size == 24
    np.testing.assert_array_equal(np.diff(part.first), [2, 2, 2, 5, 3, 2, 2, 2, 2, 2])


def test_a_jump_at_the_start_and_at_the_end_of_the_run() -> None:
    part = whole((0.0, 0.01))
    assert part.steps.start.size == 20
    assert part.steps.start[0] == 0.0
    assert part.steps.end[-1] == 0.01


@pytest.mark.parametrize("cut", [1, 3, 4, 7])
def test_it_does_not_matter_where_stretches_are_cut(cut: int) -> None:
    jumps = (0.001, 0.0013, 0.003, 0.003 + 1e-13, 0.00399, 0.004, 0.00701)
    clock = make_clock(0.01, PERIOD, 4e-4, jumps)
    one = stretch(clock, 0, 10)
    parts = [stretch(clock, 0, cut), stretch(clock, cut, 10)]
    np.testing.assert_array_equal(np.concatenate([p.steps.start for p in parts]), one.steps.start)
    np.testing.assert_array_equal(np.concatenate([p.steps.end for p in parts]), one.steps.end)
    first = np.concatenate([parts[0].first[:-1], parts[0].first[-1] + parts[1].first])
    np.testing.assert_array_equal(first, one.first)
    np.testing.assert_array_equal(
        np.concatenate([np.isin(p.steps.start, p.steps.jumps) for p in parts]),
        np.isin(one.steps.start, one.steps.jumps),
    )
