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
from typing import Any, NamedTuple

from umbilical.compile import kernel
from umbilical.control.rates import outer_period, within_a_period
from umbilical.errors import Problem
from umbilical.relations.water import payload_inertia
from umbilical.scenario.control import BoundaryLaw, Control
from umbilical.scenario.findings import Finding, amount
from umbilical.scenario.hardware import Payload


def gains(law: BoundaryLaw) -> tuple[float, float]:
    """k_a, N s/m, and beta, m/s."""
    return law.damping_gain, law.slope_gain


class Station(NamedTuple):
    """What holds a place: kappa, 1/s, y_r, m, and 1/T_w, 1/s, with the share of it that a period takes; else zeros."""

    gain: float
    place: float
    washout_rate: float
    washout_share: float


def make_station(law: Any, period: float) -> Station:
    """The option of a boundary law, for one period of the outer loop."""
    rate = 1.0 / law.washout_time if getattr(law, "washout_time", None) else 0.0
    gain, place = getattr(law, "station_gain", None) or 0.0, getattr(law, "station", None) or 0.0
    return Station(gain, place, rate, -expm1(-rate * period))


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
