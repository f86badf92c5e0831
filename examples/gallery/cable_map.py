"""
Waves along the cable
=====================

Displacement over time and depth while the winch hauls in.
"""

import umbilical

run = umbilical.simulate(umbilical.load("haul-in", {"duration": 20.0}))
axes = umbilical.plot_cable(run)
