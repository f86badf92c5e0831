"""The hanging cable of frozen length between vessel and ROV, exactly and without a grid.

With s = l - x the distance from the ROV, at which the tension is ``T = T_l + w s``, the cable's equation at a complex
frequency p is Bessel's::

    (T Y_s)_s = (rho p^2 + c p) Y
    Y = A H1(X)/H1(X_l) + B H2(X)/H2(X_l),   X = -2j sqrt((rho p^2 + c p) T)/w

with the Hankel functions of order 0: H1 comes down to the ROV, H2 goes up from it. The vessel end y = 0 sends
back what arrives there, A = echo * B, so that at the ROV::

    Y = (1 + echo) B,   T Y_x = -(down * echo + up) B,   down, up = T d/ds ln H(X) at the ROV

High above the first modes ``up`` tends to ``-p sqrt(rho T)``, the impedance of a cable without an end.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from umbilical.plant.current import speeds_at
from umbilical.plant.exogenous import current_at
from umbilical.plant.forces.force import OperatingPoint
from umbilical.plant.forces.table import dampings
from umbilical.relations.tension import hanging_of, net_gravity, tension, tension_gain
from umbilical.relations.water import line_inertia, payload_inertia
from umbilical.scenario.scenario import Scenario

_POINTS = 2001


@dataclass(frozen=True)
class HangingCable:
    """Cable and ROV at a length that does not change.

    Attributes:
        line_density: kg/m.
        damping: N s/m2.
        payload_mass, payload_damping: the ROV, kg and N s/m.
        tip_tension: at the ROV, N.
        weight: of a metre of cable, which is what the tension gains on it, N/m.
        length: m.
    """

    line_density: float
    damping: float
    payload_mass: float
    payload_damping: float
    tip_tension: float
    weight: float
    length: float

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


class Waves(NamedTuple):
    """What the ROV meets at complex frequencies p, 1/s; arrays of one shape.

    Attributes:
        echo: displacement that comes back from the vessel over what went up, both at the ROV.
        down, up: T d/ds of the wave that comes down and of the one that goes up, N/m.
    """

    echo: np.ndarray
    down: np.ndarray
    up: np.ndarray


def hanging_cable(scenario: Scenario, length: float) -> HangingCable:
    """Cable and ROV of a scenario at a length, m, the winch standing still, in the current of the start.

    Drag counts with its slope there. Along the cable, where that varies with depth, the damping is the even one that
    takes as much from a short wave on its way: the mean over the time of travel.
    """
    cable, payload, environment = scenario.cable, scenario.payload, scenario.environment
    hung, net = hanging_of(cable, payload, environment), net_gravity(environment.gravity)
    sigma = np.linspace(0.0, 1.0, _POINTS)
    water = speeds_at(environment, length * sigma) * float(current_at(environment, np.array(0.0))[0])
    at = OperatingPoint(length, np.zeros(_POINTS), water)
    slowness = 1.0 / np.sqrt(np.maximum(tension(length * (1.0 - sigma), net, hung), 1e-9))
    taken = sum(np.trapezoid(found * slowness, sigma) for found in dampings(scenario, at, "cable"))
    return HangingCable(
        line_density=line_inertia(cable, payload, environment),
        damping=float(taken / np.trapezoid(slowness, sigma)) if environment.water else cable.damping,
        payload_mass=payload_inertia(payload),
        payload_damping=float(sum(dampings(scenario, at, "payload"))),
        tip_tension=tension(0.0, net, hung),
        weight=tension_gain(1.0, net, hung),
        length=length,
    )


def waves(cable: HangingCable, p: np.ndarray) -> Waves:
    """Echo and impedances at complex frequencies p with a positive imaginary part, 1/s.

    >>> cable = HangingCable(2.0, 0.0, 500.0, 0.0, 5000.0, 0.0, 400.0)  # constant tension: a pure delay
    >>> bool(np.isclose(waves(cable, np.array([1j])).echo[0], -np.exp(-1j * 2 * 400 / 50)))
    True
    """
    p = np.asarray(p, dtype=complex)
    gamma = wave_number(cable, p)
    if cable.weight == 0.0:
        slope = cable.tip_tension * gamma
        return Waves(-np.exp(-2.0 * gamma * cable.length), slope, -slope)
    from scipy.special import hankel1e, hankel2e

    # X at the ROV and X at the vessel less X at the ROV, which must not be a difference of large numbers.
    scale = 2.0 * cable.tip_tension / cable.weight
    ratio = cable.weight * cable.length / cable.tip_tension
    stretch = ratio / (np.sqrt(1.0 + ratio) + 1.0)
    tip = -1j * gamma * scale
    path = tip * stretch
    down, up = hankel1e(0, tip), hankel2e(0, tip)
    echo = -hankel2e(0, tip + path) / up * down / hankel1e(0, tip + path) * np.exp(-2j * path)
    slope = 1j * cable.tip_tension * gamma
    return Waves(echo, slope * hankel1e(1, tip) / down, slope * hankel2e(1, tip) / up)


def wave_number(cable: HangingCable, p: np.ndarray) -> np.ndarray:
    """gamma = sqrt((rho p^2 + c p)/T) at the ROV, 1/m, of positive real part: a wave goes as exp(-gamma s)."""
    return p * np.sqrt((cable.line_density + cable.damping / p) / cable.tip_tension)


def upward_asymptote(cable: HangingCable, p: np.ndarray) -> np.ndarray:
    """``up`` of :func:`waves` far above the first mode, N/m: ``-(T_l gamma + w/4)``, next term of order 1/p."""
    taper = cable.weight / (4.0 * cable.tip_tension)
    return -cable.tip_tension * (wave_number(cable, p) + taper)


def payload_stiffness(cable: HangingCable, p: np.ndarray) -> np.ndarray:
    """m p^2 + c_tip p, N/m: force over displacement of the ROV alone."""
    return p * (cable.payload_mass * p + cable.payload_damping)
