"""
Noisy sensors
=============

The voltage that the noise of a position sensor costs.
"""

import umbilical

peaks = {}
for noise in (0.0, 1e-6, 1e-5):
    run = umbilical.simulate(umbilical.load("paper", {"duration": 5.0, "sensors.tip_displacement.noise": noise}))
    peaks[noise] = run.metrics["motor_voltage_rms"]
print({noise: round(volts, 2) for noise, volts in peaks.items()})
axes = umbilical.plot_motors(run, channel="motor_voltage")
