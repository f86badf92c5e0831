"""How large can it get? Bounds of everything that acts from outside, over the whole run, term by term.

A sum is bounded by the sum of its terms' bounds: never too small, and exact for one term.
"""

from __future__ import annotations

from collections import defaultdict
from math import pi
from typing import NamedTuple

import numpy as np

from umbilical.plant.current import speeds_at
from umbilical.plant.seaway import along
from umbilical.plant.signals import curve_of
from umbilical.scenario.environment import Environment, GaussianProfile, Profile, SineProfile, TableProfile
from umbilical.scenario.signals import Bell, Constant, Pulse, Signal, Sine, Step, Table, Term, Waves

_FADE_SLOPE = 1.875  # steepest slope of the quintic fade, at its middle


class Loads(NamedTuple):
    """Bounds over the run.

    Attributes:
        force: sup |d|, N.
        force_rate: sup |d'| between its jumps, N/s.
        force_jumps: instants, s, at which d jumps, and by how much at most, N.
        cable: sup int f^2 dx, N2/m.
        vessel: sup |e|, m.
        vessel_velocity: sup |e'|, m/s.
    """

    force: float
    force_rate: float
    force_jumps: tuple[tuple[float, float], ...]
    cable: float
    vessel: float
    vessel_velocity: float


def loads_of(environment: Environment, longest: float, drag: float = 0.0) -> Loads:
    """Bounds of a scenario's loads.

    Args:
        environment: forces and vessel.
        longest: greatest length of the cable in the run, m.
        drag: D_l of the ROV, N s/m: in a steady current at a steady depth ``D_l u`` is a constant force.
    """
    motion = along(environment)
    fading = _FADE_SLOPE * largest_value(motion) / environment.vessel_ramp if environment.vessel_ramp else 0.0
    velocity = largest_rate(motion) + fading
    of_cable = sum(largest_value(load.signal) * profile_norm(load.profile) for load in environment.cable_load)
    carried = drag * float(speeds_at(environment, np.array(longest)))
    force = (*environment.payload_force, *([Constant(kind="constant", value=carried)] if carried else []))
    of_force = largest_value(force), largest_rate(force), jumps_of(force)
    return Loads(*of_force, longest * of_cable**2, largest_value(motion), velocity)


def largest_value(signal: Signal) -> float:
    """Bound of |signal|, in its unit.

    >>> largest_value((Constant(kind="constant", value=-2.0), Sine(kind="sine", amplitude=3.0, frequency=2.0)))
    5.0
    """
    return float(sum(_size(term) for term in signal))


def largest_rate(signal: Signal) -> float:
    """Bound of |d signal/dt| between its jumps, in its unit per second; infinite for a bell with a cusp."""
    return float(sum(_rate(term) for term in signal))


def jumps_of(signal: Signal) -> tuple[tuple[float, float], ...]:
    """Instants at which the signal jumps, increasing, s, each with a bound of how far, in its unit."""
    found: defaultdict[float, float] = defaultdict(float)
    for t, step in (jump for term in signal for jump in _jumps(term)):
        found[t] += step
    return tuple(sorted(found.items()))


def _jumps(term: Term) -> list[tuple[float, float]]:
    """Instants, and how far a term jumps there: a linear table at those that stand twice in it."""
    match term:
        case Step():
            return [(term.time, abs(term.value))]
        case Pulse():
            return [(term.start, abs(term.value)), (term.end, abs(term.value))]
        case Table():
            places = np.flatnonzero(np.diff(term.times) == 0.0).tolist()
            return [(term.times[k], abs(term.values[k + 1] - term.values[k])) for k in places]
    return []


def profile_norm(profile: Profile) -> float:
    """Bound of the root of ``int profile^2 dsigma`` over the cable."""
    match profile:
        case SineProfile():
            return float(np.sqrt(0.5))
        case GaussianProfile():
            return float(np.sqrt(min(1.0, profile.width * np.sqrt(pi / 2.0))))
        case TableProfile():
            return max(map(abs, profile.values))
        case _:
            return 1.0


def _size(term: Term) -> float:
    match term:
        case Constant() | Step() | Pulse():
            return abs(term.value)
        case Sine() | Bell():
            return abs(term.amplitude)
        case Waves():
            return sum(map(abs, term.amplitudes))
        case Table(interpolation="smooth"):
            return float(np.abs(_extremes(term, 0)).max())
        case Table():
            return max(map(abs, term.values))
    raise TypeError(f"not a term of a signal: {term!r}")


def _rate(term: Term) -> float:
    match term:
        case Sine():
            return abs(term.amplitude * term.frequency)
        case Bell():
            return _steepest(term)
        case Waves():
            return float(np.abs(np.array(term.amplitudes) * np.array(term.frequencies)).sum())
        case Table(interpolation="linear"):
            steps = np.diff(term.times)
            return float(np.abs(np.diff(term.values)[steps > 0.0] / steps[steps > 0.0]).max())
        case Table():
            return float(np.abs(_extremes(term, 1)).max())
    return 0.0  # constants, and steps and pulses between their jumps


def _steepest(bell: Bell) -> float:
    """With u = |q|^(2b) the slope is ``2b A/w u^(1 - 1/(2b))/(1 + u)^2``, largest at u = (2b - 1)/(2b + 1)."""
    power = 2.0 * bell.exponent
    if power < 1.0:
        return float("inf")
    u = (power - 1.0) / (power + 1.0)
    return abs(bell.amplitude) / bell.width * power * u ** (1.0 - 1.0 / power) / (1.0 + u) ** 2


def _extremes(term: Table, order: int) -> np.ndarray:
    """Values of a spline's derivative at its knots and wherever that derivative is stationary."""
    curve = curve_of(term)
    stationary = curve.derivative(order + 1).roots(extrapolate=False)
    return curve(np.append(stationary[np.isfinite(stationary)], term.times), order)
