"""The upwind flux, which takes energy from waves too short for the grid (``plant/cable.py: meet, meet_ends``)."""

from __future__ import annotations

from umbilical.plant.forces.force import Force

FORCE = Force("work_grid")
