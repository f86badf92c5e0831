"""Added mass: across it is inertia (``plant/cable.py``: M and m + A_h), but it does not slide along with the cable.

The balance pairs forces with Wb = y_t + vb y_x, and where the cable ends at the ROV the moved water leaves it.
"""

from __future__ import annotations

from umbilical.compile import glue
from umbilical.plant.cable import CableConstants, Ends, Moment
from umbilical.plant.forces.force import Force
from umbilical.relations.tension import tension


@glue
def power(cable: CableConstants, ends: Ends, moment: Moment, sinks: float) -> float:
    """``1/2 rho_a v_z V^2 - rho_a v_z^2 p V - 1/2 slip (Tt - rho_a v_z slip) p^2`` at the ROV, W; v_z is ``sinks``."""
    velocity, slope, moved = ends.tip_velocity, ends.tip_slope, cable.added * sinks
    pull = tension(0.0, moment.net, moment.across)
    carried = 0.5 * moved * velocity * velocity - moved * sinks * slope * velocity
    return carried - 0.5 * moment.slip * (pull - moved * moment.slip) * slope * slope


FORCE = Force("work_added_mass")
