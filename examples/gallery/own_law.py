"""
Your own law against the paper's
================================

A controller is a class with a period and two methods; what it logs becomes a channel of the run.
"""

from matplotlib.figure import Figure

import umbilical


class Damper:
    """Thrust against the velocity of the ROV, which a low-pass takes from the displacement."""

    period, gain, time_constant = 0.005, 2000.0, 0.05  # s, N s/m, s

    def start(self, measurement):
        return measurement.tip_displacement

    def update(self, t, measurement, state):
        velocity = (measurement.tip_displacement - state) / self.time_constant
        command = umbilical.Command(thrust=-self.gain * velocity, log={"velocity": velocity})
        return command, state + self.period * velocity


scenario = umbilical.load("paper", {"duration": 20.0})
paper, own = umbilical.simulate(scenario), umbilical.simulate(scenario, Damper())
figure = Figure(figsize=(3.5, 2.6), layout="constrained")  # one column of a page
axes = umbilical.plot_tip([paper, own], ax=figure.add_subplot())
axes.legend(["the paper's law", "the class above"], frameon=False, loc="upper left")
print(own["controller_velocity"].attrs["long_name"], float(abs(own["controller_velocity"]).max()), "m/s")
