"""Observers in their discrete forms against exact responses, and their transfer functions."""

from __future__ import annotations

from math import exp

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from umbilical.control.linear import held_input_form
from umbilical.control.motor.disturbance import advance_motor_disturbance, start_motor_disturbance
from umbilical.control.observers.disturbance import (
    advance_disturbance,
    disturbance_estimate,
    make_disturbance,
    start_disturbance,
)
from umbilical.control.observers.high_gain import (
    HighGain,
    advance_high_gain,
    derivative_estimate,
    make_high_gain,
    start_high_gain,
)
from umbilical.relations.formulas import motor_constants
from umbilical.scenario.control import DisturbanceObserver, HighGainObserver
from umbilical.scenario.hardware import Motor

pytestmark = pytest.mark.nojit

PERIOD, EPS, TRANSFER = 1e-3, 0.005, 2e-2
MOTOR = Motor(
    inertia=0.5, viscous_friction=0.015, torque_constant=4.0, load_coefficient=1.0, resistance=0.08, inductance=0.002,
    back_emf_constant=0.5, thrust_coefficient=1.0,
)  # fmt: skip


def high_gain(damping: float = 2.0, time_constant: float = EPS) -> HighGain:
    return make_high_gain(HighGainObserver(time_constant=time_constant, damping=damping), PERIOD)


def estimates(observer: HighGain, samples: np.ndarray) -> np.ndarray:
    """Estimate of the derivative at every sample; the sample at t_k is held since t_(k-1)."""
    state, out = np.zeros(2), []
    start_high_gain(state, samples[0])
    for sample in samples[1:]:
        advance_high_gain(observer, state, sample)
        out.append(derivative_estimate(observer, state))
    return np.array(out)


def test_high_gain_step_response_is_exact() -> None:
    """Critically damped (lam = 2), a unit step gives ``x2^ = t/eps^2 exp(-t/eps)``."""
    t = np.arange(1, 60) * PERIOD
    found = estimates(high_gain(), np.append(0.0, np.ones(t.size)))
    np.testing.assert_allclose(found, t / EPS**2 * np.exp(-t / EPS), rtol=1e-11)


def test_high_gain_underdamped_step_response_is_exact() -> None:
    """lam = 1: ``x2^ = exp(-t/(2 eps)) sin(q t/eps)/(q eps)`` with q = sqrt(3)/2."""
    t, q = np.arange(1, 60) * PERIOD, np.sqrt(3.0) / 2.0
    found = estimates(high_gain(damping=1.0), np.append(0.0, np.ones(t.size)))
    np.testing.assert_allclose(found, np.exp(-t / 2.0 / EPS) * np.sin(q * t / EPS) / (q * EPS), rtol=1e-10, atol=1e-9)


def test_high_gain_starts_at_rest_on_the_first_sample() -> None:
    assert np.abs(estimates(high_gain(), np.full(50, 7.0))).max() < 1e-11


def measured_transfer(observer: HighGain, frequency: float) -> complex:
    """Gain and phase from a sine to the estimate of its derivative, once the start has died away."""
    t = np.arange(0, 2000) * PERIOD
    found = estimates(observer, np.sin(frequency * t))[-1000:]
    angle = frequency * t[-1000:]
    measured = np.linalg.lstsq(np.stack([np.sin(angle), np.cos(angle)], axis=1), found, rcond=None)[0]
    return complex(measured[0], measured[1])


def exact_transfer(frequency: float) -> complex:
    """``s/(eps^2 s^2 + lam eps s + 1)``, of a signal that is held at its sample over the period before it."""
    s = 1j * frequency
    hold = (1.0 - np.exp(-s * PERIOD)) / (s * PERIOD) * np.exp(s * PERIOD)
    return complex(s / (EPS**2 * s**2 + 2.0 * EPS * s + 1.0) * hold)


@pytest.mark.parametrize("frequency", [5.0, 50.0, 200.0])
def test_high_gain_transfer_function(frequency: float) -> None:
    exact = exact_transfer(frequency)
    assert abs(measured_transfer(high_gain(), frequency) - exact) < TRANSFER * abs(exact)


def test_held_input_form_against_an_integration() -> None:
    a, b = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-8e6, -1.2e5, -600.0]]), np.array([0.0, 0.0, 8e6])
    form = held_input_form(a, b, PERIOD)
    for state, value in (([1.0, 0.0, 0.0], 0.0), ([0.3, -2.0, 50.0], 1.5)):
        exact = solve_ivp(
            lambda _, x, u=value: a @ x + b * u, (0.0, PERIOD), state, "DOP853", rtol=1e-12, atol=1e-12
        ).y[:, -1]
        np.testing.assert_allclose(form @ [*state, value], exact, rtol=1e-10)


def disturbance_run(mass: float, error: float, force: float, velocity: np.ndarray, coupling: float = 2.0) -> np.ndarray:
    """Estimates while ``known force`` and u_a are constant and the ROV moves with ``velocity`` at the samples."""
    observer = make_disturbance(DisturbanceObserver(gain=5.0, coupling=coupling), PERIOD)
    state, out = np.zeros(1), []
    start_disturbance(observer, state, mass, velocity[0])
    out.append(disturbance_estimate(observer, state, mass, velocity[0]))
    for w in velocity[1:]:
        advance_disturbance(observer, state, mass, w, error, force)
        out.append(disturbance_estimate(observer, state, mass, w))
    return np.array(out)


def test_disturbance_observer_of_a_payload_held_still_is_exact() -> None:
    """At rest with known force F and u_a constant: ``D^ = (vs u_a + F)(1 - exp(-k_s t))``."""
    t = np.arange(400) * PERIOD
    found = disturbance_run(500.0, 0.3, 20.0, np.zeros(t.size))
    np.testing.assert_allclose(found, (2.0 * 0.3 + 20.0) * (1.0 - np.exp(-5.0 * t)), rtol=1e-12, atol=1e-12)


def test_disturbance_observer_converges_at_its_gain() -> None:
    """A ROV pushed by D alone, m w' = D: ``D^' = k_s (D - D^)`` in the limit of short periods."""
    t, push = np.arange(1000) * PERIOD, 100.0
    found = disturbance_run(500.0, 0.0, 0.0, push / 500.0 * t)
    np.testing.assert_allclose(found, push * (1.0 - np.exp(-5.0 * t)), atol=0.003 * push)
    assert found[-1] > 0.98 * push


@pytest.mark.parametrize("record", [None, DisturbanceObserver(enabled=False, gain=5.0, coupling=1.0)])
def test_absent_disturbance_observer_estimates_nothing(record: DisturbanceObserver | None) -> None:
    observer = make_disturbance(record, PERIOD)
    state = np.zeros(1)
    start_disturbance(observer, state, 500.0, 1.0)
    advance_disturbance(observer, state, 500.0, 1.0, 1.0, 100.0)
    assert disturbance_estimate(observer, state, 500.0, 1.0) == 0.0


def test_motor_disturbance_observer_is_exact_for_held_signals() -> None:
    """With z1, z2 and V held, ``ups' = -g (ups + g z2 + f21 z1 + f22 z2 + V)`` has an exponential for its answer."""
    c, gain = motor_constants(MOTOR), 100.0
    z1, z2, v = 12.0, 300.0, 5e4
    ups = start_motor_disturbance(gain, z2)
    assert ups + gain * z2 == 0.0
    known = gain * z2 + c.f21 * z1 + c.f22 * z2 + v
    for k in range(1, 20):
        ups = advance_motor_disturbance(c, gain, exp(-gain * PERIOD), ups, z1, z2, v)
        assert ups == pytest.approx(-known + (known - gain * z2) * exp(-gain * k * PERIOD), rel=1e-11)


def test_motor_disturbance_observer_finds_the_disturbance() -> None:
    """At rest in the disturbed current equation, 0 = f21 z1 + f22 z2 + V + f23 d2: the estimate tends to f23 d2."""
    c, gain, d2 = motor_constants(MOTOR), 100.0, 0.2
    z1, z2 = 10.0, 200.0
    v = -(c.f21 * z1 + c.f22 * z2 + c.f23 * d2)
    ups = start_motor_disturbance(gain, z2)
    for _ in range(400):
        ups = advance_motor_disturbance(c, gain, exp(-gain * PERIOD), ups, z1, z2, v)
    assert ups + gain * z2 == pytest.approx(c.f23 * d2, rel=1e-10)
