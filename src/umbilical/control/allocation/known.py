"""Known factors, without fault control: ``U_i = sgn(K_Ti) alpha_c / sum_j |K_Tj|``."""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.control.contract import MotorDecision
from umbilical.control.nominal import NominalMotor


@kernel
def known_demand(nominal: NominalMotor, thrust: float, decision: MotorDecision) -> None:
    """Decide the demands on the motors from their believed thrust coefficients."""
    total = 0.0
    for i in range(nominal.size):
        total += abs(nominal[i].thrust_coefficient)
    for i in range(nominal.size):
        decision[i].demand = np.sign(nominal[i].thrust_coefficient) * thrust / total
