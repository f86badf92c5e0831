"""A controller of one's own: damp the ROV's velocity, which no sensor gives, through a filter of one's own."""

import umbilical


class Damper:
    """Thrust against the velocity; the scenario's allocation and motor loops turn it into voltages.

    The velocity is the rate of a first-order low-pass of the displacement, the state: (y - state) / time_constant.
    """

    period = 0.005  # s; a multiple of control.period
    gain = 2000.0  # N s/m
    time_constant = 0.05  # s

    def start(self, measurement: umbilical.Measurement) -> float:
        """The filter starts where the ROV is."""
        return measurement.tip_displacement

    def update(self, t: float, measurement: umbilical.Measurement, state: float) -> tuple[umbilical.Command, float]:
        """Thrust (N) from now on, and the filter's new state (m)."""
        velocity = (measurement.tip_displacement - state) / self.time_constant
        return umbilical.Command(thrust=-self.gain * velocity), state + self.period * velocity


scenario = umbilical.load("paper", {"duration": 20.0})
damped = umbilical.simulate(scenario, Damper())
free = umbilical.simulate(umbilical.load("paper-none", {"duration": 20.0}))
print(f"largest |y(l,t)|: {free.metrics['tip_peak']:.2f} m free, {damped.metrics['tip_peak']:.2f} m damped")
