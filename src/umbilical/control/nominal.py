"""What the controller believes of its motors."""

from __future__ import annotations

import numpy as np

from umbilical.frames import numbers, real
from umbilical.relations.formulas import MotorConstants, motor_constants
from umbilical.scenario.control import Nominal
from umbilical.scenario.hardware import Motor


class NominalMotor(MotorConstants):
    """Believed constants of one motor with its propeller."""

    thrust_coefficient = real()
    voltage_limit = real()


def make_nominal_motors(nominal: Nominal, motors: tuple[Motor, ...]) -> NominalMotor:
    """One record per motor; what is not believed is as it truly is, and no voltage limit means an infinite one."""
    believed = nominal.motors or motors
    records = NominalMotor.many(len(believed))
    for i, motor in enumerate(believed):
        limit = np.inf if motor.voltage_limit is None else motor.voltage_limit
        records[i] = (*numbers(motor_constants(motor)), motor.thrust_coefficient, limit)
    if nominal.thrust_coefficients:
        records["thrust_coefficient"] = nominal.thrust_coefficients
    return records
