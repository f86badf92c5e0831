"""Fault control, eqs. (23) and (27): thrust factors and faults unknown.

::

    U_i = sgn(K_Ti) kappa^T theta,   theta = [alpha_c, 1, ..., 1]
    kappa' = -Gamma (theta u_a + s_k kappa)

Advanced exactly for theta u_a held over the period. On average motion ratchets kappa_0 up and only the
leak holds it; ``upper`` projects kappa onto a box (ours, recommended; infinite in the published law).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import kernel
from umbilical.scenario.control import AdaptiveAllocation, Allocation

# Rows of Adaptation.form.
DECAY, GAIN, LOWER, UPPER = range(4)


class Adaptation(NamedTuple):
    """Exact step ``kappa <- decay kappa - gain theta u_a``, then projected onto the box; ``form`` is (4, n + 1)."""

    enabled: bool
    form: np.ndarray


def make_adaptation(record: Allocation, motors: int, period: float) -> Adaptation:
    """Discrete form for one period; known factors get an idle one."""
    if not isinstance(record, AdaptiveAllocation):
        return Adaptation(False, np.zeros((4, motors + 1)))
    rates = np.array(record.rates)
    leaking = rates * record.leak * period
    # (1 - exp(-leaking)) / leak, which tends to rates * period without a leak.
    gain = -np.expm1(-leaking) / record.leak if record.leak > 0.0 else rates * period
    lower = record.lower or (-np.inf,) * (motors + 1)
    upper = record.upper or (np.inf,) * (motors + 1)
    return Adaptation(True, np.array([np.exp(-leaking), gain, lower, upper]))


def initial_kappa(record: Allocation, motors: int) -> np.ndarray:
    """kappa(0), shape (n + 1,); zero with known factors."""
    return np.array(record.initial) if isinstance(record, AdaptiveAllocation) else np.zeros(motors + 1)


@kernel
def adapt(adaptation: Adaptation, kappa: np.ndarray, thrust: float, error: float) -> None:
    """One period of (27)."""
    f = adaptation.form
    for j in range(kappa.size):
        theta = thrust if j == 0 else 1.0
        wanted = f[DECAY, j] * kappa[j] - f[GAIN, j] * theta * error
        kappa[j] = min(max(wanted, f[LOWER, j]), f[UPPER, j])


@kernel
def adaptive_demand(coefficients: np.ndarray, kappa: np.ndarray, thrust: float, demand: np.ndarray) -> None:
    """Demands (23) into ``demand``, rad2/s2; only the signs of the coefficients are used."""
    common = kappa[0] * thrust
    for j in range(1, kappa.size):
        common += kappa[j]
    for i in range(coefficients.size):
        demand[i] = np.sign(coefficients[i]) * common
