"""The output-feedback boundary law, eq. (22).

::

    u_a = x2^ + beta z1
    alpha_c = -k_a u_a - beta m z2^ + T z1 + c_tip x2^ - D^

u_a -> 0 is the boundary condition Dy/Dt = -beta y_x: it reflects the slope by (c_l - beta)/(c_l + beta),
with c_l = sqrt(T_l/rho).
"""

from __future__ import annotations

from umbilical.compile import kernel


@kernel
def boundary_error(slope_gain: float, velocity: float, slope: float) -> float:
    """u_a, m/s."""
    return velocity + slope_gain * slope


@kernel
def boundary_thrust(
    damping_gain: float,
    slope_gain: float,
    mass: float,
    error: float,
    slope_rate: float,
    known_force: float,
    disturbance: float,
) -> float:
    """alpha_c, N; ``known_force`` is T z1 + c_tip x2^, N."""
    return -damping_gain * error - slope_gain * mass * slope_rate + known_force - disturbance
