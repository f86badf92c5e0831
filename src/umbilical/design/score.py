"""How good a set of gains is, from the sampled loop without a grid: milliseconds for one set.

What the controlled ROV reflects does not depend on the length of the cable. Above the first modes the echo
may return in any phase, so a loop that survives a change at *every* length from the shortest on is one that
then reflects no more than the shortest cable takes away in a round trip::

    |echo| |R(w; f)| < 1 at all w      for f = gain, 1/gain, lag, lead, delay

together with a stable loop on a cable without an end. That is a little more than stability at one length asks.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from umbilical.analysis.impedance import HangingCable, hanging_cable, waves
from umbilical.analysis.limits import later, scaled, turned
from umbilical.analysis.nyquist import Factor, unchanged
from umbilical.analysis.sampled import SampledLoop, delivered, demands_to_volts, loop_response
from umbilical.scenario.scenario import Scenario

POINTS = 140
"""Frequencies from far below the first mode to half the sampling frequency."""
ARC = 12
FEW_ALIASES = 2
"""Enough to rank gains; what is chosen is judged with all of them."""
FIRST_MODES = (0.3, 2.2)
"""Band of the first modes in shares of 2 pi over the round trip: from the free ROV's first to about its fourth."""
SPARE = 0.9997
"""What is asked of the largest round trip, a little below 1."""


@dataclass(frozen=True)
class Demands:
    """Margins that a design shall have: gain as a factor both ways, phase in rad, delay in control periods."""

    gain: float = 10.0 ** (6.0 / 20.0)
    phase: float = float(np.deg2rad(30.0))
    periods: float = 2.0


class Score(NamedTuple):
    """What a set of gains gives.

    Attributes:
        reflection: largest |R| in the band of the first modes.
        compliance: largest displacement of the ROV per force on it in that band, m/N, echoes left out.
        trips: largest size of a round trip under each change that the loop shall survive: below 1, it does.
        binding: which change comes closest, and at which frequency, rad/s.
        unstable: poles outside the unit circle on a cable without an end, under the demanded margins.
    """

    reflection: float
    compliance: float
    trips: np.ndarray
    binding: tuple[str, float]
    unstable: int

    @property
    def trip(self) -> float:
        """The largest of the round trips."""
        return float(self.trips.max())

    @property
    def sound(self) -> bool:
        """Whether the demanded margins are there, at every length."""
        return self.trip < 1.0 and self.unstable == 0


def changes(demands: Demands, period: float) -> dict[str, Factor]:
    """What the loop shall survive, by name."""
    return {
        "as it is": unchanged,
        "more thrust": scaled(demands.gain),
        "less thrust": scaled(1.0 / demands.gain),
        "lag": turned(demands.phase),
        "lead": turned(-demands.phase),
        "delay": later(demands.periods * period),
        "half the delay": later(0.5 * demands.periods * period),
    }


class Judge:
    """Scores loops of one scenario's cable; what does not depend on the gains is computed once."""

    def __init__(self, scenario: Scenario, shortest: float, demands: Demands) -> None:
        self.cable: HangingCable = hanging_cable(scenario, shortest)
        self.changes = changes(demands, scenario.control.period)
        trip = self.cable.round_trip
        outer = scenario.control.outer_period or scenario.control.period
        self.w = np.geomspace(0.02 * np.pi / trip, 0.999 * np.pi / outer, POINTS)
        arc = self.w[0] * np.exp(0.5j * np.pi * np.linspace(0.0, 1.0, ARC))
        self.p = np.concatenate([arc, 1j * self.w])
        self.met = waves(self.cable, self.p)
        self.loudness = np.abs(self.met.echo[ARC:])
        self.band = (self.w > FIRST_MODES[0] * 2.0 * np.pi / trip) & (self.w < FIRST_MODES[1] * 2.0 * np.pi / trip)

    def score(self, loop: SampledLoop) -> Score:
        """All of a loop's numbers."""
        r = loop_response(self.cable, loop, self.p, self.met, FEW_ALIASES)
        a2, b, b2 = r.up2 / r.up1, r.down1 / r.up1, r.down2 / r.up1
        sizes, endless = [], []
        for factor in self.changes.values():
            f = factor(self.p)
            endless.append(1.0 - f * a2)
            sizes.append(self.loudness * np.abs((b - f * b2) / endless[-1])[ARC:])
        place = np.unravel_index(np.argmax(sizes), np.shape(sizes))
        binding = (list(self.changes)[place[0]], float(self.w[place[1]]))
        unstable = max(_unstable(loop, curve) for curve in endless)
        calm = np.abs(1.0 / (r.up1 - r.up2))[ARC:][self.band]
        reflection = np.abs(r.reflection())[ARC:][self.band]
        return Score(float(reflection.max()), float(calm.max()), np.max(sizes, axis=1), binding, unstable)

    def motor_lag(self, loop: SampledLoop, frequency: float) -> tuple[float, float]:
        """Lag of the motors and of everything else in the loop's own electronics at a frequency, rad."""
        p = np.array([1j * frequency])
        through = delivered(loop, p, demands_to_volts(loop, p))[0]
        z = np.exp(p[0] * loop.outer_period)
        hold = (1.0 - 1.0 / z) / (p[0] * loop.outer_period)
        return float(-np.angle(through / hold)), float(-np.angle(hold))


def _unstable(loop: SampledLoop, endless: np.ndarray) -> int:
    """Nyquist's count on a cable without an end; as in :func:`umbilical.analysis.nyquist.stability`."""
    angle = np.unwrap(np.angle(endless))
    return round(loop.own_poles - (angle[-1] - angle[0]) / np.pi)
