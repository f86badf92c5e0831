"""The output-feedback boundary law, eq. (22).

::

    u_a = x2^ + beta z1
    alpha_c = -k_a u_a - beta m z2^ + T z1 + c_tip x2^ - D^

With a station, an option of ours::

    u_a = x2^ + beta (z1 - z_w) + kappa (y - y_r),   z_w' = (z1 - z_w)/T_w
    alpha_c = -k_a u_a - beta m (z2^ - z_w') - kappa m x2^ + T z1 + c_tip x2^ - D^

u_a -> 0 is the boundary condition Dy/Dt = -beta y_x: it reflects the slope by (c_l - beta)/(c_l + beta),
with c_l = sqrt(T_l/rho).
"""

from __future__ import annotations

from collections.abc import Iterator
from math import expm1
from typing import NamedTuple

from umbilical.compile import glue, kernel
from umbilical.control.contract import OuterDecision, Readings, TipReadings
from umbilical.control.observers.disturbance import (
    Disturbance,
    DisturbanceMemory,
    advance_disturbance,
    disturbance_estimate,
    make_disturbance,
    start_disturbance,
)
from umbilical.control.outer.law import Believed, pull_of_the_cable
from umbilical.control.rates import outer_period, within_a_period
from umbilical.errors import Problem
from umbilical.frames import Frame, part, real
from umbilical.relations.water import payload_inertia
from umbilical.scenario.control import BoundaryLaw, Control
from umbilical.scenario.findings import Finding, amount
from umbilical.scenario.hardware import Payload


class Station(NamedTuple):
    """What holds a place: kappa, 1/s, y_r, m, and 1/T_w, 1/s, with the share of it that a period takes; else zeros."""

    gain: float
    place: float
    washout_rate: float
    washout_share: float


class Boundary(NamedTuple):
    """k_a, N s/m, beta, m/s, quadratic drag that is met before it is observed, N s2/m2; station and observer of D."""

    damping_gain: float
    slope_gain: float
    met_drag: float
    station: Station
    disturbance: Disturbance


class BoundaryMemory(Frame):
    """What the law remembers."""

    disturbance = part(DisturbanceMemory)
    slope_mean = real()


def make_boundary(control: Control, period: float, believed: Believed, across: bool = False) -> Boundary:
    """Constants for one period of the outer loop; idle without the law. ``across``: the station is below the sheave."""
    law, observer = control.law, make_disturbance(control.disturbance_observer, period)
    if not isinstance(law, BoundaryLaw):
        return Boundary(0.0, 0.0, 0.0, Station(0.0, 0.0, 0.0, 0.0), observer)
    rate, place = 1.0 / law.washout_time if law.washout_time else 0.0, 0.0 if across else law.station or 0.0
    station = Station(law.station_gain or 0.0, place, rate, -expm1(-rate * period))
    drag = believed.quadratic_drag if law.drag_feedforward else 0.0
    return Boundary(law.damping_gain, law.slope_gain, drag, station, observer)


@glue
def start_boundary(c: Boundary, believed: Believed, memory: BoundaryMemory, tip: TipReadings, velocity: float) -> None:
    """D^ = 0 at a velocity that is known already; the slope lasts where it is washed out."""
    memory.slope_mean = tip.tip_slope if c.station.washout_rate > 0.0 else 0.0
    start_disturbance(c.disturbance, memory.disturbance, believed.payload_mass, velocity)


@glue
def update_boundary(
    c: Boundary, believed: Believed, memory: BoundaryMemory, readings: Readings, out: OuterDecision, advance: bool
) -> None:
    """Decide the thrust; ``out`` holds the estimates of the rates, and the thrust that was commanded last."""
    tip, station, mass = readings.tip[0], c.station, believed.payload_mass
    velocity, slope_rate = out.tip_velocity_estimate, out.tip_slope_rate_estimate
    if advance:
        memory.slope_mean += station.washout_share * (tip.tip_slope - memory.slope_mean)
    away, lasting = tip.tip_displacement - station.place, memory.slope_mean
    error = boundary_error(c.slope_gain, velocity, tip.tip_slope - lasting) + station.gain * away
    pull = pull_of_the_cable(believed, readings.winch[0])
    known = pull * tip.tip_slope + believed.payload_damping * velocity + c.met_drag * abs(velocity) * velocity
    if advance:
        held = out.thrust_command
        advance_disturbance(c.disturbance, memory.disturbance, mass, velocity, error, known - held)
    estimate = disturbance_estimate(c.disturbance, memory.disturbance, mass, velocity)
    out.boundary_error = error
    out.disturbance_estimate = estimate
    changing = slope_rate - station.washout_rate * (tip.tip_slope - lasting)
    held_back = station.gain * mass * velocity
    thrust = boundary_thrust(c.damping_gain, c.slope_gain, mass, error, changing, known, estimate)
    out.thrust_command = thrust - held_back


@kernel
def boundary_error(slope_gain: float, velocity: float, slope: float) -> float:
    """u_a, m/s; ``slope`` is z1, less z_w where that is washed out."""
    return velocity + slope_gain * slope


@kernel
def boundary_thrust(
    damping_gain: float,
    slope_gain: float,
    mass: float,
    error: float,
    slope_rate: float,
    known_force: float,
    disturbance: float,
) -> float:
    """alpha_c, N; ``known_force`` is T z1 + c_tip x2^, N."""
    return -damping_gain * error - slope_gain * mass * slope_rate + known_force - disturbance


def boundary_law(control: Control, payload: Payload) -> Iterator[Finding]:
    """The boundary damping acts on an estimate that keeps up with the ROV."""
    law, observer, period = control.law, control.velocity_observer, outer_period(control)
    if not isinstance(law, BoundaryLaw):
        return
    yield from within_a_period(
        "control.law.damping_gain", law.damping_gain, "N s/m", 1.0 / payload_inertia(payload), period
    )
    if not observer or law.reads_rates:
        return
    limit = observer.damping * payload_inertia(payload) / law.damping_gain
    if observer.time_constant >= limit:
        yield Problem(
            "control.velocity_observer.time_constant",
            amount(observer.time_constant, "s"),
            f"below damping * mass / damping_gain = {limit:.6g} s",
            "with a slower observer the damping k_a arrives too late and drives the ROV instead",
            "a smaller time_constant or a smaller control.law.damping_gain",
        )
