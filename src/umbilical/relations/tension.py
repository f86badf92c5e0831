"""Tension of the cable: its formula, its rate of change and its bounds. No other file does arithmetic with gravity.

A point at the distance ``s = l - x`` above the ROV carries the wet weight ``W + w s`` of what hangs below it and
accelerates its whole mass ``m + rho s``: buoyancy bears weight and accelerates nothing. With the downward acceleration
``a`` of the cable, B = m g - W and b = rho g - w,

    T(s) = W + w s - (m + rho s) a = (m + rho s) (g - a) - (B + b s)
    DT/Dt = -(m + rho s) a' = -a'/(g - a) (m + rho s) (g - a)

because a particle of cable keeps its s. At one instant T is a line in s, so the ends of the cable bound it. In air
B = b = 0. Source: axial balance of an inextensible cable; (6) of the paper without buoyancy.

Every function takes floats, arrays that broadcast, or intervals, and is inlined into the kernels that call it.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import formula
from umbilical.relations.water import in_water

Real = Any  # a float inside kernels; a float, an array or an interval outside


class Hanging(NamedTuple):
    """What hangs on the cable.

    Attributes:
        mass: of the ROV, kg.
        line_density: of the cable, kg/m.
        buoyancy: B = m g - W of the ROV, N.
        line_buoyancy: b = rho g - w of the cable, N/m.
    """

    mass: Real
    line_density: Real
    buoyancy: Real
    line_buoyancy: Real


def hanging(
    mass: Real, line_density: Real, gravity: Real, wet_weight: Real | None = None, wet_density: Real | None = None,
    added: Real = 0.0,
) -> Hanging:  # fmt: skip
    """What hangs, from masses (kg, kg/m), gravity (m/s2), wet weight (N) and wet density (kg/m); None: as in air.

    ``added`` is the mass of water that sinks along with the ROV, A_z, kg: it has inertia and no weight.

    >>> hanging(500.0, 2.0, 10.0, wet_weight=4000.0, wet_density=0.5)
    Hanging(mass=500.0, line_density=2.0, buoyancy=1000.0, line_buoyancy=15.0)
    """
    moved = mass + added
    buoyancy = 0.0 if wet_weight is None else moved * gravity - wet_weight
    line_buoyancy = 0.0 if wet_density is None else (line_density - wet_density) * gravity
    return Hanging(moved, line_density, buoyancy, line_buoyancy)


def hanging_of(cable: Any, payload: Any, environment: Any) -> Hanging:
    """What hangs, from these sections of a scenario."""
    added, wet = in_water(cable, payload, environment).body_vertical, cable.wet_line_density
    return hanging(payload.mass, cable.line_density, environment.gravity, payload.wet_weight, wet, added)


class AxialDrag(NamedTuple):
    """Drag of what sinks through the water over the square of its speed.

    Attributes:
        body: 1/2 rho_w (C A)_z of the ROV, N s2/m2.
        line: 1/2 rho_w pi d C_dt of a metre of cable, N s2/m3.
    """

    body: Real
    line: Real


def axial_drag_of(cable: Any, payload: Any, environment: Any) -> AxialDrag:
    """Drag along the cable, from these sections of a scenario."""
    found = in_water(cable, payload, environment)
    return AxialDrag(found.body_axial, found.tangential)


@formula
def sinking(hung: Hanging, drag: AxialDrag, speed: Real) -> Hanging:
    """What hangs while it sinks through the water at a speed, m/s: drag carries it as buoyancy does.

    >>> tension(100.0, 10.0, sinking(hanging(500.0, 2.0, 10.0), AxialDrag(50.0, 0.5), 2.0))
    6600.0
    """
    square = speed * abs(speed)
    body, line = hung.buoyancy + drag.body * square, hung.line_buoyancy + drag.line * square
    return Hanging(hung.mass, hung.line_density, body, line)


@formula
def across(hung: Hanging, coupling: Real, speed: Real) -> Hanging:
    """What pulls transverse waves back where added mass does not slide along: Tt = T - mu (v - zeta')^2."""
    return Hanging(hung.mass, hung.line_density, hung.buoyancy + coupling * speed * speed, hung.line_buoyancy)


@formula
def stretched(hung: Hanging, foot: Real, gradient: Real) -> Hanging:
    """What hangs on a cable that stretches: ``foot``, N, is added to T at the ROV and ``gradient``, N/m, above it."""
    return Hanging(hung.mass, hung.line_density, hung.buoyancy - foot, hung.line_buoyancy - gradient)


@formula
def sliding_rates(
    hung: Hanging, drag: AxialDrag, coupling: Real, slip: Real, net: Real, speed: Real, acceleration: Real
) -> tuple[Real, Real]:
    """What Tt_t + vb T_x holds beside the part that follows the winch's jerk, N/s: at the ROV, and per metre above it.

    ``hung`` as it sinks (:func:`sinking`), ``speed`` and ``acceleration`` of sinking, ``slip = v - vb``, ``net`` g - a.
    """
    braked = 2.0 * abs(speed) * acceleration
    at_payload = -drag.body * braked - 2.0 * coupling * speed * acceleration
    return at_payload + slip * tension_gain(1.0, net, hung), -drag.line * braked


@formula
def net_gravity(gravity: Real, acceleration: Real = 0.0) -> Real:
    """g - a, m/s2: what a mass on a cable that sinks with the acceleration ``a`` still weighs per kilogram, in air."""
    return gravity - acceleration


@formula
def relative_jerk(jerk: Real, net: Real) -> Real:
    """a'/(g - a), 1/s: DT/Dt is minus this times :func:`inertial_tension`."""
    return jerk / net


def mass_of_weight(weight: Real, gravity: Real) -> Real:
    """The mass that weighs so much in air, kg."""
    return weight / gravity


def weight_of_mass(mass: Real, gravity: Real) -> Real:
    """What a mass weighs in air, N."""
    return mass * gravity


@formula
def inertial_tension(distance: Real, net: Real, hung: Hanging) -> Real:
    """(m + rho s) (g - a), N: the tension in air, and the part of T that follows the acceleration."""
    return (hung.mass + hung.line_density * distance) * net


@formula
def carried(distance: Real, hung: Hanging) -> Real:
    """B + b s, N: what the water carries of the cable below a point and of the ROV."""
    return hung.buoyancy + hung.line_buoyancy * distance


@formula
def tension(distance: Real, net: Real, hung: Hanging) -> Real:
    """T at the distance s = l - x from the ROV, N; ``net`` is :func:`net_gravity`.

    >>> tension(np.array([0.0, 500.0]), net_gravity(10.0, 0.5), hanging(500.0, 2.0, 10.0, 4000.0, 0.5)).tolist()
    [3750.0, 5750.0]
    """
    return inertial_tension(distance, net, hung) - carried(distance, hung)


@formula
def tension_gain(distance: Real, net: Real, hung: Hanging) -> Real:
    """T(s) - T(0) = (rho (g - a) - b) s, N; for s = 1 the slope of the tension, N/m."""
    return hung.line_density * distance * net - hung.line_buoyancy * distance


def fading_tension(share: Real, distance: Real, net: Real, jerk: Real, hung: Hanging) -> Real:
    """``share T - DT/Dt``, share in 1/s, a' in m/s3; each mass occurs once, so that intervals stay narrow."""
    return inertial_tension(distance, share * net + jerk, hung) - share * carried(distance, hung)


def smallest_tension(length: Real, net: Real, hung: Hanging) -> Any:
    """The smallest T on a cable of this length, N. A light cable that sinks ever faster pulls least at the vessel."""
    return np.minimum(tension(0.0, net, hung), tension(length, net, hung))


def largest_tension(length: Real, net: Real, hung: Hanging) -> Any:
    """The largest T on a cable of this length, N."""
    return np.maximum(tension(0.0, net, hung), tension(length, net, hung))


def slack_acceleration(length: Real, gravity: Real, hung: Hanging) -> Any:
    """The downward acceleration of the cable, m/s2, at which T vanishes somewhere: g in air, less in water.

    >>> round(float(slack_acceleration(500.0, 10.0, hanging(500.0, 2.0, 10.0, 4000.0, 0.0))), 6)
    2.666667
    """
    still = net_gravity(gravity)
    ends = (carried(s, hung) / inertial_tension(s, 1.0, hung) for s in (0.0, length))
    return still - np.maximum(*ends)
