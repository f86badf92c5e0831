"""Lowering: which winch speed takes the body through the resonance depths with the least risk of slack.

At each depth the cable is as in :mod:`umbilical.screening.response`, with the body sinking at the winch's speed: its
mean drag takes tension away, and what it moves through damps it. Over the descent the expected number of slack events
is ``N = int nu exp(-T^2/(2 sigma^2)) dz/v``, and the risk ``1 - exp(-N)``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from umbilical.screening.labels import ScreeningResult
from umbilical.screening.operation import Operation
from umbilical.screening.response import respond
from umbilical.sea.spectrum import Spectrum

BAND = (0.8, 1.25)
"""T1/Tp between which a depth counts as resonant."""


@dataclass(frozen=True)
class Lowering(ScreeningResult):
    """Risk over the winch speed.

    Attributes:
        operation: vessel, cable, body.
        depth: m, shape (d,).
        speed: m/s, shape (s,).
        slack_rate: expected slack events per second, shape (s, d).
        mean_tension: at the body, N, shape (s, d).
        axial_period: T1, s, shape (d,).
        spectrum: the sea.
        heading: rad.
    """

    shown_by: ClassVar[str] = "umbilical.faces.lowering"
    drawn_by: ClassVar[str] = "plot_lowering"

    operation: Operation
    depth: np.ndarray
    speed: np.ndarray
    slack_rate: np.ndarray
    mean_tension: np.ndarray
    axial_period: np.ndarray
    spectrum: Spectrum
    heading: float

    @property
    def risk(self) -> np.ndarray:
        """Probability of slack during the descent, shape (s,); 1 where the mean tension is not above 0."""
        events = np.trapezoid(self.slack_rate, self.depth, axis=1) / self.speed
        return np.where((self.mean_tension > 0.0).all(axis=1), -np.expm1(-events), 1.0)

    @property
    def best(self) -> int:
        """Place of the speed with the least risk."""
        return int(np.argmin(self.risk))

    @property
    def resonant(self) -> np.ndarray:
        """Whether each depth is resonant with the peak of the sea."""
        ratio = self.axial_period / self.spectrum.peak_period
        return (ratio > BAND[0]) & (ratio < BAND[1])

    @property
    def waiting_depth(self) -> float:
        """Depth outside the resonant band where waiting is safest at the lowest speed, m."""
        rate = np.where(self.resonant, np.inf, self.slack_rate[int(np.argmin(self.speed))])
        return float(self.depth[int(np.argmin(rate))])

    def summary(self) -> str:
        """Best speed, its risk and where the resonance is, in one line."""
        speed, risk = self.speed[self.best], self.risk[self.best]
        band = self.depth[self.resonant]
        where = f"resonant from {band[0]:.4g} to {band[-1]:.4g} m" if band.size else "no depth is resonant"
        return (
            f"{self.operation.name}: {speed:.3g} m/s is best from {self.depth[0]:.4g} to {self.depth[-1]:.4g} m, "
            f"slack with probability {risk:.2g} in "
            f"{np.ptp(self.depth) / speed / 60.0:.3g} min; {where}"
        )

    def to_dict(self) -> dict[str, Any]:
        """As plain data."""
        return self.plain(
            "depth speed risk axial_period mean_tension", significant_height=self.spectrum.significant_height,
            peak_period=self.spectrum.peak_period, heading=self.heading, best_speed=float(self.speed[self.best]),
            waiting_depth=self.waiting_depth,
        )  # fmt: skip


def lower(
    operation: Operation, spectrum: Spectrum, *, heading: float, depth: np.ndarray, speed: np.ndarray,
    progress: Callable[[float], None] = lambda share: None,
) -> Lowering:  # fmt: skip
    """Compute the risk of slack over a descent at each of several winch speeds.

    Args:
        operation: vessel, cable, body.
        spectrum: the sea, long-crested.
        heading: direction the waves go to, rad.
        depth: increasing, m, shape (d,).
        speed: winch speeds above 0, m/s, shape (s,).
        progress: called with the share that is done.

    >>> import numpy as np
    >>> from umbilical.screening import load_operation
    >>> found = lower(load_operation("work-class"), Spectrum(1.5, 8.0), heading=np.radians(135.0),
    ...               depth=np.linspace(100.0, 3000.0, 8), speed=np.array([0.5, 3.0]))
    >>> bool(found.risk[1] == 1.0), found.best  # at 3 m/s it sinks faster than it can fall
    (True, 0)
    """
    depth, speed = np.asarray(depth, dtype=float), np.asarray(speed, dtype=float)
    found = []
    for number, v in enumerate(speed):
        found.append([respond(operation, spectrum, depth=z, heading=heading, payout_speed=v) for z in depth.tolist()])
        progress((number + 1) / speed.size)
    rate = [[np.exp(-0.5 * (max(r.end_mean, 0.0) / r.end.rms) ** 2) / r.end.period for r in row] for row in found]
    mean = np.array([[r.end_mean for r in row] for row in found])
    axial = np.array([r.axial_period for r in found[0]])
    return Lowering(operation, depth, speed, np.array(rate), mean, axial, spectrum, heading)
