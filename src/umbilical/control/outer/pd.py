"""The paper's baseline, eq. (66)."""

from __future__ import annotations

from umbilical.compile import kernel


@kernel
def pd_thrust(position_gain: float, velocity_gain: float, displacement: float, velocity: float) -> float:
    """alpha_c = -k_p y(l,t) - k_d Dy/Dt(l,t), N."""
    return -position_gain * displacement - velocity_gain * velocity
