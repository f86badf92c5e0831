"""Faults, eq. (16): exactly on, just before and just after every published instant."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.plant import faults
from umbilical.scenario.faults import Dead, Fault, Intermittent, Partial, Ramp, Stuck

pytestmark = pytest.mark.nojit

BEFORE = 10.0 - 1e-10  # beyond round-off


@pytest.mark.parametrize(
    ("fault", "effectiveness", "stuck"),
    [
        (Partial(kind="partial", motor=1, start=10.0, effectiveness=0.5), 0.5, 0.0),
        (Dead(kind="dead", motor=1, start=10.0), 0.0, 0.0),
        (Stuck(kind="stuck", motor=1, start=10.0, value=100.0), 0.0, 100.0),
        (Ramp(kind="ramp", motor=1, start=10.0, over=4.0, effectiveness=0.2), 1.0, 0.0),
        (Intermittent(kind="intermittent", motor=1, start=10.0, cycle=2.0, duty=0.5), 0.0, 0.0),
    ],
)
def test_start_on_the_instant(fault: Fault, effectiveness: float, stuck: float) -> None:
    after, before = (
        faults.effect([fault], 1, "thrust", [BEFORE, 10.0]),
        faults.effect([fault], 1, "thrust", 10.0, "left"),
    )
    assert [part.tolist() for part in after] == [[1.0, effectiveness], [0.0, stuck]]
    assert [part.item() for part in before] == [1.0, 0.0]
    assert faults.jumps([fault], 10.0) == (10.0,)


def test_end_on_the_instant() -> None:
    fault = Stuck(kind="stuck", motor=1, start=2.0, end=10.0, value=-7.0)
    assert [part.tolist() for part in faults.effect([fault], 1, "thrust", [BEFORE, 10.0])] == [[0.0, 1.0], [-7.0, 0.0]]
    assert [part.item() for part in faults.effect([fault], 1, "thrust", 10.0, "left")] == [0.0, -7.0]
    assert faults.jumps([fault], 50.0) == (2.0, 10.0)


def test_ramp_wears_then_stays_then_recovers() -> None:
    fault = Ramp(kind="ramp", motor=1, start=10.0, over=4.0, effectiveness=0.2, end=20.0)
    effectiveness, stuck = faults.effect([fault], 1, "thrust", [9.0, 10.0, 12.0, 14.0, 19.0, 20.0])
    np.testing.assert_allclose(effectiveness, [1.0, 1.0, 0.6, 0.2, 0.2, 1.0])
    assert not stuck.any()
    assert faults.jumps([fault], 50.0) == (10.0, 14.0, 20.0)


def test_ramp_cut_short_has_no_instant_after_its_end() -> None:
    fault = Ramp(kind="ramp", motor=1, start=10.0, over=4.0, effectiveness=0.2, end=12.0)
    assert faults.jumps([fault], 50.0) == (10.0, 12.0)


def test_intermittent_agrees_with_its_published_instants() -> None:
    fault = Intermittent(kind="intermittent", motor=1, start=0.3, cycle=0.7, duty=0.1, effectiveness=0.25, end=40.0)
    instants = np.array(faults.jumps([fault], 50.0))
    after = faults.effect([fault], 1, "thrust", instants)[0]
    before = faults.effect([fault], 1, "thrust", instants, "left")[0]
    assert after[:-1].tolist() == [0.25, 1.0] * (len(after) // 2)
    np.testing.assert_array_equal(before[1:], after[:-1])
    assert after[-1] == 1.0


def test_overlapping_faults_multiply() -> None:
    timeline: list[Fault] = [
        Partial(kind="partial", motor=1, start=1.0, effectiveness=0.5),
        Partial(kind="partial", motor=1, start=2.0, effectiveness=0.4),
        Stuck(kind="stuck", motor=1, start=3.0, value=9.0),
    ]
    effectiveness, stuck = faults.effect(timeline, 1, "thrust", [0.0, 1.0, 2.0, 3.0])
    np.testing.assert_allclose(effectiveness, [1.0, 0.5, 0.2, 0.0])
    assert stuck.tolist() == [0.0, 0.0, 0.0, 9.0]


def test_a_motor_stuck_twice_is_stuck_each_time() -> None:
    timeline: list[Fault] = [
        Stuck(kind="stuck", motor=1, start=1.0, end=2.0, value=9.0),
        Stuck(kind="stuck", motor=1, start=3.0, end=4.0, value=-5.0),
    ]
    effectiveness, stuck = faults.effect(timeline, 1, "thrust", [0.5, 1.5, 2.5, 3.5, 4.5])
    assert stuck.tolist() == [0.0, 9.0, 0.0, -5.0, 0.0]
    assert effectiveness.tolist() == [1.0, 0.0, 1.0, 0.0, 1.0]


def test_a_fault_stays_with_its_motor_and_its_target() -> None:
    fault = Dead(kind="dead", motor=2, target="voltage", start=0.0)
    assert faults.effect([fault], 2, "voltage", 0.0)[0] == 0.0
    assert faults.effect([fault], 1, "voltage", 0.0)[0] == 1.0
    assert faults.effect([fault], 2, "thrust", 0.0)[0] == 1.0


def test_jumps_end_with_the_run_and_the_first_fault_is_found() -> None:
    timeline = [Dead(kind="dead", motor=1, start=60.0), Dead(kind="dead", motor=2, start=5.0)]
    assert faults.jumps(timeline, 50.0) == (5.0,)
    assert faults.first_fault(timeline) == 5.0
    assert faults.first_fault([]) is None
