"""Outer laws and allocation, number by number."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from umbilical.control.allocation.adaptive import adapt, adaptive_demand, initial_kappa, make_adaptation
from umbilical.control.allocation.known import known_demand
from umbilical.control.allocation.table import KNOWN, make_allocation
from umbilical.control.contract import MotorDecision
from umbilical.control.nominal import NominalMotor
from umbilical.control.outer.boundary import boundary_error, boundary_thrust
from umbilical.control.outer.pd import pd_thrust
from umbilical.scenario.control import AdaptiveAllocation, KnownFactors

pytestmark = pytest.mark.nojit

PERIOD = 1e-3


def demands(allocate: Any, coefficients: tuple[float, ...], *arguments: Any) -> np.ndarray:
    """What a law of allocation demands of motors with these thrust coefficients."""
    nominal, decision = NominalMotor.many(len(coefficients)), MotorDecision.many(len(coefficients))
    nominal["thrust_coefficient"] = coefficients
    allocate(nominal, *arguments, decision)
    return decision["demand"]


def adaptive(**changes: object) -> AdaptiveAllocation:
    values = {"method": "adaptive", "rates": (0.1, 100.0, 50.0), "leak": 0.2, "initial": (0.25, 0.0, 0.5)}
    return AdaptiveAllocation.model_validate(values | changes)


def test_boundary_law_term_by_term() -> None:
    """``u_a = x2^ + beta z1``, ``alpha_c = -k_a u_a - beta m z2^ + (T z1 + c_tip x2^) - D^``."""
    error = boundary_error(0.5, 0.2, 0.03)
    assert error == pytest.approx(0.2 + 0.5 * 0.03, rel=1e-15)
    whole = boundary_thrust(1e4, 0.5, 500.0, error, -0.07, 150.0, 33.0)
    assert whole == pytest.approx(-1e4 * 0.215 + 0.5 * 500.0 * 0.07 + 150.0 - 33.0, rel=1e-14)


def test_pd_term_by_term() -> None:
    assert pd_thrust(100.0, 10.0, 0.3, -0.2) == pytest.approx(-30.0 + 2.0, rel=1e-15)


@pytest.mark.parametrize("coefficients", [(1.2, 0.8), (1.2, -0.8), (-3.0,), (0.5, -0.2, 1.0)])
def test_known_factors_deliver_the_thrust(coefficients: tuple[float, ...]) -> None:
    """Each motor gets the same size of demand in its own direction: the thrusts add up to the command."""
    demand = demands(known_demand, coefficients, 100.0)
    assert np.dot(coefficients, demand) == pytest.approx(100.0, rel=1e-14)
    assert len({abs(u) for u in demand}) == 1
    assert (np.sign(demand) == np.sign(coefficients)).all()


def test_adaptive_demand_uses_signs_only() -> None:
    """``U_i = sgn(K_Ti) (kappa_0 alpha_c + kappa_1 + ... + kappa_n)``."""
    kappa = np.array([0.25, 3.0, -1.0])
    for coefficients in ((1.2, -0.8), (7.0, -0.1)):
        assert demands(adaptive_demand, coefficients, kappa, 40.0).tolist() == [12.0, -12.0]


def test_adaptive_law_is_exact_for_a_held_error() -> None:
    """``kappa_j = -theta_j u_a/s_k + (kappa_j(0) + theta_j u_a/s_k) exp(-Gamma_j s_k t)``."""
    record, thrust, error = adaptive(), 80.0, 0.05
    kappa = initial_kappa(record, 2)
    adaptation = make_adaptation(record, 2, PERIOD)
    for _ in range(50):
        adapt(adaptation, kappa, thrust, error)
    target = -np.array([thrust, 1.0, 1.0]) * error / 0.2
    decay = np.exp(-np.array([0.1, 100.0, 50.0]) * 0.2 * 50 * PERIOD)
    np.testing.assert_allclose(kappa, target + (np.array([0.25, 0.0, 0.5]) - target) * decay, rtol=1e-12)


def test_adaptive_law_without_a_leak_integrates() -> None:
    record = adaptive(leak=0.0)
    kappa = initial_kappa(record, 2)
    adapt(make_adaptation(record, 2, PERIOD), kappa, 80.0, 0.05)
    np.testing.assert_allclose(kappa, [0.25 - 0.1 * 4.0 * PERIOD, -100.0 * 0.05 * PERIOD, 0.5 - 50.0 * 0.05 * PERIOD])


def test_projection_holds_kappa_in_its_box() -> None:
    record = adaptive(lower=(0.1, -0.002, -10.0), upper=(0.3, 0.5, 10.0))
    kappa, adaptation = initial_kappa(record, 2), make_adaptation(record, 2, PERIOD)
    for _ in range(10):
        adapt(adaptation, kappa, 1e4, 0.5)
    assert kappa[0] == 0.1
    assert kappa[1] == -0.002
    assert -10.0 < kappa[2] < 0.5
    for _ in range(1000):
        adapt(adaptation, kappa, 1e4, -0.5)
    assert kappa[0] == 0.3
    assert kappa[1] == 0.5


def test_motion_ratchets_the_first_entry_up() -> None:
    """Known weakness of (27): with alpha_c = -k u_a, kappa_0 grows whatever the direction of the motion."""
    record = adaptive(leak=0.0)
    kappa, adaptation = initial_kappa(record, 2), make_adaptation(record, 2, PERIOD)
    errors = 0.1 * np.sin(np.arange(2000) * 0.01)
    for error in errors:
        adapt(adaptation, kappa, -1e4 * error, error)
    assert kappa[0] - 0.25 == pytest.approx(0.1 * 1e4 * np.sum(errors**2) * PERIOD, rel=1e-9)
    assert abs(kappa[1]) < 0.05 * (kappa[0] - 0.25) * 100.0


def test_known_factors_have_no_kappa() -> None:
    record = KnownFactors(method="known")
    assert make_allocation(record, 2, PERIOD).method == KNOWN
    assert initial_kappa(record, 2).tolist() == [0.0, 0.0, 0.0]
