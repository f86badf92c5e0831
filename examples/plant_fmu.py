"""The plant as an FMU (FMI 3.0, co-simulation) with Python inside, for a simulator that has a controller of its own.

    pythonfmu3 build -f plant_fmu.py

writes Plant.fmu. It is a tool coupling: wherever it runs, Python with umbilical and pythonfmu3 must be installed. A
step is a whole number of control periods; inputs are held over it. Step the controller first, give its voltages to the
plant, then step the plant, and give its readings to the controller: in this order nothing is late.
"""

import numpy as np
from pythonfmu3 import CoSimulation, Float64, Fmi3Causality, Fmi3Slave, Fmi3StepResult

import umbilical

SCENARIO = umbilical.load("paper")
READINGS = ("tip_displacement", "tip_slope", "payout_acceleration")
MOTORS = range(1, len(SCENARIO.motors) + 1)


class Plant(Fmi3Slave, CoSimulation):
    """Cable, ROV and motors of a scenario, with its sensors."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.episode = None
        self.time = 0.0
        self.register_variable(Float64("time", causality=Fmi3Causality.independent))
        for name in [f"motor_voltage_{i}" for i in MOTORS]:
            setattr(self, name, 0.0)
            self.register_variable(Float64(name, causality=Fmi3Causality.input, start=0.0))
        for name in (*READINGS, *(f"motor_{what}_{i}" for what in ("speed", "current") for i in MOTORS)):
            setattr(self, name, 0.0)
            self.register_variable(Float64(name, causality=Fmi3Causality.output))

    def exit_initialization_mode(self):
        """Set the plant up, at rest; the first readings are there before the first step."""
        self.episode = umbilical.Episode(SCENARIO)
        self.show(self.episode.measurement)

    def do_step(self, current_time, step_size):
        """Hold the voltages over a step."""
        periods = round(step_size / SCENARIO.control.period)
        if periods < 1 or abs(periods * SCENARIO.control.period - step_size) > 1e-9:
            raise ValueError(f"a step of {step_size} s is no whole number of periods of {SCENARIO.control.period} s")
        assert self.episode is not None  # a simulator initializes first
        for _ in range(periods):
            voltage = np.array([getattr(self, f"motor_voltage_{i}") for i in MOTORS])
            self.show(self.episode.step(umbilical.Command(voltage=voltage)))
        return Fmi3StepResult()

    def show(self, measurement):
        """Readings as outputs."""
        for name in READINGS:
            setattr(self, name, float(getattr(measurement, name)))
        for i in MOTORS:
            setattr(self, f"motor_speed_{i}", float(measurement.motor_speed[i - 1]))
            setattr(self, f"motor_current_{i}", float(measurement.motor_current[i - 1]))
