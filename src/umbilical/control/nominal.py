"""What the controller believes of its motors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from umbilical.errors import Problem
from umbilical.frames import numbers, real
from umbilical.relations.formulas import MotorConstants, motor_constants
from umbilical.scenario.control import Control, Nominal
from umbilical.scenario.findings import Finding, amount
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


def nominal(control: Control, motors: Sequence[Motor]) -> Iterator[Finding]:
    """What the controller believes of the motors it believes of each of them."""
    believed = control.nominal
    for name, values in (("thrust_coefficients", believed.thrust_coefficients), ("motors", believed.motors)):
        if values is not None and len(values) != len(motors):
            yield Problem(
                f"control.nominal.{name}", f"{len(values)} entries", f"{len(motors)} entries", "one for each motor",
                "as many entries as [[motors]], or leave it out",
            )  # fmt: skip
    coefficients = {f"thrust_coefficients.{k}": c for k, c in enumerate(believed.thrust_coefficients or (), start=1)}
    for number, motor in enumerate(believed.motors or (), start=1):
        coefficients[f"motors.{number}.thrust_coefficient"] = motor.thrust_coefficient
    for name, coefficient in coefficients.items():
        if coefficient == 0.0:
            yield Problem(
                f"control.nominal.{name}", amount(0.0, "N s2/rad2"), "above or below 0",
                "the allocation divides by the sum of their sizes", "the sign says which way it pushes",
            )  # fmt: skip
