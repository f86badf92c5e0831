"""Observers in their discrete forms against exact responses of their equations, and the transfer of each estimate."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import exp

import numpy as np

from umbilical.control.motor import disturbance as of_motor
from umbilical.control.observers import disturbance as of_payload
from umbilical.control.observers import high_gain
from umbilical.relations.formulas import motor_constants
from umbilical.scenario.control import DisturbanceObserver, HighGainObserver
from umbilical.scenario.hardware import Motor
from umbilical.verify.cases import Case, Check, each_close, history_close
from umbilical.verify.motor import MOTOR
from umbilical.verify.references import observers as exact

PERIOD, EPS, GAIN, MOTOR_GAIN = 1e-3, 0.005, 5.0, 100.0
FREQUENCIES = (5.0, 50.0, 200.0)
ROUND_OFF = 1e-9
WHY = "the discrete form is exact: round-off; a gain off by two misses by 1"
FIRST_ORDER = "first order in the period of 1 ms; a gain off by two misses by 1"

Array = np.ndarray


def estimated_derivative(samples: Array, damping: float = 2.0) -> Array:
    """Estimates of a signal's derivative at every sample but the first."""
    observer = high_gain.make_high_gain(HighGainObserver(time_constant=EPS, damping=damping), PERIOD)
    memory, out = high_gain.HighGainMemory.one(), []
    high_gain.start_high_gain(memory, samples[0])
    for sample in samples[1:]:
        high_gain.advance_high_gain(observer, memory, sample)
        out.append(high_gain.derivative_estimate(observer, memory))
    return np.array(out)


def _payload_disturbance(mass: float, error: float, force: float, velocity: Array, coupling: float = 2.0) -> Array:
    """Estimates of D at the samples of Dy/Dt, while u_a and the known force are constant."""
    observer = of_payload.make_disturbance(DisturbanceObserver(gain=GAIN, coupling=coupling), PERIOD)
    memory = of_payload.DisturbanceMemory.one()
    of_payload.start_disturbance(observer, memory, mass, velocity[0])
    out = [of_payload.disturbance_estimate(observer, memory, mass, velocity[0])]
    for w in velocity[1:]:
        of_payload.advance_disturbance(observer, memory, mass, w, error, force)
        out.append(of_payload.disturbance_estimate(observer, memory, mass, w))
    return np.array(out)


def motor_disturbance(scaled_current: Array, speed: float, drive: float) -> Array:
    """Estimates of f23 d2 at the samples of z2, while the speed and V are held."""
    constants, gain = motor_constants(Motor.model_validate(MOTOR)), MOTOR_GAIN
    ups = of_motor.start_motor_disturbance(gain, scaled_current[0])
    out = [ups + gain * scaled_current[0]]
    for z2 in scaled_current[1:]:
        ups = of_motor.advance_motor_disturbance(constants, gain, exp(-gain * PERIOD), ups, speed, z2, drive)
        out.append(ups + gain * z2)
    return np.array(out)


def _measured_transfer(estimate: Callable[[Array], Array], frequency: float, count: int = 8000) -> complex:
    """Gain and phase from the samples of a sine to an estimate, once the start has died away."""
    t = np.arange(count + 1) * PERIOD
    found = estimate(np.sin(frequency * t))[-1000:]
    angle = frequency * t[-1000:]
    measured = np.linalg.lstsq(np.stack([np.sin(angle), np.cos(angle)], axis=1), found, rcond=None)[0]
    return complex(measured[0], measured[1])


def _high_gain_responses() -> Iterator[Check]:
    """A unit step, and sines from slow to beyond the observer's own frequency of 200 rad/s."""
    t = np.arange(1, 60) * PERIOD
    for damping in (2.0, 1.0):
        found = estimated_derivative(np.append(0.0, np.ones(t.size)), damping)
        wanted = exact.high_gain_step(EPS, damping, t)
        yield history_close(f"unit step, lam = {damping:g}, 1/s", found, wanted, ROUND_OFF, WHY)
    found = np.array([_measured_transfer(estimated_derivative, w, 2000) for w in FREQUENCIES])
    wanted = np.array([exact.high_gain_transfer(EPS, 2.0, w, PERIOD) for w in FREQUENCIES])
    why = "the tail of the sum over images"
    yield each_close("transfer at 5, 50, 200 rad/s, the worst, rad/s", np.abs(found), np.abs(wanted), 1e-4, why)
    yield each_close("its phase, rad, the worst", np.angle(found), np.angle(wanted), 1e-4, why)


def _payload_responses() -> Iterator[Check]:
    """A ROV held still, one pushed by a constant D, and one pushed by a sine."""
    t = np.arange(1000) * PERIOD
    still = _payload_disturbance(500.0, 0.3, 20.0, np.zeros(t.size))
    yield history_close("held still, D^, N", still, 20.6 * exact.first_order(GAIN, t), ROUND_OFF, WHY)
    pushed = _payload_disturbance(500.0, 0.0, 0.0, 0.2 * t)
    yield history_close("pushed by 100 N, D^, N", pushed, 100.0 * exact.first_order(GAIN, t), 5e-3, FIRST_ORDER)
    found, wanted = [], []
    for w in (1.0, 5.0, 20.0):
        # Under D = m w cos(w t) the ROV moves with sin(w t): from the velocity to D^ it is m s k/(s + k).
        found.append(_measured_transfer(lambda velocity: _payload_disturbance(500.0, 0.0, 0.0, velocity), w))
        wanted.append(500.0j * w * exact.first_order_transfer(GAIN, w))
    yield each_close("transfer at 1, 5, 20 rad/s, the worst, N s/m", np.abs(found), np.abs(wanted), 2e-2, FIRST_ORDER)
    yield each_close("its phase, rad, the worst", np.angle(found), np.angle(wanted), 2e-2, FIRST_ORDER)


def _motor_responses() -> Iterator[Check]:
    """A motor whose current does not move although a voltage of 0.2 V is missing, and one whose current swings."""
    c = motor_constants(Motor.model_validate(MOTOR))
    t = np.arange(200) * PERIOD
    wanted = c.f23 * 0.2
    found = motor_disturbance(np.full(t.size, 200.0), 10.0, -(c.f21 * 10.0 + c.f22 * 200.0 + wanted))
    yield history_close("d2 = 0.2 V, d^, rad/s3", found, wanted * exact.first_order(MOTOR_GAIN, t), ROUND_OFF, WHY)
    transfer, ideal = [], []
    for w in (5.0, 20.0):
        # z2' = f22 z2 + f23 d2 with z2 = sin(w t): f23 d2 = (s - f22) z2.
        transfer.append(_measured_transfer(lambda z2: motor_disturbance(z2, 0.0, 0.0), w))
        ideal.append((1j * w - c.f22) * exact.first_order_transfer(MOTOR_GAIN, w))
    why = "first order in the period, g_o h = 0.1; a gain off by two misses by 1"
    yield each_close("transfer at 5, 20 rad/s, the worst, rad/s3", np.abs(transfer), np.abs(ideal), 5e-2, why)


CASES = (
    Case("high-gain observer", "s/(eps^2 s^2 + lam eps s + 1)", "eqs. (17), (19)", _high_gain_responses),
    Case("disturbance observer of the ROV", "k_s/(s + k_s)", "eq. (21)", _payload_responses),
    Case("disturbance observer of a motor", "g_o/(s + g_o)", "eq. (61)", _motor_responses),
)
