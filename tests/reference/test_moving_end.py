"""Free response with a moving end under constant tension, against characteristics; and that reference itself."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.verdicts import assert_holds, each
from umbilical.verify import moving_end
from umbilical.verify.cases import Case
from umbilical.verify.moving_end import UNTIL, WAYS, Setting, reference
from umbilical.verify.references.characteristics import HeldEnd, MovingEnd

each_way = pytest.mark.parametrize("setting", WAYS.values(), ids=WAYS)


@each(moving_end.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)


@each_way
def test_the_reference_is_solved_to_ten_digits(setting: Setting) -> None:
    instants = np.linspace(0.0, UNTIL, 301)
    coarse, fine = reference(setting), reference(setting, pieces=5, degree=48)
    assert np.abs(coarse.tip(instants) - fine.tip(instants)).max() < 1e-10
    assert np.abs(coarse.tip(instants)).max() > 0.05, "the pulse has reached the ROV"


@each_way
def test_the_reference_moves_the_vessel_end_with_the_vessel(setting: Setting) -> None:
    solution, instants = reference(setting), np.linspace(0.0, 0.88 * UNTIL, 45)
    ends = [solution(np.array([length]), t)[0] for length, t in zip(setting.length(instants), instants, strict=True)]
    np.testing.assert_allclose(ends, setting.vessel(instants), atol=1e-10)


@pytest.mark.parametrize("speed", [5.0, -4.0])
def test_a_heavy_rov_is_a_held_end(speed: float) -> None:
    """Two references that share no formula for the lower end: the delay equation, and Moore's phase."""
    setting = Setting(speed)
    held = HeldEnd(50.0, 250.0, speed, setting.start)
    heavy = MovingEnd(5000.0, 2.0, 1e13, 0.0, setting.length, setting.start, 60.0)
    for t in (0.0, 7.3, 21.0, 48.0):
        s = np.linspace(0.0, 1.0, 101) * (250.0 + speed * t)
        np.testing.assert_allclose(heavy(s, t), held(s, t), atol=1e-7)


@pytest.mark.parametrize("speed", [5.0, -4.0])
def test_the_moving_end_stretches_or_presses_a_pulse_together(speed: float) -> None:
    """Slope and frequency of what comes back are (1 - b)/(1 + b) of what arrived, b = v/c."""
    setting, b = Setting(speed), speed / 50.0
    held = HeldEnd(50.0, 250.0, speed, setting.start)
    s = np.linspace(0.0, 230.0, 100001)
    steepest = [np.abs(np.gradient(held(s, t), s))[s > 120.0].max() for t in (1.2, 4.2)]
    assert steepest[1] / steepest[0] == pytest.approx((1.0 - b) / (1.0 + b), rel=1e-3)
