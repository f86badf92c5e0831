"""The top end of the cable: one file samples winch and vessel, and its limits at jumps are those of both sides."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

import umbilical
from umbilical.plant.top import top_at, top_on_both_sides, top_within
from umbilical.scenario.winch import Trapezoid

SOURCE = Path(umbilical.__file__).parent
SAMPLING = re.compile(r"\b(winch|laws)\.evaluate\(|\bsignals\.vessel\(")
RAMP = Trapezoid(law="trapezoid", start_length=100.0, end_length=110.0, top_speed=1.0, acceleration=0.5)


def test_one_file_samples_winch_and_vessel() -> None:
    found = [path.name for path in SOURCE.rglob("*.py") if SAMPLING.search(path.read_text(encoding="utf-8"))]
    assert found == ["top.py"]


def test_limits_at_a_jump() -> None:
    """The acceleration falls from 0.5 to 0 m/s2 at 2 s."""
    both = top_on_both_sides(RAMP, np.array([2.0]))
    assert both.acceleration.tolist() == [0.5, 0.0]
    assert both.net_gravity(10.0).tolist() == [9.5, 10.0]
    rows = top_within(RAMP, np.array([[0.0, 1.0, 2.0], [2.0, 3.0, 4.0]]))
    assert rows.acceleration.tolist() == [[0.5, 0.5, 0.5], [0.0, 0.0, 0.0]]


def test_net_gravity_and_its_relative_jerk() -> None:
    """a'/(g - a) is the rate of -ln(g - a)."""
    winch = umbilical.load("paper").winch
    before, now, after = (top_at(winch, 12.0 + shift) for shift in (-1e-4, 0.0, 1e-4))
    rate = -np.log(after.net_gravity(10.0) / before.net_gravity(10.0)) / 2e-4
    np.testing.assert_allclose(now.relative_jerk(10.0), rate, rtol=1e-6)
