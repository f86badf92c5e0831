"""What an operation consists of: a vessel, a cable, a body, a sea. Records, frozen and checked."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from umbilical.scenario.base import Record, fingerprint, measured
from umbilical.scenario.ship import Ship


class OperationCable(Record):
    """The umbilical in line with its tension."""

    line_density: float = measured(
        "kg/m", "dry line density, flooded water included", gt=0.0, le=1e3, reason="it carries axial waves"
    )
    wet_line_density: float = measured(
        "kg/m", "line density less the displaced water", gt=0.0, le=1e3,
        reason="its weight holds the cable taut; one that floats needs the full model", fix="weight in water over g",
    )  # fmt: skip
    axial_stiffness: float = measured(
        "N", "EA, force over strain", gt=0.0, reason="the cable is elastic", fix="from the maker's data sheet"
    )
    loss_factor: float = measured(
        "1", "loss factor of the material in stretch", 0.0, ge=0.0, le=1.0, reason="friction takes energy",
        fix="0 is cautious; a per cent or two for steel armour",
    )  # fmt: skip
    tangential_drag: float = measured(
        "N s2/m3", "drag along the cable per metre over the square of the speed", 0.0, ge=0.0, le=1e3,
        reason="drag brakes", fix="1/2 rho_w pi d C_dt, C_dt about 0.01; 0 is cautious",
    )  # fmt: skip


class HangingBody(Record):
    """What hangs at the end: a TMS with its ROV, a cage or a clump."""

    mass: float = measured("kg", "dry mass", gt=0.0, le=1e7, reason="it has inertia")
    added_mass: float = measured("kg", "added mass in heave", ge=0.0, le=1e7, reason="water moves with it")
    wet_weight: float = measured(
        "N", "weight in water", gt=0.0, le=1e8, reason="a body that floats does not pull the cable taut",
        fix="newton, not kilogram: mass in water times g",
    )  # fmt: skip
    quadratic_drag: float = measured(
        "N s2/m2", "drag in heave over the square of the speed", ge=0.0, le=1e7, reason="drag brakes",
        fix="1/2 rho_w C_d times the projected area",
    )  # fmt: skip


class HeaveCompensation(Record):
    """A winch that follows the measured heave: residual |1 - k e^(-i w tau) H(w)|, H of second order."""

    gain: float = measured("1", "share of the heave it follows", 1.0, ge=0.0, le=1.0, reason="a share", fix="0 to 1")
    lag: float = measured("s", "delay of measurement and drive", ge=0.0, le=5.0, reason="a delay")
    bandwidth: float = measured("rad/s", "natural frequency of the drive", gt=0.0, le=1e3, reason="a drive")
    damping: float = measured("1", "damping ratio of the drive", 0.7, gt=0.0, le=10.0, reason="a drive", fix="0.7")


class SeaShape(Record):
    """What is said of the sea beside its height and its period."""

    peakedness: float = measured(
        "1", "gamma of JONSWAP, 1 for Pierson-Moskowitz", 3.3, ge=1.0, le=7.0, reason="1 to 7 are seas", fix="1 to 7"
    )


class OperationWater(Record):
    """Gravity; the body's drag and weight are given as they are in this water."""

    gravity: float = measured("m/s2", "gravitational acceleration", 9.81, gt=0.0, le=100.0, reason="weight", fix="9.81")


class Operation(Record):
    """Everything that screening needs, frozen.

    >>> from umbilical.screening.load import load_operation
    >>> load_operation("work-class").payload.wet_weight
    35000.0
    """

    schema_version: Literal[1] = Field(default=1, description="version of this format")
    kind: Literal["operation"] = Field(description="what this file is")
    name: str = Field(min_length=1, max_length=60, description="short name")
    description: str = Field(default="", description="what is lowered from what")
    cable: OperationCable
    payload: HangingBody
    vessel: Ship
    sea: SeaShape = SeaShape()
    compensation: HeaveCompensation | None = None
    environment: OperationWater = OperationWater()
    assumed: dict[str, str] = Field(default_factory=dict, description="what no source gives, each with the reason")

    @property
    def hash(self) -> str:
        """SHA-256 of the canonical text; equal exactly when operations are."""
        return fingerprint(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return self.model_dump(mode="json", exclude_none=True)
