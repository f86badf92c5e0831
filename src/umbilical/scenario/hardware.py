"""Cable, ROV and motors: what is built."""

from __future__ import annotations

from umbilical.scenario.base import Record, quantity
from umbilical.scenario.signals import Signal, signal_field
from umbilical.scenario.water import BodyInWater, CableInWater


class Cable(Record):
    """The umbilical: a string of line density rho under the tension of what hangs below each point."""

    line_density: float = quantity(
        "line_density", ge=1e-6, le=1e4, reason="waves travel at sqrt(T/rho)", fix="kg per metre, in air"
    )
    damping: float = quantity("cable_damping", ge=0.0, reason="negative damping feeds the cable", fix="use 0 or more")
    wet_line_density: float | None = quantity(
        "wet_line_density", None, ge=-1e4, le=1e4, reason="what water leaves of the weight, which no more than floats",
        fix="kg per metre, its weight in water over g: negative floats up, left out it weighs as in air",
    )  # fmt: skip
    axial_stiffness: float | None = quantity(
        "axial_stiffness", None, gt=0.0, reason="the cable is elastic",
        fix="newton, from the maker; on the string it counts where heave enters the tension, and the rope assumes ten "
        "thousand times the static tension at the vessel where it is left out",
    )  # fmt: skip
    water: CableInWater | None = None


class Payload(Record):
    """The ROV, a point mass at the cable's lower end."""

    mass: float = quantity("payload_mass", gt=0.0, le=1e9, reason="the ROV resists acceleration with it")
    wet_weight: float | None = quantity(
        "wet_weight", None, gt=0.0, fix="newton, not kg; left out it weighs m g as in air",
        reason="under a ROV that floats the cable is slack, which is no string; the full model, model = \"rope\", may "
        "go slack but starts from a cable that hangs",
    )  # fmt: skip
    damping: float = quantity("payload_damping", ge=0.0, reason="negative damping feeds the ROV", fix="use 0 or more")
    water: BodyInWater | None = None


class Motor(Record):
    """One thruster: an electric motor with its propeller, eq. (15)."""

    inertia: float = quantity("inertia", gt=0.0, reason="it divides the torque", fix="kg m2, rotor and propeller")
    viscous_friction: float = quantity("viscous_friction", ge=0.0, reason="friction takes energy", fix="0 or more")
    torque_constant: float = quantity("torque_constant", gt=0.0, reason="the current must turn the shaft")
    load_coefficient: float = quantity("load_coefficient", ge=0.0, reason="the propeller brakes", fix="0 or more")
    resistance: float = quantity("resistance", gt=0.0, reason="it limits the current of a stalled motor")
    inductance: float = quantity("inductance", gt=0.0, reason="it divides the voltage", fix="henry, above 0")
    back_emf_constant: float = quantity("back_emf_constant", ge=0.0, reason="the EMF opposes the drive")
    thrust_coefficient: float = quantity("thrust_coefficient", reason="either sign, not 0")
    voltage_limit: float | None = quantity(
        "voltage_limit", None, gt=0.0, reason="the drive is clipped at plus and minus it", fix="leave out for none"
    )
    torque_disturbance: Signal = signal_field("N m", "torque from outside d1(t)")
    voltage_disturbance: Signal = signal_field("V", "voltage beside the drive's d2(t)")
