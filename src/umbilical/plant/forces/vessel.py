"""The vessel's pull on the upper end, which moves with it and through which the winch pays out, eq. (7)."""

from __future__ import annotations

from umbilical.compile import glue
from umbilical.plant.forces.force import Force


@glue
def power(line_inertia: float, tension: float, slope: float, speed: float, vessel: float) -> float:
    """``-T p (e' + v p) + v/2 (rho W^2 + T p^2)`` with W = e' + v p, W; ``vessel`` is e', m/s.

    In water with M for rho, Tt for T and vb for v.
    """
    velocity = vessel + speed * slope
    pull = -tension * slope * (vessel + 0.5 * speed * slope)
    return pull + 0.5 * line_inertia * speed * velocity * velocity


FORCE = Force("work_vessel")
