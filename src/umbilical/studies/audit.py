"""A certificate held against runs: does V stay under its certified bound, and is its rate what theory says?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from umbilical.certificate import Certificate, Start, Weights, bound, cable_bound, certify
from umbilical.certificate.lyapunov import (
    boundary_function,
    boundary_function_rates,
    cable_function,
    cable_function_rates,
    law_error,
)
from umbilical.engine.simulate import simulate
from umbilical.run import Run
from umbilical.scenario.scenario import Scenario

INTERVAL = 0.01
"""Time between the samples of V, s: short against the loop's own time m/k_a."""
_READ = (
    "time", "sigma", "slope", "velocity", "length", "payout_speed", "payout_acceleration",
    "vessel_slope", "tip_velocity", "tip_slope", "disturbance", "disturbance_estimate",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Audit:
    """What became of V in two simulations.

    Attributes:
        certificate: what was audited.
        ideal_run: ideal sensors and thruster, sampled at the scenario's period.
        real_run: the scenario as it is.
        time: samples of the ideal run, s, shape (samples,).
        ideal: V of the ideal run, J, shape (samples,).
        bound: its certified bound from the same start, J, shape (samples,).
        cable: V1 + V2 of the ideal run, J, shape (samples,).
        cable_bound: its sharper bound from the same start, which the bounds in metres are made of, J, same shape.
        real_time, real: samples of the real run, s, and its V, J, with the same weights.
        identity: largest distance between V of the ideal run and the time integral of its exact rate, over the
            largest V; what sampling, grid and the quadrature leave open. Not a number without disturbance observer.
    """

    certificate: Certificate
    ideal_run: Run
    real_run: Run
    time: np.ndarray
    ideal: np.ndarray
    bound: np.ndarray
    cable: np.ndarray
    cable_bound: np.ndarray
    real_time: np.ndarray
    real: np.ndarray
    identity: float

    @property
    def excess(self) -> float:
        """Largest V of the ideal run over its bound; the certificate is refuted where it is above 1."""
        return largest_ratio(self.ideal, self.bound)

    @property
    def cable_excess(self) -> float:
        """The same for V1 + V2."""
        return largest_ratio(self.cable, self.cable_bound)

    @property
    def real_excess(self) -> float:
        """The same for the real run, which nothing bounds."""
        start = float(self.real[0]) if self.real.size else 0.0
        return largest_ratio(self.real, bound(self.certificate, self.real_time, start))


def audit(scenario: Scenario, *, progress: Callable[[float], None] | None = None) -> Audit:
    """Certify a scenario, simulate its ideal loop and itself, and compare V with the certified bound.

    Args:
        scenario: with the boundary law.
        progress: called now and then with the share done, 0 to 1.

    Raises:
        ScenarioError: the law is not the boundary law, or one of the scenarios is refused.

    >>> import umbilical
    >>> short = umbilical.load("ringdown", {"control.law.slope_gain": 5.0, "duration": 2.0})
    >>> audit(short).excess < 1.001
    True
    """
    certificate = certify(scenario)
    tell = progress or (lambda share: None)
    perfect, actual = ideal_loop(scenario), sampled_finely(scenario)
    ideal_run = simulate(perfect, progress=lambda share: tell(0.5 * share))
    real_run = simulate(actual, progress=lambda share: tell(0.5 + 0.5 * share))
    time, value = lyapunov_of_run(ideal_run, certificate)
    real_time, real = lyapunov_of_run(real_run, certificate)
    return Audit(
        certificate=certificate,
        ideal_run=ideal_run,
        real_run=real_run,
        time=time,
        ideal=value,
        bound=bound(certificate, time, float(value[0]) if value.size else 0.0),
        cable=cable_function(ideal_run.scenario, _read(ideal_run), certificate.weights),
        cable_bound=cable_bound(certificate, time, first_of(ideal_run)),
        real_time=real_time,
        real=real,
        identity=identity_residual(ideal_run, certificate, value),
    )


def ideal_loop(scenario: Scenario) -> Scenario:
    """The scenario with ideal sensors and an ideal thruster; sampling stays."""
    perfect = {
        "ideal_thruster": True,
        "motors": [],
        "faults": [],
        "sensors": {"ideal_velocity": True},
        "control.law.rates": "sensor",
        "control.allocation": {"method": "known"},
        "control.nominal": {},
        "control.outer_period": None,
        "assumed": {},
    }
    return sampled_finely(scenario).replace(perfect)


def sampled_finely(scenario: Scenario) -> Scenario:
    """The same run, stored every :data:`INTERVAL` or as close to it as the control period allows."""
    period = scenario.control.period
    return scenario.replace({"output.interval": max(1, round(INTERVAL / period)) * period})


def lyapunov_of_run(run: Run, certificate: Certificate) -> tuple[np.ndarray, np.ndarray]:
    """Instants, s, and V with gam = 1, J, of a run, with the certificate's weights."""
    read, weights = _read(run), certificate.weights
    cable = cable_function(run.scenario, read, weights)
    return read["time"], cable + boundary_function(run.scenario, read, weights)


def first_of(run: Run) -> Start:
    """Where a run starts, as its first sample has it."""
    read = _read(run)
    if not read["time"].size:
        return Start(0.0, 0.0, 0.0)
    cable = cable_function(run.scenario, read, Weights(0.0, 0.0, 0.0))  # at rest V2 is 0
    missed = read["disturbance"] - read["disturbance_estimate"]
    return Start(*(float(values[0]) for values in (cable, law_error(run.scenario, read), missed)))


def _read(run: Run) -> dict[str, np.ndarray]:
    return {name: run[name].values for name in _READ}


def identity_residual(run: Run, certificate: Certificate, value: np.ndarray) -> float:
    """Largest distance between V and the integral of its exact rate, over the largest V."""
    from scipy.integrate import cumulative_trapezoid

    observer = run.scenario.control.disturbance_observer
    if observer is None or not observer.enabled or value.size < 2:
        return float("nan")
    read = _read(run)
    terms = cable_function_rates(run.scenario, read, certificate.weights)
    terms |= boundary_function_rates(run.scenario, read, certificate.weights)
    gained = cumulative_trapezoid(sum(terms.values()), read["time"], initial=0.0)
    largest = float(value.max())
    return float(np.abs(value - value[0] - gained).max()) / largest if largest > 0.0 else 0.0


def largest_ratio(values: np.ndarray, bounds: np.ndarray) -> float:
    """Largest value over its bound, where the bound is above rounding; 0 where nothing ever moves.

    Not a number where nothing was certified.
    """
    if not np.isfinite(bounds).all():
        return float("nan")
    above = bounds > 1e-12 * max(float(bounds.max(initial=0.0)), float(values.max(initial=0.0)), 1e-300)
    return float(np.max(values[above] / bounds[above], initial=0.0))
