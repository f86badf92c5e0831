"""Winch laws: each derivative against differences of the one before, ends, corners, limits at jumps."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.plant import winch
from umbilical.scenario.winch import (
    ConstantLength,
    ConstantSpeed,
    Cosine,
    Quintic,
    TabulatedLength,
    Trapezoid,
    Winch,
)

pytestmark = pytest.mark.nojit

LAWS: dict[str, Winch] = {
    "constant": ConstantLength(law="constant", length=400.0),
    "speed": ConstantSpeed(law="speed", start_length=500.0, speed=-1.5),
    "quintic": Quintic(law="quintic", start_length=450.0, end_length=500.0, start=2.0, duration=40.0),
    "trapezoid": Trapezoid(
        law="trapezoid", start_length=500.0, end_length=450.0, top_speed=2.0, acceleration=0.25, start=3.0
    ),
    "triangle": Trapezoid(law="trapezoid", start_length=450.0, end_length=451.0, top_speed=2.0, acceleration=0.5),
    "cosine": Cosine(law="cosine", start_length=450.0, amplitude=20.0, frequency=0.3),
    "table": TabulatedLength(
        law="table", times=(0.0, 10.0, 22.0, 35.0, 50.0), lengths=(450.0, 455.0, 470.0, 480.0, 478.0)
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", LAWS)
def test_each_derivative_is_the_limit_of_differences(name: str) -> None:
    law, step = LAWS[name], 1e-4
    t = np.linspace(0.0137, 49.97, 301)
    ahead, behind, here = winch.evaluate(law, t + step), winch.evaluate(law, t - step), winch.evaluate(law, t)
    for below, above in ((0, 1), (1, 2), (2, 3)):
        difference = (ahead[below] - behind[below]) / (2.0 * step)
        np.testing.assert_allclose(here[above], difference, atol=1e-8)


def test_quintic_of_the_paper_preset() -> None:
    law = Quintic(law="quintic", start_length=450.0, end_length=500.0, duration=50.0)
    motion = winch.evaluate(law, [0.0, 25.0, 50.0, 60.0])
    assert motion.length.tolist() == [450.0, 475.0, 500.0, 500.0]
    assert motion.speed.tolist() == [0.0, 1.875, 0.0, 0.0]
    assert motion.acceleration.tolist() == [0.0, 0.0, 0.0, 0.0]
    np.testing.assert_allclose(motion.jerk, [0.024, -0.012, 0.0, 0.0], rtol=1e-14)
    assert winch.evaluate(law, 50.0, side="left").jerk == pytest.approx(0.024)
    assert winch.evaluate(law, 0.0, side="left").jerk == 0.0
    assert winch.jumps(law) == (0.0, 50.0)


def test_trapezoid_corners_and_limits() -> None:
    law = LAWS["trapezoid"]
    assert winch.jumps(law) == (3.0, 11.0, 28.0, 36.0)
    after, before = winch.evaluate(law, winch.jumps(law)), winch.evaluate(law, winch.jumps(law), side="left")
    assert after.acceleration.tolist() == [-0.25, 0.0, 0.25, 0.0]
    assert before.acceleration.tolist() == [0.0, -0.25, 0.0, 0.25]
    np.testing.assert_allclose(after.length, before.length, rtol=1e-14)
    assert after.length.tolist() == [500.0, 492.0, 458.0, 450.0]


def test_trapezoid_becomes_a_triangle() -> None:
    law = Trapezoid(law="trapezoid", start_length=450.0, end_length=454.0, top_speed=9.0, acceleration=1.0)
    assert winch.jumps(law) == (0.0, 2.0, 4.0)
    motion = winch.evaluate(law, [2.0, 4.0])
    assert motion.speed.tolist() == [2.0, 0.0]
    assert motion.length.tolist() == [452.0, 454.0]


def test_trapezoid_going_nowhere_stays() -> None:
    law = Trapezoid(law="trapezoid", start_length=450.0, end_length=450.0, top_speed=9.0, acceleration=1.0)
    motion = winch.evaluate(law, np.linspace(0.0, 5.0, 7))
    assert set(motion.length) == {450.0}
    assert not motion.speed.any()


def test_table_passes_through_its_knots() -> None:
    law = LAWS["table"]
    assert isinstance(law, TabulatedLength)
    np.testing.assert_allclose(winch.evaluate(law, law.times).length, law.lengths, rtol=1e-14)
    assert winch.jumps(law) == law.times
