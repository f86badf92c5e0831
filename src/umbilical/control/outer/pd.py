"""The paper's baseline, eq. (66)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from umbilical.compile import glue, kernel
from umbilical.control.contract import OuterDecision, TipReadings
from umbilical.control.rates import outer_period, within_a_period
from umbilical.relations.water import payload_inertia
from umbilical.scenario.control import Control, ProportionalDerivative
from umbilical.scenario.findings import Finding
from umbilical.scenario.hardware import Payload


class PDGains(NamedTuple):
    """k_p, N/m, and k_d, N s/m; zero without the law."""

    position_gain: float
    velocity_gain: float


def make_pd(control: Control) -> PDGains:
    """The gains of a scenario's law."""
    law = control.law
    return (
        PDGains(law.position_gain, law.velocity_gain) if isinstance(law, ProportionalDerivative) else PDGains(0.0, 0.0)
    )


@glue
def update_pd(c: PDGains, tip: TipReadings, out: OuterDecision) -> None:
    """Decide the thrust; ``out`` holds the estimate of the velocity."""
    out.thrust_command = pd_thrust(c.position_gain, c.velocity_gain, tip.tip_displacement, out.tip_velocity_estimate)


@kernel
def pd_thrust(position_gain: float, velocity_gain: float, displacement: float, velocity: float) -> float:
    """alpha_c = -k_p y(l,t) - k_d Dy/Dt(l,t), N."""
    return -position_gain * displacement - velocity_gain * velocity


def proportional_derivative(control: Control, payload: Payload) -> Iterator[Finding]:
    """The PD baseline, sampled, still is a spring and a damper."""
    law, period = control.law, outer_period(control)
    if isinstance(law, ProportionalDerivative):
        yield from within_a_period(
            "control.law.velocity_gain", law.velocity_gain, "N s/m", 1.0 / payload_inertia(payload), period
        )
        yield from within_a_period(
            "control.law.position_gain", law.position_gain, "N/m", period / payload_inertia(payload), period
        )
