"""Damped eigenvalues: a damper at the ROV, and damping in proportion to the mass everywhere."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.modes import bessel_frequencies, damped_pole, engine_poles
from tests.support.scenarios import open_loop
from umbilical import Scenario

LENGTH = 400.0


def damped(cable: float, payload: float) -> Scenario:
    scenario = open_loop(winch__length=LENGTH, grid__elements=24)
    return scenario.replace({"cable.damping": cable, "payload.damping": payload})


def test_proportional_damping_is_exact() -> None:
    """With c_tip = c m/rho every mode decays alike: ``lam = -c/(2 rho) +- i sqrt(w^2 - (c/(2 rho))^2)``."""
    rate = 0.04 / (2.0 * 2.0)
    found = engine_poles(damped(0.04, 0.04 * 500.0 / 2.0), 6)
    exact = -rate + 1j * np.sqrt(bessel_frequencies(2.0, 500.0, LENGTH, 6) ** 2 - rate**2)
    np.testing.assert_allclose(found, exact, rtol=1e-5)


@pytest.mark.parametrize("damping", [40.0, 400.0])
def test_damper_at_the_payload(damping: float) -> None:
    """Roots of ``(m lam^2 + c_tip lam) Y + T Y_x = 0`` at the ROV."""
    found = engine_poles(damped(0.0, damping), 5)
    for pole in found:
        exact = damped_pole(2.0, 500.0, LENGTH, damping, near=pole)
        assert abs(pole - exact) < 1e-5 * abs(exact)
        assert abs(pole.real - exact.real) < 1e-3 * abs(exact.real)
    assert np.real(found).max() < -1e-4, "the damper acts"


def test_undamped_limit_of_the_damped_equation_is_the_bessel_one() -> None:
    for frequency in bessel_frequencies(2.0, 500.0, LENGTH, 4):
        assert damped_pole(2.0, 500.0, LENGTH, 0.0, near=1.001j * frequency) == pytest.approx(1j * frequency, rel=1e-12)
