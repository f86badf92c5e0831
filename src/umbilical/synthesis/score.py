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

from umbilical.scenario.scenario import Scenario
from umbilical.stability.impedance import FixedLengthCable, hanging_cable, waves_at_rov
from umbilical.stability.limits import Margins, delay_factor, gain_factor, phase_factor
from umbilical.stability.nyquist import Factor, unchanged
from umbilical.stability.sampled import ALIASES, LoopResponse, SampledLoop, delivered, demands_to_volts, loop_response
from umbilical.synthesis.trial import CHATTER

POINTS, FEW_POINTS = 1000, 140
"""Frequencies from far below the first mode to half the sampling frequency: to decide, and to rank gains."""
ARC = 12
FEW_ALIASES = 2
"""Enough to rank gains; what is chosen is judged with all of them."""
FIRST_MODES = (0.3, 2.2)
"""Band of the first modes in shares of 2 pi over the round trip: from the free ROV's first to about its fourth."""
SPARE = 0.9997
"""What is asked of the largest round trip, a little below 1."""
RESERVE_GAIN, RESERVE_PHASE, RESERVE_PERIODS = 10.0 ** (0.1 / 20.0), float(np.deg2rad(0.5)), 0.05
"""What a search asks for beyond the demands, so that rounded gains still keep them."""


@dataclass(frozen=True)
class Demands:
    """Margins that a design shall have: gain as a factor both ways, phase in rad, delay in control periods."""

    gain: float = 10.0 ** (6.0 / 20.0)
    phase: float = float(np.deg2rad(30.0))
    periods: float = 2.0

    def beyond(self, reserves: float) -> Demands:
        """The demands and some reserves more."""
        gain, phase = self.gain * RESERVE_GAIN**reserves, self.phase + reserves * RESERVE_PHASE
        return Demands(gain, phase, self.periods + reserves * RESERVE_PERIODS)

    def met_by(self, margins: Margins | None, period: float) -> bool:
        """Whether a loop of this control period, s, is stable and has the margins."""
        return margins is not None and margins.meets(self.gain, self.phase, self.periods * period)


class Effort(NamedTuple):
    """How hard the gains drive the motors, each number in a unit of its own that a simulation calibrates.

    A slope is put on at the ROV at once, as where a bent cable is let go, and the linear loop on a cable without an
    end answers. What it does as slowly as the first modes does not count.

    Attributes:
        voltage, speed: integral of the spectrum's size, which bounds the peak of a voltage and of the thrust.
        chatter: root mean square of the voltage above 10 Hz.
    """

    voltage: float
    speed: float
    chatter: float


class Score(NamedTuple):
    """What a set of gains gives.

    Attributes:
        reflection: largest |R| in the band of the first modes.
        compliance: largest displacement of the ROV per force on it in that band, m/N, echoes left out.
        trips: largest size of a round trip under each change that the loop shall survive: below 1, it does.
        binding: which change comes closest, and at which frequency, rad/s.
        unstable: poles outside the unit circle on a cable without an end, under the demanded margins.
        effort: of the motors.
    """

    reflection: float
    compliance: float
    trips: np.ndarray
    binding: tuple[str, float]
    unstable: int
    effort: Effort

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
        "more thrust": gain_factor(demands.gain),
        "less thrust": gain_factor(1.0 / demands.gain),
        "lag": phase_factor(demands.phase),
        "lead": phase_factor(-demands.phase),
        "delay": delay_factor(demands.periods * period),
        "half the delay": delay_factor(0.5 * demands.periods * period),
    }


class Scorer:
    """Scores loops of one scenario's cable; what does not depend on the gains is computed once.

    Args:
        scenario: whose cable and periods.
        shortest: length of the cable, m.
        demands: margins that the loop shall have.
        quick: on fewer frequencies and aliases, to rank gains; nothing is decided on those.
        efforts: whether the effort is wanted; it takes a quarter of the time.
    """

    def __init__(
        self, scenario: Scenario, shortest: float, demands: Demands, *, quick: bool = False, efforts: bool = True
    ) -> None:
        self.efforts = efforts
        self.cable: FixedLengthCable = hanging_cable(scenario, shortest)
        self.changes = changes(demands, scenario.control.period)
        self.aliases = FEW_ALIASES if quick else ALIASES
        trip = self.cable.round_trip
        outer = scenario.control.outer_period or scenario.control.period
        self.w = np.geomspace(0.02 * np.pi / trip, 0.999 * np.pi / outer, FEW_POINTS if quick else POINTS)
        arc = self.w[0] * np.exp(0.5j * np.pi * np.linspace(0.0, 1.0, ARC))
        self.p = np.concatenate([arc, 1j * self.w])
        self.met = waves_at_rov(self.cable, self.p)
        self.loudness = np.abs(self.met.echo[ARC:])
        self.band = (self.w > FIRST_MODES[0] * 2.0 * np.pi / trip) & (self.w < FIRST_MODES[1] * 2.0 * np.pi / trip)

    def score(self, loop: SampledLoop) -> Score:
        """All of a loop's numbers."""
        r = loop_response(self.cable, loop, self.p, self.met, self.aliases)
        a2, b, b2 = r.up2 / r.up1, r.down1 / r.up1, r.down2 / r.up1
        sizes, endless = [], []
        for factor in self.changes.values():
            f = factor(self.p)
            endless.append(1.0 - f * a2)
            sizes.append(self.loudness * np.abs((b - f * b2) / endless[-1])[ARC:])
        place = np.unravel_index(np.argmax(sizes), np.shape(sizes))
        binding = (list(self.changes)[place[0]], float(self.w[place[1]]))
        unstable = max(_unstable(loop, curve) for curve in endless)
        calm = r.compliance()[ARC:][self.band]
        reflection = np.abs(r.reflection())[ARC:][self.band]
        effort = self._effort(loop, r)
        return Score(float(reflection.max()), float(calm.max()), np.max(sizes, axis=1), binding, unstable, effort)

    def _effort(self, loop: SampledLoop, r: LoopResponse) -> Effort:
        if not (self.efforts and loop.drives):
            return Effort(0.0, 0.0, 0.0)
        volts = np.max(np.abs(demands_to_volts(loop, r.p)), axis=0)
        # Commanded thrust per slope put on at the ROV, N: read by the law, and a pull that it holds against.
        read, held = loop.law.response(np.exp(r.p * loop.outer_period))[:, 0, 1], r.up2 / r.up1
        commanded = np.abs((read - self.cable.tip_tension * held / r.force) / (1.0 - held))
        voltage, thrust = (volts * commanded)[ARC:], commanded[ARC:]
        shares = np.gradient(np.log(self.w))
        sudden, fast = self.w > self.w[self.band][-1], self.w > 2.0 * np.pi * CHATTER
        swings = float((voltage * shares)[sudden].sum()), float((thrust * shares)[sudden].sum())
        return Effort(*swings, float(np.sqrt((voltage**2 / self.w * shares)[fast].sum())))

    def motor_lag(self, loop: SampledLoop, frequency: float) -> tuple[float, float]:
        """Lag of the motors and of everything else in the loop's own electronics at a frequency, rad."""
        p = np.array([1j * frequency])
        through = delivered(loop, p, demands_to_volts(loop, p))[0]
        z = np.exp(p[0] * loop.outer_period)
        hold = (1.0 - 1.0 / z) / (p[0] * loop.outer_period)
        return float(-np.angle(through / hold)), float(-np.angle(hold))


def _unstable(loop: SampledLoop, endless: np.ndarray) -> int:
    """Nyquist's count on a cable without an end; as in :func:`umbilical.stability.nyquist.stability`."""
    angle = np.unwrap(np.angle(endless))
    return round(loop.own_poles - (angle[-1] - angle[0]) / np.pi)
