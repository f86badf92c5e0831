"""What the waves of a scenario make of the sheave: its motion in three directions, as sums of regular waves."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from umbilical.scenario.environment import Environment
from umbilical.scenario.sea import SeaState, WaveSystem
from umbilical.scenario.signals import Signal, Waves
from umbilical.sea.components import Components, discretise
from umbilical.sea.rao import sheave_of, vessel_of
from umbilical.sea.spectrum import Spectrum, period_ratio
from umbilical.sea.vessel import motion_of_point


class Sheave(NamedTuple):
    """Motion of the sheave that waves cause: in the cable's plane, across it (to the left of it), and up, m."""

    along: Signal
    across: Signal
    up: Signal


CALM = Sheave((), (), ())


def spectrum_of(system: WaveSystem) -> Spectrum:
    """Spectrum of a wave system, by whichever period it gives."""
    given: list[tuple[Any, float | None]] = [
        ("peak", system.peak_period), ("zero_crossing", system.zero_crossing_period), ("mean", system.mean_period),
    ]  # fmt: skip
    kind, period = next((kind, period) for kind, period in given if period is not None)
    return Spectrum(system.significant_height, period / period_ratio(kind, system.peakedness), system.peakedness)


def directions_of(system: WaveSystem) -> np.ndarray:
    """Directions of equal energy, rad, shape (directions,): medians of equal shares of cos^n about the heading."""
    if system.spreading is None:
        return np.array([system.heading])
    angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, 4001)
    below = np.concatenate([[0.0], np.cumsum(np.cos(0.5 * (angle[1:] + angle[:-1])) ** system.spreading)])
    shares = (np.arange(system.directions) + 0.5) / system.directions
    return system.heading + np.interp(shares, below / below[-1], angle)


def waves_of(sea: SeaState) -> list[tuple[float, Components]]:
    """Directions, rad, and regular waves of each; a system, a direction or a run more leaves the others as they are."""
    found = []
    for number, system in enumerate(sea.systems):
        if system.significant_height > 0.0:
            headings, spectrum = directions_of(system), spectrum_of(system)
            for k, heading in enumerate(headings.tolist()):
                drawn = {"seed": sea.seed, "system": 100 * number + k, "rayleigh": sea.amplitudes == "random"}
                waves = discretise(spectrum, system.components, **drawn)
                found.append((heading, waves._replace(amplitude=waves.amplitude / np.sqrt(headings.size))))
    return found


def sheave(environment: Environment) -> Sheave:
    """What the waves of an environment make of the sheave."""
    sea: Any = environment.sea  # frozen records have a hash, which type checkers cannot see
    return _sheave(sea, environment.gravity) if sea else CALM


def along(environment: Environment) -> Signal:
    """All of the vessel's motion in the cable's plane: what is given, and what waves cause."""
    return environment.vessel_motion + sheave(environment).along if environment.sea else environment.vessel_motion


def heaving(environment: Environment) -> Signal:
    """All heave of the sheave that enters the string's tension: what is given, and what waves cause."""
    given = environment.vessel_heave or ()
    return given + sheave(environment).up if environment.sea and environment.sea.heave else given


def may_heave(environment: Environment) -> bool:
    """Whether heave enters the string's tension, be the sea as calm as it may."""
    return bool(environment.vessel_heave) or (environment.sea is not None and environment.sea.heave)


@lru_cache(maxsize=8)
def _sheave(sea: SeaState, gravity: float) -> Sheave:
    vessel, point = vessel_of(sea.vessel, gravity), sheave_of(sea.vessel)
    omega, amplitude = [np.zeros(0)], [np.zeros((3, 0), dtype=complex)]
    for heading, waves in waves_of(sea):
        omega.append(waves.omega)
        forward, port, up = motion_of_point(vessel.motions(waves.omega, heading), point)
        cos, sin = np.cos(sea.plane), np.sin(sea.plane)
        turned = np.array([cos * forward + sin * port, cos * port - sin * forward, up])
        amplitude.append(turned * waves.amplitude * np.exp(1j * waves.phase))
    frequencies = tuple(np.concatenate(omega).tolist())
    if not frequencies:
        return CALM
    return Sheave(*((_term(frequencies, row),) for row in np.concatenate(amplitude, axis=1)))


def _term(frequencies: tuple[float, ...], amplitudes: np.ndarray) -> Waves:
    size, phase = abs(amplitudes).tolist(), np.angle(amplitudes).tolist()
    return Waves(kind="waves", frequencies=frequencies, amplitudes=tuple(size), phases=tuple(phase))
