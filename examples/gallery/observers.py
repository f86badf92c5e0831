"""
What the observers believe
==========================

Estimates on top of what they estimate.
"""

import umbilical

run = umbilical.simulate(umbilical.load("paper", {"duration": 20.0}))
axes = umbilical.plot_observers(run, channel="disturbance")
