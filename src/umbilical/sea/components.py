"""A sea as a sum of regular waves: bins of equal energy, split where they are wide."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from umbilical.sea.spectrum import Spectrum, shape

WIDEST = 0.05
"""rad/s; a wider bin is split, so that a response with a sharp resonance sees enough waves."""
KEPT = 0.999
"""Share of the energy below which bins are split; the last part holds all that is above."""
_RATIOS = np.concatenate([np.linspace(0.2, 3.0, 20001), np.geomspace(3.0, 60.0, 4001)[1:]])


class Components(NamedTuple):
    """Regular waves ``a cos(w t - k X + phase)``; each array has the shape (waves,).

    Attributes:
        omega: angular frequency, rad/s, increasing.
        amplitude: m.
        phase: rad.
    """

    omega: np.ndarray
    amplitude: np.ndarray
    phase: np.ndarray

    @property
    def repeat_period(self) -> float:
        """Time after which the waves around the peak are nearly back in phase, s: a longer run repeats itself."""
        energy = np.cumsum(self.amplitude**2)
        middle = np.searchsorted(energy, np.array([0.25, 0.75]) * energy[-1])
        return float(2.0 * np.pi / np.diff(self.omega[middle[0] : middle[1] + 1]).mean())

    def elevation(self, time: np.ndarray) -> np.ndarray:
        """Surface elevation at the origin, m, at instants of shape (n,)."""
        return np.cos(np.outer(time, self.omega) + self.phase) @ self.amplitude


def discretise(
    spectrum: Spectrum, count: int = 100, *, seed: int = 0, system: int = 0, rayleigh: bool = False
) -> Components:
    """Divide a spectrum into regular waves.

    Args:
        spectrum: the sea.
        count: bins of equal energy, 20 or more; splitting adds some.
        seed: of the phases.
        system: number of the wave system, so that a swell leaves the phases of the wind sea as they are.
        rayleigh: draw the amplitudes, too, as those of a Gaussian sea are; else ``sum a^2/2 = Hs^2/16`` exactly.

    Returns:
        Waves at the median energy of each bin. The phase of wave j depends on seed, system and j only.

    Raises:
        ValueError: fewer than 20 bins.

    >>> waves = discretise(Spectrum(2.0, 8.0), 100, seed=1)
    >>> round(float((waves.amplitude**2).sum()) / 2.0, 12)
    0.25
    """
    if count < 20:
        raise ValueError(f"count = {count}: 20 or more, fewer are no spectrum")
    shares = _split(spectrum, np.arange(count + 1) / count)
    energy = np.diff(shares) * spectrum.significant_height**2 / 16.0
    omega = _frequency_at(spectrum, 0.5 * (shares[1:] + shares[:-1]))
    dice = np.random.Generator(np.random.Philox(key=np.array([seed, system], dtype=np.uint64)))
    phase = dice.uniform(0.0, 2.0 * np.pi, omega.size)
    drawn = dice.rayleigh(np.sqrt(0.5), omega.size) if rayleigh else 1.0
    return Components(omega, np.sqrt(2.0 * energy) * drawn, phase)


def _split(spectrum: Spectrum, shares: np.ndarray) -> np.ndarray:
    """Shares of energy at the edges of bins none of which, below :data:`KEPT`, is wider than :data:`WIDEST`."""
    top = min(KEPT, 1.0 - 1e-3 / shares.size)
    edges = _frequency_at(spectrum, np.append(shares[:-1], top))
    parts = np.maximum(np.ceil(np.diff(edges) / WIDEST), 1).astype(int)
    parts[0] = 1  # there is nothing in the lower half of the first one
    inner = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(edges[:-1], edges[1:], parts, strict=True)]
    cut = np.concatenate([_share_below(spectrum, part) for part in inner])
    return np.concatenate([[0.0], cut[1:], [1.0]])


@lru_cache(maxsize=64)
def _cumulative(peakedness: float) -> np.ndarray:
    """Share of the energy below each of the ratios w/wp in the table."""
    from scipy.integrate import cumulative_trapezoid  # slow to import

    energy = cumulative_trapezoid(shape(_RATIOS, peakedness), _RATIOS, initial=0.0)
    tail = 5.0 / 64.0 * _RATIOS[-1] ** -4.0  # of x^-5, all that is left there
    return energy / (energy[-1] + tail)


def _frequency_at(spectrum: Spectrum, share: np.ndarray) -> np.ndarray:
    """Angular frequencies, rad/s, below which the given shares of the energy lie."""
    return spectrum.peak_frequency * np.interp(share, _cumulative(spectrum.peakedness), _RATIOS)


def _share_below(spectrum: Spectrum, omega: np.ndarray) -> np.ndarray:
    return np.interp(omega / spectrum.peak_frequency, _RATIOS, _cumulative(spectrum.peakedness))
