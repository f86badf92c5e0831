"""A high-gain observer against differences of the same sampled signal, over the sensor's noise and eps.

All of them are linear filters of the samples. So the error has two parts that can be added as squares: what a filter
makes of the exact samples (its lag), and the standard deviation of white noise times the norm of its impulse response.

Rivals of the observer ``s/(eps s + 1)^2`` (17), (19):

- the backward difference ``(x_k - x_(k-1))/h``;
- the same behind one pole of the time constant ``lam eps``, which lags as much as the observer does;
- the same behind two poles of the time constant ``eps``, the observer's own.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.control.observers.high_gain import make_high_gain
from umbilical.scenario.control import HighGainObserver

EPS = np.geomspace(2.5e-4, 0.1, 12)
"""s, time constants of the observer."""
DAMPING = 2.0
"""lam of the observers: two equal poles."""
RIVALS = ("difference", "one pole", "two poles")
RESPONSE = 200_000
"""Samples of an impulse response: 2000 times the longest of EPS at a period of 1 ms."""


class Filter(NamedTuple):
    """``sum a_j y_(k-j) = sum b_j x_(k-j)``."""

    b: np.ndarray
    a: np.ndarray


class Errors(NamedTuple):
    """Of one estimate: lag (root mean square, unit of the rate) and noise (that per unit of noise, 1/s)."""

    lag: float
    noise: float

    def at(self, noise: float | np.ndarray) -> np.ndarray:
        """Root mean square of the error at a standard deviation of the noise."""
        return np.hypot(self.lag, self.noise * np.asarray(noise))


def observer(eps: float, period: float) -> Filter:
    """The paper's observer as it runs: advanced exactly for the sample held over the period."""
    made = make_high_gain(HighGainObserver(time_constant=eps, damping=DAMPING), period)
    f = made.form
    determinant = f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0]
    b = np.array([f[1, 2], f[1, 0] * f[0, 2] - f[0, 0] * f[1, 2]]) / made.time_constant
    return Filter(b, np.array([1.0, -f[0, 0] - f[1, 1], determinant]))


def rival(name: str, eps: float, period: float) -> Filter:
    """One of RIVALS, of a lag comparable to that of the observer with ``eps``."""
    difference = np.array([1.0, -1.0]) / period
    if name == "difference":
        return Filter(difference, np.ones(1))
    poles = [np.exp(-period / (DAMPING * eps))] if name == "one pole" else [np.exp(-period / eps)] * 2
    return Filter(difference * np.prod([1.0 - pole for pole in poles]), np.poly(poles))


def errors(filter_: Filter, samples: np.ndarray, rate: np.ndarray) -> Errors:
    """Lag and noise of an estimate of ``rate`` from ``samples``, both of shape (n,); it starts at rest."""
    from scipy.signal import lfilter

    lag = np.sqrt(np.mean((lfilter(*filter_, samples - samples[0]) - rate) ** 2))
    return Errors(float(lag), noise_gain(filter_))


def noise_gain(filter_: Filter) -> float:
    """Standard deviation of the estimate per unit of white noise of the samples, 1/s."""
    from scipy.signal import lfilter

    pulse = np.zeros(RESPONSE)
    pulse[0] = 1.0
    return float(np.linalg.norm(lfilter(*filter_, pulse)))


def crossing(one: Errors, other: Errors) -> float:
    """Noise from which on ``one`` errs less than ``other``; 0 where it always does, infinite where it never does."""
    more_lag, less_noise = one.lag**2 - other.lag**2, other.noise**2 - one.noise**2
    if less_noise <= 0.0:
        return 0.0 if more_lag < 0.0 and less_noise == 0.0 else np.inf
    return float(np.sqrt(max(more_lag, 0.0) / less_noise))
