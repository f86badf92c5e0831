"""What acts from outside: gravity, loads on ROV and cable, the vessel, and the shape at the start."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from umbilical.scenario.base import Number, Record, quantity
from umbilical.scenario.sea import SeaState
from umbilical.scenario.signals import Signal, signal_field
from umbilical.scenario.source import FromFile, from_file
from umbilical.scenario.water import Water


class UniformProfile(Record):
    """The same load on every metre of cable."""

    shape: Literal["uniform"]


class SineProfile(Record):
    """``sin(half_waves * pi * sigma)``."""

    shape: Literal["sine"]
    half_waves: int = Field(default=1, ge=1, le=50, description="half waves between vessel and ROV")


class GaussianProfile(Record):
    """``exp(-((sigma - center)/width)^2)``."""

    shape: Literal["gaussian"]
    center: float = quantity("profile_center", ge=0.0, le=1.0, reason="sigma = x/l", fix="0 is the vessel, 1 the ROV")
    width: float = quantity("profile_width", gt=0.0, le=10.0, reason="it divides sigma", fix="a share of the length")


class TableProfile(Record):
    """Linear between values given at positions sigma = x/l."""

    shape: Literal["table"]
    positions: tuple[Number, ...] = Field(min_length=2, description="increasing sigma, from 0 to 1")
    values: tuple[Number, ...] = Field(min_length=2, description="share of the signal at each position")
    file: FromFile | None = from_file("positions", "values", "1", "1")


Profile = Annotated[UniformProfile | SineProfile | GaussianProfile | TableProfile, Field(discriminator="shape")]


class CableLoad(Record):
    """A load along the cable: a profile over sigma = x/l times a signal of time, N/m."""

    profile: Profile
    signal: Signal = signal_field("N/m", "how much of the profile acts, over time", ...)


class Environment(Record):
    """Gravity, loads and the vessel."""

    gravity: float = quantity("gravity", gt=0.0, le=100.0, reason="the cable hangs", fix="9.81 m/s2 on earth")
    payload_force: Signal = signal_field("N", "external force on the ROV d(t)")
    cable_load: tuple[CableLoad, ...] = Field(default=(), description="loads along the cable f(x,t), N/m")
    vessel_motion: Signal = signal_field("m", "transverse motion of the vessel e(t)")
    sea: SeaState | None = Field(default=None, description="waves that move the vessel besides")
    vessel_ramp: float = quantity(
        "vessel_ramp", 0.0, ge=0.0, reason="the vessel's motion is faded in over it",
        fix="0 for none, else a few seconds",
    )  # fmt: skip
    vessel_heave: Signal | None = signal_field("m", "heave of the sheave, up, faded in likewise", None)
    water: Water | None = None


class Straight(Record):
    """Straight and at rest."""

    shape: Literal["straight"]


class SineShape(Record):
    """``amplitude * sin(half_waves * pi * x / l)``, at rest."""

    shape: Literal["sine"]
    amplitude: float = quantity("shape_amplitude")
    half_waves: float = quantity(
        "shape_half_waves", 1.0, gt=0.0, le=100.0, reason="half waves along the cable", fix="1, 1.5, 2 ..."
    )


class GaussianShape(Record):
    """``amplitude * exp(-((s - distance)/width)^2)`` with s the distance from the ROV, at rest."""

    shape: Literal["gaussian"]
    amplitude: float = quantity("shape_amplitude")
    distance: float = quantity(
        "shape_distance", ge=0.0, le=2e4, reason="metres up from the ROV", fix="between 0 and the length"
    )
    width: float = quantity("shape_width", gt=0.0, le=2e4, reason="it divides the distance")


class StaticShape(Record):
    """Static deflection under a steady force on the ROV, released at t = 0."""

    shape: Literal["static"]
    force: float = quantity("static_force")


class EquilibriumShape(Record):
    """At rest under the current and the loads as they are at t = 0; the ROV free, or held where ``tip`` says."""

    shape: Literal["equilibrium"]
    tip: float | None = quantity("equilibrium_tip", None)


class TableShape(Record):
    """Displacements at positions sigma = x/l, joined by a cubic spline, at rest."""

    shape: Literal["table"]
    positions: tuple[Number, ...] = Field(min_length=4, description="increasing sigma, from 0 to 1")
    displacements: tuple[Number, ...] = Field(min_length=4, description="displacement at each position, m")
    file: FromFile | None = from_file("positions", "displacements", "1", "m")


InitialShape = Annotated[
    Straight | SineShape | GaussianShape | StaticShape | EquilibriumShape | TableShape, Field(discriminator="shape")
]
