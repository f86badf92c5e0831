"""A sea that moves the vessel: wave systems, and the vessel that answers them."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from umbilical.scenario.base import Record, measured
from umbilical.scenario.ship import Ship


def _period(meaning: str) -> Any:
    return measured(
        "s", f"{meaning}; one of the three periods is given", None, ge=1.0, le=30.0, reason="wind sea and swell",
        fix="seconds",
    )  # fmt: skip


class WaveSystem(Record):
    """Wind sea or swell: a JONSWAP spectrum (Pierson-Moskowitz with a peakedness of 1) of one main direction."""

    significant_height: float = measured(
        "m", "Hs = 4 sqrt(m0)", ge=0.0, le=20.0, reason="a sea", fix="metres, not feet"
    )
    peak_period: float | None = _period("Tp")
    zero_crossing_period: float | None = _period("Tz")
    mean_period: float | None = _period("T1 = 2 pi m0/m1")
    peakedness: float = measured("1", "gamma", 3.3, ge=1.0, le=7.0, reason="1 to 7 are seas", fix="3.3 on average")
    heading: float = measured(
        "rad", "direction the waves go to from the bow's, towards port; 0 following, pi head sea", ge=-6.3, le=6.3,
        reason="an angle", fix="radians",
    )  # fmt: skip
    components: int = Field(default=100, ge=20, le=2000, description="waves of equal energy in each direction")
    spreading: float | None = measured(
        "1", "n of cos^n about the main direction; left out, all waves go there", None, ge=1.0, le=100.0,
        reason="2 is wide, 10 narrow", fix="2 to 10",
    )  # fmt: skip
    directions: int = Field(default=7, ge=3, le=37, description="directions of equal energy, where there is spreading")


class SeaState(Record):
    """Waves, and what they make of the sheave; faded in over ``vessel_ramp``."""

    systems: tuple[WaveSystem, ...] = Field(min_length=1, max_length=4, description="wind sea, swell")
    vessel: Ship
    plane: float = measured(
        "rad", "direction of the cable's plane from the bow's, towards port: 0 surge, pi/2 sway", 1.5707963267948966,
        ge=-6.3, le=6.3, reason="an angle", fix="radians",
    )  # fmt: skip
    amplitudes: Literal["deterministic", "random"] = Field(
        default="deterministic", description="amplitudes by the spectrum, or drawn as those of a Gaussian sea are"
    )
    heave: bool = Field(
        default=False,
        description="let heave into the tension of the string, stretched by cable.axial_stiffness; the rope has it",
    )
    orbital_below: float | None = measured(
        "m", "depth under the surface from which waves move the water; left out, they do not", None, ge=0.0, le=50.0,
        reason="above the keel and in a moonpool the ship shelters the cable", fix="the draught; 0 beside the ship",
    )  # fmt: skip
    seed: int = Field(default=0, ge=0, le=2**63 - 1, description="seed of the phases and random amplitudes")
