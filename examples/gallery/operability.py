"""
In which sea it can be done
===========================

Largest significant wave height at which the cable stays taut, over depth and wave period, for a work-class ROV.
"""

import numpy as np

import umbilical

found = umbilical.operate(
    umbilical.load_operation("work-class"),
    ["slack=1e-2/3h"],
    depth=np.linspace(500.0, 3000.0, 6),
    period=np.linspace(6.0, 12.0, 7),
    heading=np.radians([135.0, 180.0]),
)
figure = umbilical.plot_operability(found)
