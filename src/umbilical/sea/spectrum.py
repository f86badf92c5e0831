"""Wave spectra of Pierson and Moskowitz (ISSC) and JONSWAP, one-sided in the angular frequency w::

    S_PM = 5/16 Hs^2 wp^4 w^-5 exp(-5/4 (wp/w)^4)
    S_J  = A S_PM gamma^exp(-((w - wp)/(s wp))^2/2),    s = 0.07 (w <= wp), 0.09 (w > wp)

A(gamma) keeps m0 = Hs^2/16. It is found by quadrature: the usual 1 - 0.287 ln(gamma) is 0.24 % off at 3.3.
Source: Pierson and Moskowitz 1964, ISSC 1964, Hasselmann et al. 1973.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

Period = Literal["peak", "zero_crossing", "mean"]
"""Tp = 2 pi/wp, Tz = 2 pi sqrt(m0/m2), T1 = 2 pi m0/m1."""
_BELOW, _ABOVE = 0.07, 0.09


@dataclass(frozen=True)
class Spectrum:
    """A sea state as a spectrum of its surface elevation.

    Attributes:
        significant_height: Hs = 4 sqrt(m0), m.
        peak_period: Tp, s.
        peakedness: gamma; 1 is Pierson-Moskowitz.

    >>> sea = Spectrum(2.5, 8.0, 3.3)
    >>> round(4.0 * sea.moment(0) ** 0.5, 6), round(sea.period("zero_crossing"), 4)
    (2.5, 6.2192)
    """

    significant_height: float
    peak_period: float
    peakedness: float = 3.3

    @property
    def peak_frequency(self) -> float:
        """Angular frequency of the peak wp, rad/s."""
        return 2.0 * np.pi / self.peak_period

    def density(self, omega: np.ndarray) -> np.ndarray:
        """Spectral density, m2 s/rad, at angular frequencies above 0, of any shape."""
        ratio = np.asarray(omega, dtype=float) / self.peak_frequency
        scale = normalisation(self.peakedness) * self.significant_height**2 / self.peak_frequency
        return scale * shape(ratio, self.peakedness)

    def moment(self, order: int) -> float:
        """Moment m_n = int w^n S dw, m2 (rad/s)^n, for n from 0 to 3; from 4 on it is infinite.

        Raises:
            ValueError: another order.
        """
        return self.significant_height**2 * self.peak_frequency**order * _moment(order, self.peakedness)

    def period(self, kind: Period) -> float:
        """Peak, zero-crossing or mean period, s."""
        return self.peak_period * period_ratio(kind, self.peakedness)


def shape(ratio: np.ndarray, peakedness: float) -> np.ndarray:
    """Spectrum over w/wp for Hs = wp = 1, before normalisation."""
    width = np.where(ratio <= 1.0, _BELOW, _ABOVE)
    peak = np.exp(-(((ratio - 1.0) / width) ** 2) / 2.0)
    return 5.0 / 16.0 * ratio**-5.0 * np.exp(-1.25 * ratio**-4.0) * peakedness**peak


def normalisation(peakedness: float) -> float:
    """A(gamma): 1 at gamma = 1.

    >>> round(normalisation(1.0), 9), round(normalisation(3.3), 6)
    (1.0, 0.65576)
    """
    return 1.0 / (16.0 * _integral(0, peakedness))


def period_ratio(kind: Period, peakedness: float) -> float:
    """The named period over the peak period; what turns Tz or T1 into Tp.

    >>> round(period_ratio("zero_crossing", 1.0), 5), round(period_ratio("mean", 1.0), 5)
    (0.71037, 0.77177)
    """
    match kind:
        case "zero_crossing":
            return float(np.sqrt(_moment(0, peakedness) / _moment(2, peakedness)))
        case "mean":
            return _moment(0, peakedness) / _moment(1, peakedness)
    return 1.0


def _moment(order: int, peakedness: float) -> float:
    """Moment for Hs = wp = 1."""
    if order not in (0, 1, 2, 3):
        raise ValueError(f"moment {order}: 0 to 3 exist, the spectrum falls with the fifth power of the frequency")
    return normalisation(peakedness) * _integral(order, peakedness)


@lru_cache(maxsize=256)
def _integral(order: int, peakedness: float) -> float:
    """Integral of x^n times the shape; pieces meet at the peak, where the width jumps."""
    pieces = ((0.05, 1.0), (1.0, 4.0), (4.0, np.inf))  # exp(-1.25/0.05^4) is 0 in doubles
    options = {"epsabs": 0.0, "epsrel": 1e-10, "limit": 200}
    from scipy.integrate import quad  # slow to import

    return sum(quad(lambda x: x**order * shape(x, peakedness), a, b, **options)[0] for a, b in pieces)
