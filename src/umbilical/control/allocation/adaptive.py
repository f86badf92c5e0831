"""Fault control, eqs. (23) and (27): thrust factors and faults unknown.

::

    U_i = sgn(K_Ti) kappa^T theta,   theta = [alpha_c, 1, ..., 1]
    kappa' = -Gamma (theta u_a + s_k kappa)

Advanced exactly for theta u_a held over the period. On average motion ratchets kappa_0 up and only the
leak holds it; ``upper`` projects kappa onto a box (ours, recommended; infinite in the published law).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from umbilical.compile import kernel
from umbilical.control.contract import MotorDecision
from umbilical.control.nominal import NominalMotor
from umbilical.control.rates import outer_period, within_a_period
from umbilical.errors import Problem
from umbilical.frames import Frame, real
from umbilical.scenario.control import AdaptiveAllocation, Allocation, Control
from umbilical.scenario.findings import Finding
from umbilical.scenario.hardware import Motor


class KappaStep(Frame):
    """Exact step of one kappa: ``kappa <- decay kappa - gain theta u_a``, then projected onto its bounds."""

    kappa_decay = real()
    kappa_gain = real()
    kappa_lower = real()
    kappa_upper = real()


def make_adaptation(record: Allocation, motors: int, period: float) -> KappaStep:
    """Discrete form for one period, one record for each of kappa_0 ... kappa_n; known factors get idle ones."""
    steps = KappaStep.many(motors + 1)
    if not isinstance(record, AdaptiveAllocation):
        return steps
    rates = np.array(record.rates)
    leaking = rates * record.leak * period
    # (1 - exp(-leaking)) / leak, which tends to rates * period without a leak.
    steps["kappa_gain"] = -np.expm1(-leaking) / record.leak if record.leak > 0.0 else rates * period
    steps["kappa_decay"] = np.exp(-leaking)
    steps["kappa_lower"] = record.lower or -np.inf
    steps["kappa_upper"] = record.upper or np.inf
    return steps


def initial_kappa(record: Allocation, motors: int) -> np.ndarray:
    """kappa(0), shape (n + 1,); zero with known factors."""
    return np.array(record.initial) if isinstance(record, AdaptiveAllocation) else np.zeros(motors + 1)


@kernel
def adapt(steps: KappaStep, kappa: np.ndarray, thrust: float, error: float) -> None:
    """One period of (27)."""
    for j in range(kappa.size):
        step, theta = steps[j], thrust if j == 0 else 1.0
        wanted = step.kappa_decay * kappa[j] - step.kappa_gain * theta * error
        kappa[j] = min(max(wanted, step.kappa_lower), step.kappa_upper)


@kernel
def common_demand(kappa: np.ndarray, thrust: float) -> float:
    """kappa^T theta."""
    common = kappa[0] * thrust
    for j in range(1, kappa.size):
        common += kappa[j]
    return common


@kernel
def adaptive_demand(nominal: NominalMotor, kappa: np.ndarray, thrust: float, decision: MotorDecision) -> None:
    """Decide the demands (23); only the signs of the thrust coefficients are used."""
    common = common_demand(kappa, thrust)
    for i in range(nominal.size):
        decision[i].demand = np.sign(nominal[i].thrust_coefficient) * common


def adaptation(control: Control, motors: Sequence[Motor], ideal_thruster: bool) -> Iterator[Finding]:
    """Lists of the adaptive law have n + 1 entries, positive rates and a box around the start."""
    law = control.allocation
    if not isinstance(law, AdaptiveAllocation):
        return
    if ideal_thruster:
        yield Problem(
            "control.allocation.method", '"adaptive"', '"known" with ideal_thruster',
            "an ideal thruster has no motors to share the thrust", "set ideal_thruster = false",
        )  # fmt: skip
    for name in ("rates", "initial", "lower", "upper"):
        values = getattr(law, name)
        if values is not None and len(values) != len(motors) + 1:
            yield Problem(
                f"control.allocation.{name}", f"{len(values)} entries", f"{len(motors) + 1} entries",
                f"kappa_0 and one more for each of the {len(motors)} motors", "one entry each",
            )  # fmt: skip
    for number, rate in enumerate(law.rates, start=1):
        if rate <= 0.0:
            yield Problem(
                f"control.allocation.rates.{number}", f"{rate:g}", "above 0",
                "a rate of the wrong sign adapts away from the fault", "a positive rate",
            )  # fmt: skip
    yield from _box(law)


def _box(law: AdaptiveAllocation) -> Iterator[Finding]:
    for number, start in enumerate(law.initial, start=1):
        lower, upper = (box[number - 1] if box and number <= len(box) else start for box in (law.lower, law.upper))
        if not lower <= start <= upper:
            yield Problem(
                f"control.allocation.initial.{number}",
                f"{start:g}",
                f"from {lower:g} to {upper:g}",
                "kappa is projected onto the box between lower and upper, and starts in it",
                "a start inside the box, or a box around the start",
            )


def adaptation_has_its_error(control: Control) -> Iterator[Finding]:
    """The adaptive law is driven by u_a, which only the boundary law computes."""
    if isinstance(control.allocation, AdaptiveAllocation) and not control.law.boundary_gains:
        yield Problem(
            "control.allocation.method",
            '"adaptive"',
            f'"known" with the law "{control.law.kind}"',
            "the adaptive law is driven by u_a, which only the boundary law computes: kappa would only leak away",
            'set control.law.kind = "boundary" or control.allocation.method = "known"',
        )


def leak(control: Control) -> Iterator[Finding]:
    """The leak of the adaptive law forgets, and does not overshoot."""
    law = control.allocation
    if isinstance(law, AdaptiveAllocation):
        fastest = max(law.rates)
        yield from within_a_period("control.allocation.leak", law.leak, "", max(fastest, 0.0), outer_period(control))
