"""What a set of gains does in a simulation: the ring-down, the peak of the ROV, voltages, speeds, chatter."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from umbilical.control.cascade import Cascade
from umbilical.control.contract import Command, Measurement
from umbilical.engine.simulate import simulate
from umbilical.run import Run, Status
from umbilical.scenario.scenario import Scenario

LATE = 2.0 / 3.0
"""Share of the run after which the ring-down is judged."""
CHATTER = 10.0
"""Hz: what a voltage does above it serves no motion of the cable."""


@dataclass(frozen=True)
class DesignTrial:
    """One simulation.

    Attributes:
        run: the run.
        late_mid_peak: largest |y(l/2,t)| in the last third, m.
        tip_peak: largest |y(l,t)|, m.
        voltage_peak: V.
        speed_peak: rad/s.
        chatter: largest RMS of a motor's voltage above 10 Hz in the last third, V; NaN if the run diverged.
    """

    run: Run
    late_mid_peak: float
    tip_peak: float
    voltage_peak: float
    speed_peak: float
    chatter: float

    @property
    def completed(self) -> bool:
        """Whether the run reached its end."""
        return self.run.status is Status.COMPLETED


class RecordingCascade:
    """The built-in controller, with every voltage it sets written down."""

    def __init__(self, scenario: Scenario) -> None:
        self._inside = Cascade(scenario)
        self.period = self._inside.period
        self.voltages: list[np.ndarray] = []

    def start(self, measurement: Measurement) -> Any:
        """As the built-in controller."""
        return self._inside.start(measurement)

    def update(self, t: float, measurement: Measurement, state: Any) -> tuple[Command, Any]:
        """As the built-in controller."""
        command, state = self._inside.update(t, measurement, state)
        if command.voltage is not None:
            self.voltages.append(command.voltage)
        return command, state


def try_gains(scenario: Scenario, *, progress: Callable[[float], None] | None = None) -> DesignTrial:
    """Simulate a scenario and read from it what a design is judged by; a run that diverges is a result too."""
    listener = RecordingCascade(scenario)
    run = simulate(scenario, listener, progress=progress)
    late = run["time"].values >= LATE * scenario.duration
    middle = np.abs(run["displacement"].interp(sigma=0.5).values[late])
    metrics = run.metrics
    return DesignTrial(
        run=run,
        late_mid_peak=float(middle.max(initial=0.0)) if run.status is Status.COMPLETED else np.nan,
        tip_peak=metrics["tip_peak"],
        voltage_peak=metrics["motor_voltage_peak"],
        speed_peak=metrics["motor_speed_peak"],
        chatter=chatter(listener, scenario) if run.status is Status.COMPLETED else np.nan,
    )


def chatter(listener: RecordingCascade, scenario: Scenario) -> float:
    """Largest RMS of a voltage above 10 Hz in the last third of the run, V; 0 without motors."""
    if not listener.voltages:
        return 0.0
    late = np.array(listener.voltages[round(LATE * scenario.duration / listener.period) :])
    return float(rms_above(late, listener.period, CHATTER).max())


def rms_above(samples: np.ndarray, period: float, frequency: float) -> np.ndarray:
    """RMS of each column above a frequency, Hz, under a Hann window, which keeps slow motion out of it.

    >>> t = np.arange(2000) * 1e-3
    >>> fast, slow = np.sin(2 * np.pi * 50 * t), 100 * np.sin(2 * np.pi * 1.3 * t)
    >>> rms_above(np.stack([fast, slow], axis=1), 1e-3, 10.0).round(2).tolist()
    [0.71, 0.0]
    """
    window = np.hanning(len(samples))
    spectrum = np.fft.rfft((samples - samples.mean(axis=0)) * window[:, None], axis=0)
    power = np.abs(spectrum[np.fft.rfftfreq(len(samples), period) >= frequency]) ** 2
    return np.sqrt(2.0 * power.sum(axis=0) / len(samples) / (window**2).sum())
