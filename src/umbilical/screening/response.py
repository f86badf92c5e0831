"""Statistics of cable and body in one sea: linear transfer, with the body's drag linearised for that sea.

Extremes are those of a narrow-banded Gaussian process: a level is passed within a time T with the probability
``1 - exp(-nu T exp(-level^2/(2 sigma^2)))``, nu the rate of upward crossings of the mean.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from umbilical.errors import ScenarioError
from umbilical.relations.axial import axial_period, heave_transfer, linearised_damping, mean_drag
from umbilical.relations.tension import hanging_of, net_gravity, tension_gain
from umbilical.scenario.ship import RaoShip
from umbilical.screening.load import bar_of
from umbilical.screening.operation import HeaveCompensation, Operation
from umbilical.sea.rao import RaoVessel, sheave_of, vessel_of
from umbilical.sea.rao_checks import assumed_of_table, sea_problems
from umbilical.sea.spectrum import Spectrum
from umbilical.sea.vessel import motion_of_point

FREQUENCIES = np.geomspace(0.1, 12.0, 1600)
"""rad/s; waves of 0.5 to 63 s."""
STEPS = np.gradient(FREQUENCIES)
"""Weights of the trapezoidal rule, rad/s."""


class Spread(NamedTuple):
    """Root mean square of a Gaussian process and its mean period between upward crossings, s; any shape."""

    rms: np.ndarray
    period: np.ndarray


class Response(NamedTuple):
    """Cable and body in one sea at one depth.

    Attributes:
        depth: m; axial_period: T1 of the hanging bar, s.
        sheave, body: heave of the sheave and of the body, m.
        end, top: dynamic tension at the body and at the sheave, N.
        damping: of the body, linearised, N s/m.
        end_mean, top_mean: mean tension, N.
    """

    depth: float
    axial_period: float
    sheave: Spread
    body: Spread
    end: Spread
    top: Spread
    damping: float
    end_mean: float
    top_mean: float

    def slack_probability(self, duration: float) -> float:
        """Probability that the cable goes slack at the body within a time, s."""
        return float(level_exceedance(self.end_mean, self.end, duration))


def respond(
    operation: Operation, spectrum: Spectrum, *, depth: float, heading: float, payout_speed: float = 0.0
) -> Response:
    """Compute the statistics in one sea.

    Args:
        operation: vessel, cable, body.
        spectrum: the sea, long-crested.
        depth: cable paid out, m.
        heading: direction the waves go to, rad from the bow; 0 following, pi head sea.
        payout_speed: steady speed of the winch, m/s, positive paying out; the length is held.

    >>> import numpy as np
    >>> from umbilical.screening import load_operation
    >>> found = respond(load_operation("work-class"), Spectrum(2.5, 8.0), depth=3000.0, heading=np.radians(135))
    >>> round(float(found.top.rms), -1), round(found.slack_probability(3 * 3600.0), 4)
    (9160.0, 0.0053)
    """
    check_vessel(operation, [spectrum], [heading])
    bar, drag = bar_of(operation, depth), operation.payload.quadratic_drag
    heave = sheave_energy(operation, spectrum.density(FREQUENCIES), heading)

    def moving(damping: float) -> float:
        answer = heave_transfer(bar, np.array([damping]), FREQUENCIES)
        return float(spread(abs(answer.body) ** 2 * FREQUENCIES**2, heave).rms[0])

    damping = linearised_damping(drag, payout_speed, moving)
    answer = heave_transfer(bar, np.array([damping]), FREQUENCIES)
    body, end, top = (Spread(*(part[0] for part in spread(abs(h) ** 2, heave))) for h in answer[:3])
    end_mean = operation.payload.wet_weight - mean_drag(drag, payout_speed, moving(damping))
    hung = hanging_of(operation.cable, operation.payload, operation.environment)
    hanging = tension_gain(depth, net_gravity(operation.environment.gravity), hung)
    sheave = Spread(*(part[0] for part in spread(np.ones((1, FREQUENCIES.size)), heave)))
    return Response(depth, axial_period(bar), sheave, body, end, top, damping, end_mean, end_mean + hanging)


def sheave_energy(operation: Operation, density: np.ndarray, heading: float) -> np.ndarray:
    """Spectral density of the sheave's heave after compensation, at :data:`FREQUENCIES`, m2 s/rad."""
    vessel = vessel_of(operation.vessel, operation.environment.gravity)
    heave = motion_of_point(vessel.motions(FREQUENCIES, heading), sheave_of(operation.vessel))[2]
    return density * abs(heave * residual_heave(operation.compensation, FREQUENCIES)) ** 2


def check_vessel(operation: Operation, seas: Iterable[Spectrum], headings: Iterable[float]) -> None:
    """Refuse seas that a table of RAOs does not know.

    Raises:
        ScenarioError: with one problem of each kind.
    """
    vessel = vessel_of(operation.vessel, operation.environment.gravity)
    if isinstance(vessel, RaoVessel):
        asked = [(sea, heading) for sea in seas for heading in headings]
        found = {p.key: p for sea, heading in reversed(asked) for p in sea_problems(vessel, sea, heading)}
        if found:
            raise ScenarioError([*found.values()], operation.name)


def unknown_parts(operation: Operation) -> list[str]:
    """What screening does not know of an operation, in words."""
    vessel = [*assumed_of_table(operation.vessel)] if isinstance(operation.vessel, RaoShip) else []
    return [
        "linearised: keep 10 % below a limit until a simulation confirms it",
        "one wave direction at a time, no current; the cable stays straight and its length is held",
        *vessel,
    ]


def residual_heave(compensation: HeaveCompensation | None, omega: np.ndarray) -> np.ndarray:
    """Share of the sheave's heave that is left, complex.

    >>> drive = HeaveCompensation(lag=0.05, bandwidth=6.0)
    >>> float(np.round(abs(residual_heave(drive, np.array(2 * np.pi / 8.0))), 4))
    0.2232
    """
    if compensation is None:
        return np.ones_like(omega) + 0j
    own, lag = compensation.bandwidth, compensation.lag
    drive = own**2 / (own**2 - omega**2 + 2j * compensation.damping * own * omega)
    return 1.0 - compensation.gain * np.exp(-1j * omega * lag) * drive


def spread(gain: np.ndarray, energy: np.ndarray) -> Spread:
    """Spread of responses whose squared gains, shape (dampings, frequencies), meet seas of shape (frequencies, ...)."""
    weighted = energy * STEPS if energy.ndim == 1 else energy * STEPS[:, None]
    zeroth, second = gain @ weighted, (gain * FREQUENCIES**2) @ weighted
    return Spread(np.sqrt(zeroth), 2.0 * np.pi * np.sqrt(zeroth / np.maximum(second, np.finfo(float).tiny)))


def level_exceedance(level: np.ndarray | float, process: Spread, duration: float) -> np.ndarray:
    """Probability that a process passes a level above its mean within a time, s."""
    scaled = np.maximum(level, 0.0) / np.maximum(process.rms, np.finfo(float).tiny)
    return -np.expm1(-duration / process.period * np.exp(-(scaled**2) / 2.0))


def largest_rms(level: np.ndarray | float, period: np.ndarray, probability: float, duration: float) -> np.ndarray:
    """The rms with which a level is passed within a time with just this probability; 0 where the level is not above 0.

    Where the time is shorter than it takes to pass the mean as often as allowed, any rms will do: infinity.
    """
    passes = duration / period / -np.log1p(-probability)
    with np.errstate(divide="ignore"):
        return np.where(passes > 1.0, np.maximum(level, 0.0) / np.sqrt(2.0 * np.log(np.maximum(passes, 1.0))), np.inf)
