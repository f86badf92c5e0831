"""V and its exact rate along a run, from the stored fields: what a certificate is audited with.

The rate is written term by term for any motion of cable, ROV and vessel (docs/certificates.md); nothing in it assumes
a controller. Fields are read between the stored nodes by cubic splines, whatever grid they come from.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from umbilical.certificate.records import Weights
from umbilical.plant import signals
from umbilical.plant.exogenous import profile
from umbilical.plant.top import top_at, vessel_at
from umbilical.relations.tension import hanging_of, inertial_tension, net_gravity, tension, tension_gain
from umbilical.scenario.scenario import Scenario

Array = np.ndarray
_POINTS, _SHARES = np.polynomial.legendre.leggauss(3)


class CableFields(NamedTuple):
    """Fields at quadrature points; arrays (samples, points) unless said otherwise.

    Attributes:
        q: x + x0 without x0, that is x, m.
        weight: of each point in an integral over x, m.
        pull: tension T, N.
        changing: the part of it that follows the acceleration, N.
        gain: what T gains on a metre, N/m, shape (samples, 1).
        p: slope y_x.
        w: velocity Dy/Dt, m/s.
    """

    q: Array
    weight: Array
    pull: Array
    changing: Array
    gain: Array
    p: Array
    w: Array

    def integral(self, density: Array) -> Array:
        """Integral over the cable, shape (samples,)."""
        return (density * self.weight).sum(axis=1)


def read_fields(scenario: Scenario, run: Mapping[str, Array]) -> CableFields:
    """Slope, velocity and tension at three Gauss points between every two stored nodes.

    Args:
        scenario: gives masses and gravity.
        run: arrays ``sigma`` (nodes,), ``slope`` and ``velocity`` (time, nodes), ``length`` and
            ``payout_acceleration`` (time,).
    """
    from scipy.interpolate import CubicSpline

    sigma, first = np.unique(np.asarray(run["sigma"]), return_index=True)
    p, w = (CubicSpline(sigma, np.asarray(run[name])[:, first], axis=1) for name in ("slope", "velocity"))
    half = np.diff(sigma) / 2.0
    points = (sigma[:-1, None] + half[:, None] * (1.0 + _POINTS)).ravel()
    share = (half[:, None] * _SHARES).ravel()
    length = np.asarray(run["length"])[:, None]
    net = net_gravity(scenario.environment.gravity, np.asarray(run["payout_acceleration"])[:, None])
    hung, above = hanging_of(scenario.cable, scenario.payload, scenario.environment), (1.0 - points) * length
    pull, changing = tension(above, net, hung), inertial_tension(above, net, hung)
    gain = tension_gain(1.0, net, hung)
    return CableFields(points * length, share * length, pull, changing, gain, p(points), w(points))


def cable_function(scenario: Scenario, run: Mapping[str, Array], weights: Weights) -> Array:
    """V1 + V2 with gam = 1 at every stored sample, J, shape (time,)."""
    f, rho = read_fields(scenario, run), scenario.cable.line_density
    reach = weights.vessel + weights.cross * f.q
    return f.integral(0.5 * (rho * f.w**2 + f.pull * f.p**2) + rho * reach * f.p * f.w)


def boundary_function(scenario: Scenario, run: Mapping[str, Array], weights: Weights) -> Array:
    """V3 with gam = 1 at every stored sample, J, shape (time,); from the true u_a, not the observer's."""
    observer, error = scenario.control.disturbance_observer, law_error(scenario, run)
    value = scenario.payload.mass * error**2
    if observer is not None and observer.enabled:
        missed = np.asarray(run["disturbance"]) - np.asarray(run["disturbance_estimate"])
        value = value + missed**2 / (observer.gain * observer.coupling)
    return 0.5 * weights.boundary * value


def cable_function_rates(scenario: Scenario, run: Mapping[str, Array], weights: Weights) -> dict[str, Array]:
    """Every term of d(V1 + V2)/dt with gam = 1, W, each of shape (time,); their sum is the rate.

    Args:
        scenario: what was simulated.
        run: as for :func:`read_fields`, with ``time``, ``payout_speed`` and the values at both ends.
        weights: lam/gam and lam x0/gam; eta is not used.
    """
    f, rho, c = read_fields(scenario, run), scenario.cable.line_density, scenario.cable.damping
    time, lam, offset = np.asarray(run["time"]), weights.cross, weights.vessel
    speed, length = np.asarray(run["payout_speed"]), np.asarray(run["length"])
    net = net_gravity(scenario.environment.gravity, np.asarray(run["payout_acceleration"]))
    jerk = top_at(scenario.winch, time).relative_jerk(scenario.environment.gravity)
    p_0, p_l, w_l = (np.asarray(run[name]) for name in ("vessel_slope", "tip_slope", "tip_velocity"))
    e_rate = vessel_at(scenario.environment, time)[1]
    reach, at_tip = offset + lam * f.q, offset + lam * length
    hung = hanging_of(scenario.cable, scenario.payload, scenario.environment)
    top, foot = tension(length, net, hung) - rho * speed**2, tension(0.0, net, hung)
    load = loads_along(scenario, time, f.q / length[:, None])
    return {
        "vessel slope": -0.5 * top * (speed + offset) * p_0**2,
        "vessel motion": -top * p_0 * e_rate + 0.5 * rho * (speed - offset) * e_rate**2,
        "thrust": foot * p_l * w_l,
        "damping": -c * f.integral(f.w**2),
        "load": f.integral(load * f.w),
        "jerk": -0.5 * jerk * f.integral(f.changing * f.p**2),
        "cross velocity": -0.5 * rho * lam * f.integral(f.w**2),
        "cross slope": -0.5 * f.integral((lam * f.pull + reach * f.gain) * f.p**2),
        "tip velocity": 0.5 * rho * at_tip * w_l**2,
        "tip slope": 0.5 * at_tip * foot * p_l**2,
        "winch speed": rho * lam * speed * f.integral(f.p * f.w),
        "cross damping": -c * f.integral(reach * f.p * f.w),
        "cross load": f.integral(reach * load * f.p),
    }


def boundary_function_rates(scenario: Scenario, run: Mapping[str, Array], weights: Weights) -> dict[str, Array]:
    """Every term of dV3/dt in the ideal loop with its disturbance observer, W, each of shape (time,)."""
    observer = scenario.control.disturbance_observer
    assert observer is not None
    eta, k_s, vs = weights.boundary, observer.gain, observer.coupling
    error = law_error(scenario, run)
    missed = np.asarray(run["disturbance"]) - np.asarray(run["disturbance_estimate"])
    force_rate = signals.derivative(scenario.environment.payload_force, np.asarray(run["time"]))
    return {
        "boundary damping": -eta * _gains(scenario)[0] * error**2,
        "disturbance estimate": -eta / vs * missed**2,
        "disturbance rate": eta / (k_s * vs) * missed * force_rate,
    }


def law_error(scenario: Scenario, run: Mapping[str, Array]) -> Array:
    """The true u_a, m/s, shape (time,)."""
    return np.asarray(run["tip_velocity"]) + _gains(scenario)[1] * np.asarray(run["tip_slope"])


def _gains(scenario: Scenario) -> tuple[float, float]:
    gains = scenario.control.law.boundary_gains
    assert gains is not None
    return gains


def loads_along(scenario: Scenario, time: Array, sigma: Array) -> Array:
    """f(x,t) of all loads along the cable at ``sigma = x/l``, N/m, shape of ``sigma`` (time, points)."""
    total = np.zeros(sigma.shape)
    for load in scenario.environment.cable_load:
        total += profile(load.profile, sigma) * signals.evaluate(load.signal, time)[:, None]
    return total
