"""Signals: values, derivatives against finite differences, limits at jumps, the vessel's fade-in."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from umbilical.plant import signals
from umbilical.scenario.environment import Environment
from umbilical.scenario.signals import Bell, Constant, Pulse, Signal, Sine, Step, Table

pytestmark = pytest.mark.nojit

TIMES = (0.0, 0.7, 2.0, 3.1, 4.5, 6.0)
VALUES = (1.0, -2.0, 0.5, 3.0, 2.0, -1.0)
SMOOTH: dict[str, Any] = {
    "constant": Constant(kind="constant", value=3.0),
    "sine": Sine(kind="sine", amplitude=2.0, frequency=1.3, phase=0.4),
    "bell": Bell(kind="bell", amplitude=2.0, center=2.5, width=0.8, exponent=2.0),
    "sharp bell": Bell(kind="bell", amplitude=-1.0, center=2.5, width=0.8, exponent=0.7),
    "smooth table": Table(kind="table", times=TIMES, values=VALUES),
    "linear table": Table(kind="table", times=TIMES, values=VALUES, interpolation="linear"),
}


@pytest.mark.parametrize("name", SMOOTH)
def test_derivative_is_the_limit_of_differences(name: str) -> None:
    signal: Signal = (SMOOTH[name],)
    t, step = np.linspace(0.013, 5.987, 101), 1e-5
    difference = (signals.evaluate(signal, t + step) - signals.evaluate(signal, t - step)) / (2.0 * step)
    np.testing.assert_allclose(signals.derivative(signal, t), difference, rtol=1e-6, atol=1e-8)


def test_terms_add() -> None:
    t = np.linspace(0.0, 6.0, 50)
    everything = tuple(SMOOTH.values())
    expected = sum(signals.evaluate((term,), t) for term in everything)
    np.testing.assert_allclose(signals.evaluate(everything, t), expected, rtol=1e-14)
    assert signals.evaluate((), t).tolist() == [0.0] * 50


def test_bell_formula() -> None:
    bell: Signal = (Bell(kind="bell", amplitude=1.0, center=25.0, width=8.0, exponent=2.0),)
    t = np.linspace(0.0, 50.0, 11)
    np.testing.assert_allclose(signals.evaluate(bell, t), 1.0 / (1.0 + ((t - 25.0) / 8.0) ** 4), rtol=1e-14)


def test_bell_far_away_is_zero_without_warning() -> None:
    bell: Signal = (Bell(kind="bell", amplitude=1.0, center=0.0, width=1e-3, exponent=100.0),)
    assert signals.evaluate(bell, 50.0) == 0.0
    assert signals.derivative(bell, [0.0, 50.0]).tolist() == [0.0, 0.0]


def test_limits_at_jumps() -> None:
    step: Signal = (Step(kind="step", value=2.0, time=1.0),)
    pulse: Signal = (Pulse(kind="pulse", value=3.0, start=1.0, end=1.001),)
    t = [1.0 - 1e-11, 1.0, 1.0 + 1e-11, 1.001]
    assert signals.evaluate(step, t).tolist() == [0.0, 2.0, 2.0, 2.0]
    assert signals.evaluate(step, t, side="left").tolist() == [0.0, 0.0, 2.0, 2.0]
    assert signals.evaluate(pulse, t).tolist() == [0.0, 3.0, 3.0, 0.0]
    assert signals.evaluate(pulse, t, side="left").tolist() == [0.0, 0.0, 3.0, 3.0]


def test_linear_table_slope_on_both_sides_of_a_kink() -> None:
    table: Signal = (Table(kind="table", times=(0.0, 1.0, 3.0), values=(0.0, 2.0, 0.0), interpolation="linear"),)
    assert signals.derivative(table, 1.0, side="left") == 2.0
    assert signals.derivative(table, 1.0, side="right") == -1.0
    assert signals.jumps(table) == (0.0, 1.0, 3.0)


def test_jumps_are_sorted_and_unique() -> None:
    signal: Signal = (
        Pulse(kind="pulse", value=1.0, start=2.0, end=5.0),
        Step(kind="step", value=1.0, time=2.0),
        Step(kind="step", value=1.0, time=1.0),
        SMOOTH["sine"],
        SMOOTH["smooth table"],
    )
    assert signals.jumps(signal) == (1.0, 2.0, 5.0)


def test_shape_is_kept() -> None:
    signal: Signal = (SMOOTH["sine"],)
    assert signals.evaluate(signal, 1.0).shape == ()
    assert signals.evaluate(signal, np.zeros((2, 3))).shape == (2, 3)


def test_vessel_starts_at_rest_and_ends_on_its_motion() -> None:
    motion: Signal = (Sine(kind="sine", amplitude=2.0, frequency=0.6, phase=1.0),)
    sea = Environment(gravity=9.81, payload_force=(), cable_load=(), vessel_motion=motion, vessel_ramp=5.0)
    t, step = np.linspace(0.01, 8.0, 200), 1e-5
    displacement, velocity = signals.vessel(sea, t)
    ahead, behind = signals.vessel(sea, t + step)[0], signals.vessel(sea, t - step)[0]
    np.testing.assert_allclose(velocity, (ahead - behind) / (2.0 * step), atol=1e-8)
    assert [part.item() for part in signals.vessel(sea, 0.0)] == [0.0, 0.0]
    np.testing.assert_array_equal(displacement[t > 5.0], signals.evaluate(motion, t[t > 5.0]))


def test_vessel_without_ramp_is_the_signal() -> None:
    motion: Signal = (Sine(kind="sine", amplitude=2.0, frequency=0.6),)
    sea = Environment(gravity=9.81, payload_force=(), cable_load=(), vessel_motion=motion)
    displacement, velocity = signals.vessel(sea, 1.0)
    assert displacement == 2.0 * np.sin(0.6)
    assert velocity == 2.0 * 0.6 * np.cos(0.6)


def test_a_linear_table_jumps_where_an_instant_stands_twice() -> None:
    jumping: Signal = (
        Table(kind="table", times=(0.0, 1.0, 1.0, 2.0), values=(0.0, 1.0, 5.0, 4.0), interpolation="linear"),
    )
    assert signals.evaluate(jumping, [0.5, 1.0, 1.5]).tolist() == [0.5, 5.0, 4.5]
    assert signals.evaluate(jumping, 1.0, "left").item() == 1.0
    assert signals.derivative(jumping, [0.5, 1.0, 1.5]).tolist() == [1.0, -1.0, -1.0]
    assert signals.derivative(jumping, 1.0, "left").item() == 1.0
    assert signals.jumps(jumping) == (0.0, 1.0, 2.0)


def test_a_monotone_curve_stays_in_its_data() -> None:
    steep: Signal = (
        Table(kind="table", times=(0.0, 1.0, 2.0, 3.0), values=(0.0, 0.0, 1.0, 1.0), interpolation="pchip"),
    )
    fine = np.linspace(0.0, 3.0, 301)
    found = signals.evaluate(steep, fine)
    assert (found.min(), found.max()) == (0.0, 1.0)
    assert signals.derivative(steep, fine)[1:-1] == pytest.approx(np.gradient(found, fine)[1:-1], abs=0.05)
