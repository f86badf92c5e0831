"""Deliberately wrong models fail the checks of the right one, by ten times the tolerance at least.

Each breaks one thing on its way into the kernels and measures what the reference test measures.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from tests.control.test_observers import TRANSFER, exact_transfer, high_gain, measured_transfer
from tests.convergence.test_power_balance_order import residual
from tests.engine.test_events import MOMENTUM, TIP_MASS, pulse, pushed, stuck
from tests.reference import test_bessel_frequencies as bessel
from tests.reference import test_delay_equation as moving_end
from tests.reference import test_model_crosscheck as crosscheck
from tests.support.scenarios import run
from umbilical.control.allocation import adaptive
from umbilical.plant import faults, winch
from umbilical.scenario.control import AdaptiveAllocation

MARGIN = 10.0


@pytest.mark.parametrize("speed", [5.0, -4.0])
def test_wrong_sign_of_the_winch_speed(speed: float, monkeypatch: pytest.MonkeyPatch) -> None:
    right = winch.evaluate

    def wrong(*arguments: Any) -> winch.WinchMotion:
        motion = right(*arguments)
        return motion._replace(speed=-motion.speed)

    monkeypatch.setattr(winch, "evaluate", wrong)
    result = moving_end.released(speed, step=2.5e-4)
    everywhere, tip = moving_end.distance(result, moving_end.reference(speed, until=60.0), speed)
    assert min(everywhere, tip) > MARGIN * moving_end.TOLERANCE


@pytest.mark.parametrize("way", [(100.0, 130.0), (130.0, 100.0)])
def test_dropped_jerk_in_the_power_balance(way: tuple[float, float], monkeypatch: pytest.MonkeyPatch) -> None:
    right = winch.evaluate
    whole = residual(way, 16, 1e-3)

    def wrong(*arguments: Any) -> winch.WinchMotion:
        motion = right(*arguments)
        return motion._replace(jerk=0.0 * motion.jerk)

    monkeypatch.setattr(winch, "evaluate", wrong)
    assert residual(way, 16, 1e-3) > MARGIN * max(whole, 1e-4)


def test_half_the_inertia_at_the_tip() -> None:
    """Half the mass under twice the gravity pulls as before and weighs half: T is right, m is not."""
    right = bessel.hanging(500.0, grid__elements=24)
    wrong = right.replace({"payload.mass": 250.0, "cable.wet_line_density": 1.0, "environment.gravity": 20.0})
    exact = bessel.bessel_frequencies(2.0, 500.0, 500.0, 6)
    assert np.abs(bessel.six(wrong) / exact - 1.0).max() > MARGIN * bessel.TOLERANCE
    assert np.abs(bessel.six(right) / exact - 1.0).max() < bessel.TOLERANCE


@pytest.mark.nojit
@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_high_gain_observer_off_by_two(factor: float) -> None:
    found, exact = measured_transfer(high_gain(time_constant=0.005 * factor), 200.0), exact_transfer(200.0)
    assert abs(found - exact) > MARGIN * TRANSFER * abs(exact)


@pytest.mark.parametrize("gain", [5.0, 20.0])
def test_disturbance_observer_off_by_two(gain: float) -> None:
    found = run(umbilical.load("crosscheck-proposed", {"control.disturbance_observer.gain": gain})).metrics["tip_peak"]
    assert abs(found / crosscheck.PROPOSED - 1.0) > MARGIN * crosscheck.TOLERANCE


@pytest.mark.nojit
def test_a_fault_one_step_late(monkeypatch: pytest.MonkeyPatch) -> None:
    right = faults.effect

    def wrong(timeline: Any, motor: int, target: Any, t: Any, side: Any = "right") -> Any:
        return right(timeline, motor, target, np.asarray(t) - 1e-3, side)

    monkeypatch.setattr(faults, "effect", wrong)
    velocity = stuck(0.05)["tip_velocity"].values[55]
    assert abs(velocity / (80.0 * 0.005 / TIP_MASS) - 1.0) > MARGIN * MOMENTUM


@pytest.mark.nojit
def test_a_pulse_between_two_steps_that_nobody_publishes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("umbilical.engine.simulate.published_jumps", lambda scenario: ())
    velocity = pushed(pulse(0.05003, 0.05013))["tip_velocity"].values[51]
    assert velocity == 0.0


@pytest.mark.nojit
def test_wrong_sign_of_the_adaptive_law() -> None:
    """The ratchet turns the other way: kappa_0 falls where (27) makes it grow."""
    record = AdaptiveAllocation(method="adaptive", rates=(0.1, 100.0, 50.0), leak=0.2, initial=(0.25, 0.0, 0.5))
    law = adaptive.make_adaptation(record, 2, 1e-3)
    law.form[adaptive.GAIN] *= -1.0
    kappa = adaptive.initial_kappa(record, 2)
    adaptive.adapt(law, kappa, 80.0, 0.05)
    exact = 0.25 - 0.1 * 1e-3 * (80.0 * 0.05 + 0.2 * 0.25)
    assert abs(kappa[0] - exact) > MARGIN * 1e-12 * abs(exact)
    assert (kappa[0] - 0.25) * (exact - 0.25) < 0.0
