"""What the controller gets to see, and how badly."""

from __future__ import annotations

from pydantic import Field

from umbilical.scenario.base import Record, quantity


class Channel(Record):
    """Errors of one sensor, applied in this order: latency, bias, noise, resolution, drop-out."""

    noise: float = quantity("sensor_noise", 0.0, ge=0.0, reason="a standard deviation", fix="0 for none")
    bias: float = quantity("sensor_bias", 0.0)
    resolution: float = quantity("sensor_resolution", 0.0, ge=0.0, reason="a step", fix="0 for none")
    latency: float = quantity("sensor_latency", 0.0, ge=0.0, le=10.0, reason="a reading cannot come early")
    dropout: float = quantity("sensor_dropout", 0.0, ge=0.0, lt=1.0, reason="a probability", fix="below 1")


class Sensors(Record):
    """One channel per measured signal; the last two exist only where ``ideal_velocity`` grants them."""

    ideal_velocity: bool = Field(default=False, description="grant a sensor of Dy/Dt(l,t) and of D(y_x)/Dt(l,t)")
    tip_displacement: Channel = Channel()
    tip_slope: Channel = Channel()
    motor_speed: Channel = Channel()
    motor_current: Channel = Channel()
    tip_velocity: Channel = Channel()
    tip_slope_rate: Channel = Channel()
