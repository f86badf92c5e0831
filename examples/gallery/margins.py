"""
What the real loop survives
===========================

Gain, phase and delay margins of the sampled loop with its motors.
"""

import umbilical

report = umbilical.margins(umbilical.load("ringdown"))
figure = umbilical.plot_margins(report)
