"""Natural frequencies of the hanging cable with a free ROV, from the Jacobian of the engine's own step.

Closed form: "Frequencies of a hanging chain supporting an end mass"; the constant-tension limit is
``cot b = (m/(rho l)) b`` with ``b = w l/c``.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.support.modes import bessel_frequencies, engine_poles
from tests.support.scenarios import STEADY_TENSION, UNDAMPED, open_loop
from umbilical import Scenario
from umbilical.engine.linear import step_poles

TOLERANCE = 1e-4
PRINTED = {
    500.0: (0.1536771590334, 0.483646205031, 0.8881725784718, 1.30776502146, 1.731946215684, 2.158067989623),
    400.0: (0.1702, 0.5687, 1.056),
    300.0: (0.1942, 0.7072),
}


def hanging(length: float, **overrides: object) -> Scenario:
    return open_loop(winch__length=length, **overrides).replace(UNDAMPED)


def six(scenario: Scenario) -> np.ndarray:
    return np.imag(engine_poles(scenario, 6))


@pytest.mark.parametrize("length", PRINTED)
def test_frequencies_at_the_default_grid(length: float) -> None:
    scenario = hanging(length)
    exact = bessel_frequencies(2.0, 500.0, length, 6)
    np.testing.assert_allclose(exact[: len(PRINTED[length])], PRINTED[length], rtol=2e-4 if length < 500.0 else 1e-11)
    np.testing.assert_allclose(six(scenario), exact, rtol=TOLERANCE)


@pytest.mark.parametrize("mass", [50.0, 5000.0])
def test_frequencies_for_light_and_heavy_payloads(mass: float) -> None:
    np.testing.assert_allclose(
        six(hanging(500.0, payload__mass=mass)), bessel_frequencies(2.0, mass, 500.0, 6), rtol=TOLERANCE
    )


def test_frequencies_under_constant_tension() -> None:
    ratio, speed = 500.0 / (2.0 * 500.0), np.sqrt(500.0 * 10.0 / 2.0)
    roots = [
        brentq(lambda b: np.cos(b) - ratio * b * np.sin(b), k * np.pi + 1e-9, (k + 1) * np.pi - 1e-9, xtol=1e-14)
        for k in range(6)
    ]
    scenario = hanging(500.0).replace(STEADY_TENSION)
    np.testing.assert_allclose(six(scenario), np.array(roots) * speed / 500.0, rtol=TOLERANCE)


def test_a_fixed_undamped_cable_decays_by_no_more_than_the_step_takes() -> None:
    """The leading error of the multistep method is ``3/8 w^4 dt^3``, 1/s; the grid takes less from these modes."""
    poles = engine_poles(hanging(500.0), 12)
    np.testing.assert_allclose(-np.real(poles), 3.0 / 8.0 * np.imag(poles) ** 4 * 1e-9, rtol=0.01, atol=1e-13)


def test_no_mode_of_the_grid_grows() -> None:
    assert np.real(step_poles(hanging(500.0))).max() < 1e-9
