"""Disturbance observer of a motor, eq. (61), in the scaled current z2 = (K_t/J) i and V = f23 U.

::

    d^ = ups + g_o z2,   ups' = -g_o ups - g_o (g_o z2 + f21 z1 + f22 z2 + V)

so that d^' = g_o (f23 d2 - d^). The paper writes the gain g_o with the symbol of the inductance; taken
literally it would need 500 s to settle.
"""

from __future__ import annotations

from umbilical.compile import kernel
from umbilical.relations.formulas import MotorConstants


@kernel
def start_motor_disturbance(gain: float, scaled_current: float) -> float:
    """ups such that the estimate starts at 0."""
    return -gain * scaled_current


@kernel
def advance_motor_disturbance(
    c: MotorConstants, gain: float, decay: float, ups: float, speed: float, scaled_current: float, drive: float
) -> float:
    """ups after one period; ``drive`` is the V held over it and ``decay`` = exp(-gain * period)."""
    known = gain * scaled_current + c.f21 * speed + c.f22 * scaled_current + drive
    return decay * ups - (1.0 - decay) * known
