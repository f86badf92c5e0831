"""The controller: an outer law that wants a thrust, an allocation to the motors, a loop in each motor."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from umbilical.scenario.base import Number, Record, described, quantity
from umbilical.scenario.hardware import Motor

_POSITIVE = {"gt": 0.0, "reason": "a gain of the wrong sign drives the loop apart", "fix": "give a positive gain"}
_NOT_NEGATIVE = {"ge": 0.0, "reason": "a gain of the wrong sign drives the loop apart", "fix": "0 or more"}


class Law(Record):
    """What everyone may ask of an outer law, whichever it is.

    Attributes:
        closes_loop: whether it commands a thrust at all.
        meets_force: whether it works against the force on the ROV that the disturbance observer estimates.
        rates_key: its key that says where rates come from.
    """

    closes_loop: ClassVar[bool] = True
    meets_force: ClassVar[bool] = False
    rates_key: ClassVar[str] = "rates"

    @property
    def observers(self) -> tuple[str, ...]:
        """The observers of :class:`Control` that it reads."""
        return ()

    @property
    def reads_rates(self) -> bool:
        """Whether it reads rates from an ideal sensor."""
        return False

    @property
    def spring(self) -> float:
        """Thrust per displacement of the ROV held for good, N/m."""
        return 0.0

    @property
    def boundary_gains(self) -> tuple[float, float] | None:
        """k_a, N s/m, and beta, m/s, of a law that makes ``u_a = Dy/Dt + beta y_x`` vanish at the ROV."""
        return None


class NoControl(Law):
    """No thrust is ever commanded."""

    closes_loop: ClassVar[bool] = False
    kind: Literal["none"]


class ProportionalDerivative(Law):
    """The paper's baseline, eq. (66): ``alpha_c = -k_p y(l,t) - k_d Dy/Dt(l,t)``."""

    rates_key: ClassVar[str] = "velocity"
    kind: Literal["pd"]
    position_gain: float = quantity("position_gain", **_NOT_NEGATIVE)
    velocity_gain: float = quantity("velocity_gain", **_NOT_NEGATIVE)
    velocity: Literal["sensor", "observer"] = Field(
        default="observer", description="where the velocity comes from; 'sensor' needs sensors.ideal_velocity"
    )

    @property
    def observers(self) -> tuple[str, ...]:
        return ("velocity_observer",) if self.velocity == "observer" else ()

    @property
    def reads_rates(self) -> bool:
        return self.velocity == "sensor"

    @property
    def spring(self) -> float:
        return self.position_gain


class BoundaryLaw(Law):
    """The paper's output-feedback boundary law, eq. (22); with a ``station_gain`` it also holds a place in a current.

    Then ``u_a = x2^ + beta (z1 - z_w) + kappa (y - y_r)``, and z_w follows z1 in ``washout_time``. Alone the law rests
    wherever the cable hangs straight at the ROV.
    """

    meets_force: ClassVar[bool] = True
    kind: Literal["boundary"]
    damping_gain: float = quantity("damping_gain", **_POSITIVE)
    slope_gain: float = quantity("slope_gain", **_NOT_NEGATIVE)
    station_gain: float | None = quantity("station_gain", None, **_NOT_NEGATIVE)
    station: float | None = quantity("station", None)
    washout_time: float | None = quantity(
        "washout_time", None, gt=0.0, le=1e6, reason="slower than the first mode", fix="seconds, e.g. 120"
    )
    drag_feedforward: bool | None = Field(
        default=None, description="meet the drag of the ROV's own motion before the observer knows of it"
    )
    rates: Literal["sensor", "observer"] = Field(
        default="observer", description="where x2 and z2 come from; 'sensor' needs sensors.ideal_velocity"
    )

    @property
    def observers(self) -> tuple[str, ...]:
        return ("velocity_observer", "slope_observer") if self.rates == "observer" else ()

    @property
    def reads_rates(self) -> bool:
        return self.rates == "sensor"

    @property
    def boundary_gains(self) -> tuple[float, float]:
        return self.damping_gain, self.slope_gain


OuterLaw = Annotated[NoControl | ProportionalDerivative | BoundaryLaw, Field(discriminator="kind")]


class HighGainObserver(Record):
    """Eq. (17) or (19): differentiates one measured signal."""

    time_constant: float = quantity(
        "observer_time", gt=0.0, le=100.0, reason="the observer differentiates over it", fix="seconds, e.g. 0.005"
    )
    damping: float = quantity("observer_damping", gt=0.0, le=100.0, reason="it must decay", fix="2 is critical")


class DisturbanceObserver(Record):
    """Eq. (21): estimates the force on the ROV that the law does not know."""

    enabled: bool = Field(default=True, description="false: estimate nothing, D^ = 0")
    gain: float = quantity("disturbance_gain", gt=0.0, le=1e6, reason="it is a rate of decay", fix="e.g. 5 1/s")
    coupling: float = quantity("disturbance_coupling", gt=0.0, reason="it weighs u_a in V3", fix="1 is the preset")


class KnownFactors(Record):
    """Without fault control: every motor gets ``sgn(K_Ti) alpha_c / sum |K_Tj|``."""

    method: Literal["known"]


class AdaptiveAllocation(Record):
    """Fault control, eqs. (23) and (27), with an optional box that kappa is projected onto."""

    method: Literal["adaptive"]
    rates: tuple[Number, ...] = Field(min_length=2, **described("adaptation_rate"))
    leak: float = quantity("adaptation_leak", ge=0.0, reason="a negative leak grows", fix="e.g. 1e-3")
    initial: tuple[Number, ...] = Field(min_length=2, **described("kappa_initial"))
    lower: tuple[Number, ...] | None = Field(
        default=None, description="lower corner of the box kappa is projected onto"
    )
    upper: tuple[Number, ...] | None = Field(
        default=None, description="upper corner of the box kappa is projected onto"
    )


Allocation = Annotated[KnownFactors | AdaptiveAllocation, Field(discriminator="method")]


class MotorLoop(Record):
    """The multiplicative inverse controller of each motor, eqs. (52)-(64)."""

    speed_gain: float = quantity("speed_gain", **_POSITIVE)
    current_gain: float = quantity("current_gain", **_POSITIVE)
    robust_factor: float = quantity(
        "robust_factor", ge=1.0, le=100.0, reason="the proof needs more than 1", fix="e.g. 1.5"
    )
    speed_width: float = quantity("speed_width", gt=0.0, reason="it softens sgn(e1)", fix="e.g. 0.1 rad/s")
    current_width: float = quantity("current_width", gt=0.0, reason="it softens sgn(e2)", fix="e.g. 2 rad/s2")
    speed_bound: float = quantity("speed_bound", **_NOT_NEGATIVE)
    current_bound: float = quantity("current_bound", **_NOT_NEGATIVE)
    observer_gain: float = quantity("motor_observer_gain", gt=0.0, reason="a rate of decay", fix="e.g. 100 1/s")
    filter_frequency: float = quantity("filter_frequency", gt=0.0, reason="poles of the filter", fix="e.g. 200 rad/s")
    root_width: float = quantity("root_width", 1e-3, gt=0.0, reason="the root is singular at 0", fix="e.g. 1e-3")


class Nominal(Record):
    """What the controller believes where it differs from the truth; what is left out is the truth."""

    payload_mass: float | None = quantity("payload_mass", None, gt=0.0, le=1e9, reason="it divides")
    payload_wet_weight: float | None = quantity("wet_weight", None, gt=0.0, reason="as the truth")
    payload_damping: float | None = quantity("payload_damping", None, ge=0.0, reason="as the truth", fix="0 or more")
    gravity: float | None = quantity("gravity", None, gt=0.0, le=100.0, reason="as the truth")
    thrust_coefficients: tuple[Number, ...] | None = Field(
        default=None, description="believed K_T of each motor, N s2/rad2"
    )
    motors: tuple[Motor, ...] | None = Field(default=None, description="believed constants of each motor")


class Control(Record):
    """The whole controller. Sections a law does not use may be left out."""

    period: float = quantity(
        "control_period", gt=0.0, le=10.0, reason="one update per period", fix="seconds, e.g. 1e-3"
    )
    outer_period: float | None = quantity(
        "outer_period", None, gt=0.0, le=10.0, reason="period of the outer law", fix="a multiple of the period"
    )
    law: OuterLaw
    velocity_observer: HighGainObserver | None = None
    slope_observer: HighGainObserver | None = None
    disturbance_observer: DisturbanceObserver | None = None
    allocation: Allocation = KnownFactors(method="known")
    motor_loop: MotorLoop | None = None
    nominal: Nominal = Nominal()
