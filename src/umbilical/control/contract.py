"""What a controller sees and what it says: the only meeting point of plant and control.

A user's controller is an ordinary Python class::

    class Still:
        period = 1e-3

        def start(self, measurement):
            return None

        def update(self, t, measurement, state):
            return Command(thrust=0.0), state
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from umbilical.frames import Frame, numbers, real


@dataclass(frozen=True, slots=True)
class Across:
    """What the sensors at the ROV read of the horizontal direction y of a rope; as in :class:`Measurement`."""

    tip_displacement: float
    tip_slope: float
    tip_velocity: float | None = None
    tip_slope_rate: float | None = None


@dataclass(frozen=True, slots=True)
class Measurement:
    """One sample of the sensors, as the controller gets it.

    Attributes:
        tip_displacement: y(l,t), m.
        tip_slope: y_x(l,t).
        motor_speed: speeds, rad/s, shape (motors,).
        motor_current: currents, A, shape (motors,).
        length: cable paid out, m.
        payout_speed: winch speed, m/s.
        payout_acceleration: winch acceleration, m/s2.
        tip_velocity: Dy/Dt(l,t), m/s; None unless the scenario grants ``sensors.ideal_velocity``.
        tip_slope_rate: D(y_x)/Dt(l,t), 1/s; None likewise.
        tip_tension: N(l), N, of the rope; 0 on the string, whose tension follows from weights.
        across: of the rope, what the sensors of the direction y read at the ROV: displacement, slope and, where
            granted, their rates.

    >>> import umbilical
    >>> measurement = umbilical.Episode(umbilical.load("paper")).measurement
    >>> float(measurement.length), measurement.motor_speed.shape
    (450.0, (2,))
    """

    tip_displacement: float
    tip_slope: float
    motor_speed: np.ndarray
    motor_current: np.ndarray
    length: float
    payout_speed: float
    payout_acceleration: float
    tip_velocity: float | None = None
    tip_slope_rate: float | None = None
    tip_tension: float = 0.0
    across: Across | None = None


@dataclass(frozen=True, slots=True)
class Command:
    """What a controller wants until its next update: give ``thrust`` or ``voltage``.

    Attributes:
        thrust: commanded thrust, N. Alone, it goes through the scenario's allocation and motor loops.
        voltage: motor voltages, V, shape (motors,). Alone or with ``thrust``, they go to the drives as they are.
        thrust_across: commanded thrust in the direction y of a rope, N.
        log: numbers of the controller's own to keep in the run, as the channels ``controller_NAME``.

    >>> from umbilical import Command
    >>> Command(thrust=-20.0, log={"velocity": 0.1}).thrust
    -20.0
    """

    thrust: float | None = None
    voltage: np.ndarray | None = None
    log: Mapping[str, float] | None = None
    thrust_across: float = 0.0


@runtime_checkable
class Controller(Protocol):
    """Anything with a period and these two methods can close the loop.

    ``state`` is whatever the controller wants to remember; the engine hands it back and never looks inside.

    >>> import umbilical
    >>> class Spring:
    ...     period = 0.01  # s
    ...     def start(self, measurement):
    ...         return None
    ...     def update(self, t, measurement, state):
    ...         return umbilical.Command(thrust=-500.0 * measurement.tip_displacement), state
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}), Spring())
    >>> run.status.name
    'COMPLETED'
    """

    period: float

    def start(self, measurement: Measurement) -> Any:
        """State before the first update, from the first measurement."""
        ...

    def update(self, t: float, measurement: Measurement, state: Any) -> tuple[Command, Any]:
        """Command from time ``t`` on, and the new state; called once per period."""
        ...


class TipReadings(Frame):
    """One sample of the sensors at the ROV."""

    tip_displacement = real()
    tip_slope = real()
    tip_velocity = real()
    tip_slope_rate = real()


class WinchReadings(Frame):
    """One sample of the winch and of the load pin at a rope's end, which are known exactly."""

    length = real()
    payout_speed = real()
    payout_acceleration = real()
    tip_tension = real()


class MotorReadings(Frame):
    """One sample of the sensors in a motor."""

    motor_speed = real()
    motor_current = real()


class Readings(NamedTuple):
    """One sample of all sensors, for kernels: a record each for ROV and winch, one record per motor."""

    tip: TipReadings
    winch: WinchReadings
    motors: MotorReadings


class OuterDecision(Frame):
    """What the outer law decided and estimated."""

    thrust_command = real()
    boundary_error = real()
    tip_velocity_estimate = real()
    tip_slope_rate_estimate = real()
    disturbance_estimate = real()


class MotorDecision(Frame):
    """What the loop of one motor decided and estimated."""

    motor_voltage = real()
    demand = real()
    speed_reference = real()
    motor_disturbance_estimate = real()


class Decision(NamedTuple):
    """What the built-in controller decided and estimated, for kernels and for the record; one record per motor."""

    outer: OuterDecision
    motors: MotorDecision


def make_readings(motors: int) -> Readings:
    """Readings of zero."""
    return Readings(TipReadings.many(1), WinchReadings.many(1), MotorReadings.many(motors))


def make_decision(motors: int) -> Decision:
    """The decision to do nothing."""
    return Decision(OuterDecision.many(1), MotorDecision.many(motors))


def to_measurement(readings: Readings, ideal_velocity: bool) -> Measurement:
    """The sample as a user's controller sees it; arrays are copies."""
    displacement, slope, velocity, slope_rate = numbers(readings.tip)
    length, speed, acceleration, pull = numbers(readings.winch)
    motors = readings.motors
    w, i = motors["motor_speed"].copy(), motors["motor_current"].copy()
    if not ideal_velocity:
        velocity, slope_rate = None, None
    return Measurement(displacement, slope, w, i, length, speed, acceleration, velocity, slope_rate, pull)
