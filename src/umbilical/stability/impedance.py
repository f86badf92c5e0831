"""The hanging cable of frozen length between vessel and ROV, exactly and without a grid.

With s = l - x the distance from the ROV, at which the tension is ``T = T_l + w s``, the cable's equation at a complex
frequency p is Bessel's::

    (T Y_s)_s = (rho p^2 + c p) Y
    Y = A H1(X)/H1(X_l) + B H2(X)/H2(X_l),   X = -2j sqrt((rho p^2 + c p) T)/w

with the Hankel functions of order 0: H1 comes down to the ROV, H2 goes up from it. The vessel end y = 0 sends
back what arrives there, A = echo * B, so that at the ROV::

    Y = (1 + echo) B,   T Y_x = -(down * echo + up) B,   down, up = T d/ds ln H(X) at the ROV

High above the first modes ``up`` tends to ``-p sqrt(rho T)``, the impedance of a cable without an end.

Where the drag of a sheared current damps differently along the cable, c is constant in each of some pieces, across
whose ends Y and T Y_s go on: the echo is worked out from the vessel down, piece by piece.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from umbilical.plant.current import speeds_at
from umbilical.plant.exogenous import current_at
from umbilical.plant.forces.table import dampings, payload_spring
from umbilical.relations.tension import hanging_of, net_gravity, tension, tension_gain
from umbilical.relations.water import line_inertia, payload_inertia
from umbilical.scenario.scenario import Scenario

_POINTS = 2001
_PIECES = 40
"""Of even damping, where that varies; the error falls with the square of their number."""


@dataclass(frozen=True)
class FixedLengthCable:
    """Cable and ROV at a length that does not change.

    Attributes:
        line_density: kg/m.
        damping: N s/m2; at the ROV, where there are pieces.
        payload_mass, payload_damping: the ROV, kg and N s/m.
        tip_tension: at the ROV, N.
        weight: of a metre of cable, which is what the tension gains on it, N/m.
        length: m.
        pieces: length, m, and damping, N s/m2, of each from the ROV up; none where the damping is even.
        payload_spring: what forces hold the ROV with, N/m.
    """

    line_density: float
    damping: float
    payload_mass: float
    payload_damping: float
    tip_tension: float
    weight: float
    length: float
    pieces: tuple[tuple[float, float], ...] = ()
    payload_spring: float = 0.0

    @property
    def tip_wave_speed(self) -> float:
        """c_l = sqrt(T_l/rho), m/s."""
        return float(np.sqrt(self.tip_tension / self.line_density))

    @property
    def top_wave_speed(self) -> float:
        """c_0 = sqrt(T_0/rho) at the vessel, m/s."""
        return float(np.sqrt((self.tip_tension + self.weight * self.length) / self.line_density))

    @property
    def tip_impedance(self) -> float:
        """sqrt(rho T) at the ROV, N s/m."""
        return float(np.sqrt(self.tip_tension * self.line_density))

    @property
    def round_trip(self) -> float:
        """Time a wave takes from the ROV to the vessel and back, s: twice ``int dx/sqrt(T/rho)``."""
        roots = np.sqrt(self.tip_tension + self.weight * self.length) + np.sqrt(self.tip_tension)
        return float(4.0 * np.sqrt(self.line_density) * self.length / roots)


class RovWaves(NamedTuple):
    """What the ROV meets at complex frequencies p, 1/s; arrays of one shape.

    Attributes:
        echo: displacement that comes back from the vessel over what went up, both at the ROV.
        down, up: T d/ds of the wave that comes down and of the one that goes up, N/m.
    """

    echo: np.ndarray
    down: np.ndarray
    up: np.ndarray


def hanging_cable(scenario: Scenario, length: float) -> FixedLengthCable:
    """Cable and ROV of a scenario at a length, m, the winch standing still, in the current of the start.

    Drag counts with its slope there, along the cable with its mean over each of the pieces where it varies with depth.
    """
    cable, payload, environment = scenario.cable, scenario.payload, scenario.environment
    hung, net = hanging_of(cable, payload, environment), net_gravity(environment.gravity)
    sigma = np.linspace(0.0, 1.0, _POINTS)
    water = speeds_at(environment, length * sigma) * float(current_at(environment, np.array(0.0))[0])
    dampers = dampings(scenario, water, "cable")
    damping = np.sum([np.broadcast_to(found, sigma.shape) for found in dampers], axis=0)[::-1]
    pieces = _pieces(damping, length) if np.ptp(damping) > 1e-9 * damping.max() else ()
    return FixedLengthCable(
        line_density=line_inertia(cable, payload, environment),
        damping=pieces[0][1] if pieces else float(damping[0]),
        payload_mass=payload_inertia(payload),
        payload_damping=float(sum(dampings(scenario, water, "payload"))),
        tip_tension=tension(0.0, net, hung),
        weight=tension_gain(1.0, net, hung),
        length=length,
        pieces=pieces,
        payload_spring=payload_spring(scenario, water),
    )


def _pieces(damping: np.ndarray, length: float) -> tuple[tuple[float, float], ...]:
    """Pieces with the mean of a damping that is given at even distances from the ROV up, N s/m2."""
    every = (damping.size - 1) // _PIECES
    parts = (damping[first : first + every + 1] for first in range(0, damping.size - 1, every))
    return tuple((length / _PIECES, float(np.trapezoid(part) / every)) for part in parts)


def waves_at_rov(cable: FixedLengthCable, p: np.ndarray) -> RovWaves:
    """Echo and impedances at complex frequencies p with a positive imaginary part, 1/s.

    >>> cable = FixedLengthCable(2.0, 0.0, 500.0, 0.0, 5000.0, 0.0, 400.0)  # constant tension: a pure delay
    >>> bool(np.isclose(waves_at_rov(cable, np.array([1j])).echo[0], -np.exp(-1j * 2 * 400 / 50)))
    True
    """
    p = np.asarray(p, dtype=complex)
    top, *below = map(partial(_through, p=p), _from_the_vessel(cable))
    echo, last = -top.round_trip, top
    for piece in below:
        there, pull = 1.0 + echo, last.down * echo + last.up
        echo = piece.round_trip * (piece.top_up * there - pull) / (pull - piece.top_down * there)
        last = piece
    return RovWaves(echo, last.down, last.up)


class _Through(NamedTuple):
    """An even cable: what of a wave that went up comes down again, were its upper end free; T d/ds at both ends."""

    round_trip: np.ndarray
    down: np.ndarray
    up: np.ndarray
    top_down: np.ndarray
    top_up: np.ndarray


def _from_the_vessel(cable: FixedLengthCable) -> Iterator[FixedLengthCable]:
    """Its pieces as cables of their own, from the vessel down."""
    bottom = cable.length
    for length, damping in reversed(cable.pieces or ((cable.length, cable.damping),)):
        bottom -= length
        tension = cable.tip_tension + cable.weight * bottom
        yield replace(cable, damping=damping, tip_tension=tension, length=length, pieces=())


def _through(cable: FixedLengthCable, p: np.ndarray) -> _Through:
    gamma = cable_wave_number(cable, p)
    slope = cable.tip_tension * gamma
    if cable.weight == 0.0:
        return _Through(np.exp(-2.0 * gamma * cable.length), slope, -slope, slope, -slope)
    from scipy.special import hankel1e, hankel2e

    # X at the lower end and X at the upper less X at the lower, which must not be a difference of large numbers.
    ratio = cable.weight * cable.length / cable.tip_tension
    stretch = ratio / (np.sqrt(1.0 + ratio) + 1.0)
    tip = -2j * slope / cable.weight
    path = tip * stretch
    top, steep = tip + path, slope * (1.0 + stretch)
    down, up, top_down, top_up = hankel1e(0, tip), hankel2e(0, tip), hankel1e(0, top), hankel2e(0, top)
    return _Through(
        top_up / up * down / top_down * np.exp(-2j * path),
        1j * slope * hankel1e(1, tip) / down,
        1j * slope * hankel2e(1, tip) / up,
        1j * steep * hankel1e(1, top) / top_down,
        1j * steep * hankel2e(1, top) / top_up,
    )


def cable_wave_number(cable: FixedLengthCable, p: np.ndarray) -> np.ndarray:
    """gamma = sqrt((rho p^2 + c p)/T) at the ROV, 1/m, of positive real part: a wave goes as exp(-gamma s)."""
    return p * np.sqrt((cable.line_density + cable.damping / p) / cable.tip_tension)


def upward_asymptote(cable: FixedLengthCable, p: np.ndarray) -> np.ndarray:
    """``up`` of :func:`waves_at_rov` far above the first mode, N/m: ``-(T_l gamma + w/4)``, next term of order 1/p."""
    taper = cable.weight / (4.0 * cable.tip_tension)
    return -cable.tip_tension * (cable_wave_number(cable, p) + taper)


def payload_stiffness(cable: FixedLengthCable, p: np.ndarray) -> np.ndarray:
    """m p^2 + c_tip p + k, N/m: force over displacement of the ROV alone."""
    return p * (cable.payload_mass * p + cable.payload_damping) + cable.payload_spring
