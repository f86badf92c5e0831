"""
A motor dies, and what survives
===============================

Motor 2 is dead from 5 s on. Nobody tells the controller: the allocation adapts to what the other one delivers.
"""

import umbilical

changes = {"duration": 20.0, "faults.1.start": 5.0}
run = umbilical.simulate(umbilical.load("paper-dead-adaptive", changes))
axes = umbilical.plot_motors(run, channel="motor_voltage")
print(f"peak after the fault: {run.metrics['tip_peak_after_fault']:.3g} m")
