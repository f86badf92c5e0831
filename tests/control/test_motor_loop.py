"""The loop inside a motor: command filter and backstepping."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.control.motor.backstepping import Backstepping, backstepping_drive, smooth_sign
from umbilical.control.motor.command_filter import Reference, advance_filter, make_command_filter
from umbilical.frames import numbers
from umbilical.relations.formulas import motor_constants, soft_signed_root
from umbilical.scenario.hardware import Motor
from umbilical.verify import control

pytestmark = pytest.mark.nojit

MOTOR = Motor.model_validate(control.MOTOR)
PERIOD, POLE = 1e-3, 200.0
GAINS = Backstepping(50.0, 500.0, 1.5, 0.1, 2.0, 4.0, 120.0)


def test_command_filter_step_response_is_exact() -> None:
    """Triple pole: ``w_d = r (1 - exp(-x)(1 + x + x^2/2))``, ``w_d' = r w_c x^2/2 exp(-x)``, x = w_c t."""
    command_filter, reference = make_command_filter(POLE, 1e-3, PERIOD), Reference.one()
    root = soft_signed_root(100.0, 1e-3)
    assert root == pytest.approx(10.0, rel=1e-9)
    for k in range(1, 40):
        advance_filter(command_filter, reference, 100.0)
        x = POLE * k * PERIOD
        exact = (
            root
            * np.exp(-x)
            * np.array([np.exp(x) - 1.0 - x - x * x / 2.0, POLE * x * x / 2.0, POLE**2 * (x - x * x / 2.0)])
        )
        np.testing.assert_allclose(numbers(reference), exact, rtol=1e-10, atol=1e-7)


@pytest.mark.parametrize("demand", [-400.0, -1e-6, 0.0, 1e-6, 400.0])
def test_soft_root_is_odd_and_close_to_the_root(demand: float) -> None:
    assert soft_signed_root(-demand, 1e-3) == -soft_signed_root(demand, 1e-3)
    if abs(demand) > 1.0:
        assert soft_signed_root(demand, 1e-3) == pytest.approx(np.sign(demand) * np.sqrt(abs(demand)), rel=1e-10)
    assert abs(soft_signed_root(demand, 1e-3)) <= np.sqrt(abs(demand))


def test_smooth_sign() -> None:
    assert smooth_sign(0.0, 0.1) == 0.0
    assert smooth_sign(100.0, 0.1) == pytest.approx(1.0, abs=1e-6)
    assert smooth_sign(-0.1, 0.1) == pytest.approx(-np.sqrt(0.5), rel=1e-15)


def wanted_current(speed: float, e1: float, rate_reference: float) -> float:
    """i_d of (52), written out again."""
    c = motor_constants(MOTOR)
    robust = 4.0 * 1.5 * e1 / np.sqrt(e1**2 + 0.1**2)
    return -50.0 * e1 - c.f11 * speed - c.f12 * speed * abs(speed) - robust + rate_reference


@pytest.mark.parametrize(("speed", "scaled_current"), [(12.0, 300.0), (-12.0, -250.0), (0.0, 40.0)])
def test_drive_is_the_exact_derivative_of_the_wanted_current(speed: float, scaled_current: float) -> None:
    """(60) with i_d' of (59) replaced by a central difference of (52) along the nominal motion."""
    c, reference = motor_constants(MOTOR), (11.9, 3.0, -70.0)

    def along(tau: float) -> float:
        """i_d a little later: z1' = z2 + f11 z1 + f12 z1|z1|, the reference by its own derivatives."""
        rate = scaled_current + c.f11 * speed + c.f12 * speed * abs(speed)
        later = speed + tau * rate
        return wanted_current(later, later - (reference[0] + tau * reference[1]), reference[1] + tau * reference[2])

    tau = 1e-6
    wanted_rate = (along(tau) - along(-tau)) / (2.0 * tau)
    e1, e2 = speed - reference[0], scaled_current - along(0.0)
    exact = -500.0 * e2 - e1 - c.f21 * speed - c.f22 * scaled_current + wanted_rate
    exact -= 120.0 * 1.5 * e2 / np.sqrt(e2**2 + 2.0**2)
    drive = backstepping_drive(c, GAINS, speed, scaled_current, Reference.one(*reference))
    assert drive == pytest.approx(exact, rel=1e-6)


def test_at_rest_on_the_reference_nothing_but_the_friction_is_driven() -> None:
    """e1 = e2 = 0 at constant speed: V = -f21 z1 - f22 z2, the steady voltage over f23^-1."""
    c, speed = motor_constants(MOTOR), 50.0
    scaled_current = -(c.f11 * speed + c.f12 * speed**2)
    drive = backstepping_drive(c, GAINS, speed, scaled_current, Reference.one(speed_reference=speed))
    assert drive / c.f23 == pytest.approx(75.015, rel=1e-12)
