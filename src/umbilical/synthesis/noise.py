"""How much of the sensors' noise reaches the voltages: the spectrum of the readings through the sampled linear loop.

White noise of the four readings at the ROV passes the outer law, whose loop is closed over the cable, and the motor
loops; noise of speed and current the motor loops only. A wave that a command sends up comes back after a round trip.
The phase of its echo turns once from one resonance to the next, far quicker than anything else changes, so that its
mean over all phases stands for the sum over the resonances::

    mean |(1 + echo b)/(1 - echo R)|^2 = 1 + |echo (R + b)|^2/(1 - |echo R|^2)

which grows with the size of the echo: short cables are the worst. The signed root of the demand has its largest slope
at rest, so that the motors are looked at there, too; its slope is the mean one under the noise itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from umbilical.scenario.scenario import Scenario
from umbilical.stability.impedance import RovWaves
from umbilical.stability.sampled import SampledLoop, drives_at, loop_response
from umbilical.synthesis.score import ARC, Scorer
from umbilical.synthesis.trial import CHATTER

LARGEST_RETURN = 1.0 - 1e-6
"""Where a wave returns larger there is no stationary noise; such gains lack their margins."""


class VoltageNoise(NamedTuple):
    """Noise of the motor whose voltage is the noisiest.

    Attributes:
        rms: of its voltage above 10 Hz, V.
        thrust: steady thrust at which that is so, N.
        length: of the cable, m.
    """

    rms: float
    thrust: float
    length: float


NO_NOISE = VoltageNoise(0.0, 0.0, 0.0)


def reading_noise(scenario: Scenario) -> np.ndarray:
    """Standard deviations of the readings y, y_x, Dy/Dt, D(y_x)/Dt, motor speed and motor current, shape (6,).

    A resolution counts as noise of its twelfth's root (Widrow): right where the reading crosses several steps.

    >>> import umbilical
    >>> reading_noise(umbilical.load("ringdown", {"sensors.tip_slope.resolution": 1.2e-6})).round(9).tolist()
    [0.0, 3.46e-07, 0.0, 0.0, 0.0, 0.0]
    """
    s = scenario.sensors
    channels = (s.tip_displacement, s.tip_slope, s.tip_velocity, s.tip_slope_rate, s.motor_speed, s.motor_current)
    return np.array([np.hypot(c.noise, c.resolution / np.sqrt(12.0)) for c in channels])


def voltage_noise(scorer: Scorer, loop: SampledLoop, scenario: Scenario, thrusts: Sequence[float]) -> VoltageNoise:
    """The largest noise of a voltage above 10 Hz at some steady thrusts.

    Args:
        scorer: of the cable.
        loop: of the scenario, near the thrust at which its margins are judged.
        scenario: its sensors, motors and gains.
        thrusts: N.
    """
    deviations = reading_noise(scenario)
    w = np.geomspace(2.0 * np.pi * CHATTER, np.pi / loop.period, scorer.w.size // 2)
    if not deviations.any() or not loop.drives or w[0] >= w[-1]:
        return NO_NOISE
    commanded = commanded_spectrum(scorer, loop, deviations[:4])
    spread = float(np.sqrt(np.trapezoid(commanded, scorer.w)))
    held = _held(loop, scorer.w, commanded, w)
    found = [_rms(scenario, thrust, spread, w, held, deviations[4:]) for thrust in thrusts]
    return VoltageNoise(*max(zip(found, thrusts, strict=True)), scorer.cable.length)


def commanded_spectrum(scorer: Scorer, loop: SampledLoop, deviations: np.ndarray) -> np.ndarray:
    """Spectrum of the commanded thrust at the scorer's frequencies, N2 s/rad: its integral is the variance.

    Nothing below the band of the first modes: that slow, the ROV follows its sensors.

    Args:
        scorer, loop: cable and loop.
        deviations: of the four readings at the ROV, shape (4,).
    """
    p = 1j * scorer.w
    r = loop_response(scorer.cable, loop, p, RovWaves(*(part[ARC:] for part in scorer.met)), scorer.aliases)
    gains = loop.law.response(np.exp(p * loop.outer_period))[:, 0, :]
    opened = np.abs(gains / (1.0 - r.up2 / r.up1)[:, None]) ** 2 @ deviations**2
    reflection = r.reflection()
    returned = np.minimum(np.abs(r.echo * reflection) ** 2, LARGEST_RETURN)
    echoes = 1.0 + np.abs(r.echo * (reflection + r.down1 / r.up1)) ** 2 / (1.0 - returned)
    return np.where(scorer.w >= scorer.w[scorer.band][0], opened * echoes * loop.outer_period / np.pi, 0.0)


def _held(loop: SampledLoop, w: np.ndarray, spectrum: np.ndarray, fast: np.ndarray) -> np.ndarray:
    """Spectrum of a command that is held for several control periods, at frequencies up to half of theirs, rad/s."""
    turn = 2.0 * np.pi / loop.outer_period
    folded = np.abs(fast - turn * np.rint(fast / turn))
    repeat = sum(np.exp(-1j * k * fast * loop.period) for k in range(loop.every))
    return np.interp(folded, w, spectrum) * np.abs(repeat) ** 2 / loop.every**2


def _rms(
    scenario: Scenario, thrust: float, spread: float, w: np.ndarray, commanded: np.ndarray, deviations: np.ndarray
) -> float:
    """RMS of the noisiest voltage over frequencies w, rad/s; ``deviations`` of motor speed and current."""
    period = scenario.control.period
    squares = []
    for drive in drives_at(scenario, thrust, spread):
        volts = np.abs(drive.closed(period).response(np.exp(1j * w * period))[:, 0, :]) ** 2
        spectrum = volts[:, 0] * drive.share**2 * commanded + volts[:, 1:] @ deviations**2 * period / np.pi
        squares.append(float(np.trapezoid(spectrum, w)))
    return float(np.sqrt(max(squares)))
