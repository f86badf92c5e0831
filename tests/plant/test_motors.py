"""The drive of a motor: its limit, then its faults."""

from __future__ import annotations

import pytest

from umbilical.plant.exogenous import MotorExogenous
from umbilical.plant.motors import applied_voltage, make_motors
from umbilical.scenario.hardware import Motor
from umbilical.verify.control import MOTOR

pytestmark = pytest.mark.nojit


@pytest.mark.parametrize(
    ("wanted", "effectiveness", "stuck", "reached"),
    [
        (4.0, 1.0, 0.0, 4.0),
        (-15.0, 1.0, 0.0, -10.0),
        (20.0, 0.5, 0.0, 5.0),  # half of what the drive can give, not of what is wanted
        (20.0, 0.0, 30.0, 30.0),  # a broken drive knows no limit
    ],
)
def test_the_limit_comes_before_the_faults(wanted: float, effectiveness: float, stuck: float, reached: float) -> None:
    motors = make_motors([Motor.model_validate(MOTOR | {"voltage_limit": 10.0})])
    outside = MotorExogenous.one(drive_effectiveness=effectiveness, stuck_voltage=stuck)
    assert applied_voltage(motors[0], wanted, outside) == reached
