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

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np


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


@dataclass(frozen=True, slots=True)
class Command:
    """What a controller wants until its next update: give ``thrust`` or ``voltage``.

    Attributes:
        thrust: commanded thrust, N. Alone, it goes through the scenario's allocation and motor loops.
        voltage: motor voltages, V, shape (motors,). Alone or with ``thrust``, they go to the drives as they are.
    """

    thrust: float | None = None
    voltage: np.ndarray | None = None


@runtime_checkable
class Controller(Protocol):
    """Anything with a period and these two methods can close the loop.

    ``state`` is whatever the controller wants to remember; the engine hands it back and never looks inside.
    """

    period: float

    def start(self, measurement: Measurement) -> Any:
        """State before the first update, from the first measurement."""
        ...

    def update(self, t: float, measurement: Measurement, state: Any) -> tuple[Command, Any]:
        """Command from time ``t`` on, and the new state; called once per period."""
        ...


# Places of the scalar readings in Readings.boundary.
TIP_DISPLACEMENT, TIP_SLOPE, TIP_VELOCITY, TIP_SLOPE_RATE, LENGTH, PAYOUT_SPEED, PAYOUT_ACCELERATION = range(7)


MOTOR_SPEED, MOTOR_CURRENT = range(2)


class Readings(NamedTuple):
    """The same sample for kernels: ``boundary`` (7,) and ``motors``, speeds and currents, (2, n)."""

    boundary: np.ndarray
    motors: np.ndarray


# Places of the scalars in Decision.outer.
THRUST_COMMAND, BOUNDARY_ERROR, VELOCITY_ESTIMATE, SLOPE_RATE_ESTIMATE, DISTURBANCE_ESTIMATE = range(5)
# Rows of Decision.motors.
VOLTAGE, DEMAND, SPEED_REFERENCE, MOTOR_DISTURBANCE = range(4)


class Decision(NamedTuple):
    """What the built-in controller decided and estimated, for kernels and for the record.

    Attributes:
        outer: thrust command, u_a, estimates of x2, z2 and D, shape (5,).
        motors: voltages U, V; demands U_i, rad2/s2; filtered w_d, rad/s; estimated f23 d2, rad/s3: shape (4, n).
    """

    outer: np.ndarray
    motors: np.ndarray


def make_readings(motors: int) -> Readings:
    """Readings of zero."""
    return Readings(np.zeros(7), np.zeros((2, motors)))


def make_decision(motors: int) -> Decision:
    """The decision to do nothing."""
    return Decision(np.zeros(5), np.zeros((4, motors)))


def to_measurement(readings: Readings, ideal_velocity: bool) -> Measurement:
    """The sample as a user's controller sees it; arrays are copies."""
    b = readings.boundary
    return Measurement(
        tip_displacement=float(b[TIP_DISPLACEMENT]),
        tip_slope=float(b[TIP_SLOPE]),
        motor_speed=readings.motors[MOTOR_SPEED].copy(),
        motor_current=readings.motors[MOTOR_CURRENT].copy(),
        length=float(b[LENGTH]),
        payout_speed=float(b[PAYOUT_SPEED]),
        payout_acceleration=float(b[PAYOUT_ACCELERATION]),
        tip_velocity=float(b[TIP_VELOCITY]) if ideal_velocity else None,
        tip_slope_rate=float(b[TIP_SLOPE_RATE]) if ideal_velocity else None,
    )
