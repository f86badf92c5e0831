"""The whole loop in samples without a grid: controller, held voltages, motors, and the exact cable.

Between the samples the thrust acts continuously, and the samples of what it does are a sum over aliases
``p + j 2 pi k/H``, H the period of the outer law. Only the first term has the echo of the vessel in it; in
the others the cable has no end, because what a controller hears of its own aliases after a round trip is a
share of some 1e-6 of it. The loop is opened at the commanded thrust, L = ``thrust commanded / thrust injected``::

    L = num/den,  den = up1 + echo down1,  num = up2 + echo down2,   closed loop: den = num

which are linear in the echo: no resonance has to be resolved, however light its damping.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from umbilical.control.cascade import CascadeSettings, make_settings, make_state, with_known_factors
from umbilical.control.contract import Controller, Measurement
from umbilical.engine.linearise import Linear, delayed, hold_input
from umbilical.relations.formulas import motor_rates, soft_signed_root
from umbilical.scenario.scenario import Scenario
from umbilical.stability.impedance import FixedLengthCable, RovWaves, payload_stiffness, upward_asymptote, waves_at_rov
from umbilical.stability.laws import READINGS, linear_motor_law, linear_outer_law, shares
from umbilical.stability.updates import Rest, linearise_controller

ALIASES = 12
"""Aliases on either side; the rest of the sum is its asymptote."""

ON_THE_CIRCLE = 1e-9


@dataclass(frozen=True)
class Drive:
    """One motor near a steady speed, with its loop.

    Motors that behave alike differ in their thrust only and are one drive, their weights added.

    Attributes:
        law: from (demand, w, i) to the voltage, sample by sample, the age of the readings included.
        rates: ``x' = rates x + volts U`` of x = (w, i), shape (2, 2).
        volts: shape (2, 1).
        weight: demand per commanded thrust times thrust per speed, 2 K_T |w0|, rad/s.
        share: size of the demand on one motor per commanded thrust, rad2/(N s2).
    """

    law: Linear
    rates: np.ndarray
    volts: np.ndarray
    weight: float
    share: float

    def closed(self, period: float) -> Linear:
        """From (demand, errors of w and of i) to (voltage, w), the loop closed; states are the law's, then w and i."""
        a, b = hold_input(self.rates, self.volts, period)
        k, seen, n = self.law, slice(1, 3), self.law.a.shape[0]
        upper = np.hstack([k.a, k.b[:, seen]])
        lower = np.hstack([b @ k.c, a + b @ k.d[:, seen]])
        entry = np.vstack([k.b, b @ k.d])
        voltage = np.hstack([k.c, k.d[:, seen]])
        speed = np.eye(n + 2)[[n]]
        return Linear(np.vstack([upper, lower]), entry, np.vstack([voltage, speed]), np.vstack([k.d, np.zeros(3)]))

    def behaves_like(self, other: Drive) -> bool:
        """Whether a demand turns both alike."""
        pairs = [(self.law.a, other.law.a), (self.law.b, other.law.b), (self.rates, other.rates)]
        return all(np.array_equal(*pair) for pair in [*pairs, (self.volts, other.volts)])


@dataclass(frozen=True)
class SampledLoop:
    """Everything but the cable.

    Attributes:
        period: of sensors and voltages, s.
        every: periods between two updates of the outer law.
        law: from the four readings at the ROV to the commanded thrust, once per outer update.
        ages: how late each of the four readings comes, s.
        drives: the motors; none where the thruster is ideal.
        operating_thrust: steady thrust at which the motors are linearised, N.
    """

    period: float
    every: int
    law: Linear
    ages: tuple[float, ...]
    drives: tuple[Drive, ...]
    operating_thrust: float

    @property
    def outer_period(self) -> float:
        """Period of the outer law, s."""
        return self.period * self.every

    @cached_property
    def own_poles(self) -> int:
        """Unstable poles of the controller and of the motor loops by themselves.

        Those as close to the unit circle as :data:`ON_THE_CIRCLE` are on it: D^ becomes an integrator.
        """
        parts = [self.law, *(drive.closed(self.period) for drive in self.drives)]
        return sum(int((np.abs(part.poles()) > 1.0 + ON_THE_CIRCLE).sum()) for part in parts)


def sampled_loop(
    scenario: Scenario, operating_thrust: float, controller: Controller | None = None, length: float = 0.0
) -> SampledLoop:
    """The linearised loop of a controller and the motors.

    Args:
        scenario: its motors, sensors and, unless another is given, controller are used.
        operating_thrust: steady thrust, N; at 0 a propeller has no thrust to first order.
        controller: decides in place of the scenario's own, which still shares and drives.
        length: what that controller reads of the winch, m.

    Raises:
        Doubt: the controller has no linear system that speaks for it.
    """
    settings, period = make_settings(scenario), scenario.control.period
    if controller is None:
        law, every = linear_outer_law(settings.outer), settings.outer_every
    else:
        settings = with_known_factors(settings)
        law = linearise_controller(controller, _at_rest(scenario, settings, operating_thrust, length))
        every = round(controller.period / period)
    ages = tuple(round(getattr(scenario.sensors, name).latency / period) * period for name in READINGS)
    drives = _drives(scenario, settings, operating_thrust, 0.0)
    return SampledLoop(period, every, law, ages, drives, operating_thrust)


def _at_rest(scenario: Scenario, settings: CascadeSettings, thrust: float, length: float) -> Rest:
    """What a controller reads of an ROV at rest below the vessel, the motors delivering a steady thrust, N."""
    speeds = [
        np.sign(share) * soft_signed_root(abs(share * thrust), settings.motors.command_filter.width)
        for share in shares(settings.motors, np.ones(1))[: len(scenario.motors)]
    ]
    brakes = [m.viscous_friction + m.load_coefficient * abs(w) for m, w in zip(scenario.motors, speeds, strict=True)]
    currents = [b * w / m.torque_constant for b, w, m in zip(brakes, speeds, scenario.motors, strict=True)]
    rate = 0.0 if scenario.sensors.ideal_velocity else None
    seen = Measurement(0.0, 0.0, np.array(speeds), np.array(currents), length, 0.0, 0.0, rate, rate)
    return Rest(seen, scenario.duration)


def drives_at(scenario: Scenario, thrust: float, spread: float = 0.0) -> tuple[Drive, ...]:
    """The motors at a steady thrust, N, about which the commanded thrust varies with a standard deviation, N.

    The varying demand is seen through the mean slope of its root; none where the thruster is ideal.
    """
    return _drives(scenario, make_settings(scenario), thrust, spread)


def _drives(scenario: Scenario, settings: CascadeSettings, thrust: float, spread: float) -> tuple[Drive, ...]:
    drives: list[Drive] = []
    if not settings.motors.driven:
        return ()
    for number, share in enumerate(shares(settings.motors, make_state(scenario).kappa)):
        new = _drive(scenario, settings, number, float(share), thrust, spread)
        alike = [k for k, old in enumerate(drives) if old.behaves_like(new)]
        if alike:
            drives[alike[0]] = replace(new, weight=drives[alike[0]].weight + new.weight)
        else:
            drives.append(new)
    return tuple(drives)


def _drive(
    scenario: Scenario, settings: CascadeSettings, number: int, share: float, thrust: float, spread: float
) -> Drive:
    motors, motor = settings.motors, scenario.motors[number]
    period, sensors = scenario.control.period, scenario.sensors
    ages = (0, round(sensors.motor_speed.latency / period), round(sensors.motor_current.latency / period))
    demand = share * thrust + np.sign(share) * make_state(scenario).kappa[1:].sum()
    varying = abs(share) * spread
    speed = float(soft_signed_root(np.hypot(demand, varying), motors.command_filter.width))
    law = delayed(linear_motor_law(motors, number, speed, abs(demand), varying), ages)
    rates, volts = motor_rates(motor, speed)
    return Drive(law, rates, volts, share * 2.0 * motor.thrust_coefficient * speed, abs(share))


class LoopResponse(NamedTuple):
    """The opened loop at complex frequencies p, arrays of one shape; see the head of this module.

    Attributes:
        p: 1/s.
        echo: of the vessel, as in :class:`~umbilical.stability.impedance.RovWaves`.
        up1, down1, up2, down2: the coefficients of den and num, N/m.
        force: thrust delivered per thrust commanded, alias 0 and its hold included.
    """

    p: np.ndarray
    echo: np.ndarray
    up1: np.ndarray
    down1: np.ndarray
    up2: np.ndarray
    down2: np.ndarray
    force: np.ndarray

    @property
    def loop(self) -> np.ndarray:
        """L, thrust commanded per thrust injected."""
        return (self.up2 + self.echo * self.down2) / (self.up1 + self.echo * self.down1)

    def reflection(self, gain: complex | np.ndarray = 1.0) -> np.ndarray:
        """What the controlled ROV sends up per displacement that comes down; ``gain`` scales the thrust."""
        return -(self.down1 - gain * self.down2) / (self.up1 - gain * self.up2)

    def compliance(self) -> np.ndarray:
        """Size of the ROV's displacement per force on it, m/N, echoes left out."""
        return np.abs(1.0 / (self.up1 - self.up2))


def loop_response(
    cable: FixedLengthCable, loop: SampledLoop, p: np.ndarray, met: RovWaves | None = None, aliases: int = ALIASES
) -> LoopResponse:
    """The opened loop at complex frequencies p.

    Args:
        cable, loop: what is in it.
        p: 1/s, of positive imaginary part up to pi/H.
        met: the waves at p, where they are known already.
        aliases: how many to add on either side.
    """
    p = np.asarray(p, dtype=complex)
    z = np.exp(p * loop.outer_period)
    gains = loop.law.response(z)[:, 0, :]
    w = met or waves_at_rov(cable, p)
    stiffness = payload_stiffness(cable, p)
    force = delivered(loop, p, demands_to_volts(loop, p))
    up1, down1 = stiffness - w.up, stiffness - w.down
    seen_up = _readings(np.ones_like(p), -w.up / cable.tip_tension, p, loop.ages)
    seen_down = _readings(np.ones_like(p), -w.down / cable.tip_tension, p, loop.ages)
    others = (gains * alias_sum(cable, loop, p, aliases)).sum(axis=1)
    up2 = others * up1 + force * (gains * seen_up).sum(axis=1)
    down2 = others * down1 + force * (gains * seen_down).sum(axis=1)
    return LoopResponse(p, w.echo, up1, down1, up2, down2, force)


def alias_sum(cable: FixedLengthCable, loop: SampledLoop, p: np.ndarray, aliases: int = ALIASES) -> np.ndarray:
    """Readings per commanded thrust that the aliases other than p add, shape (len(p), 4): cable without an end."""
    from scipy.special import polygamma

    turn = 2j * np.pi / loop.outer_period
    commands = [demands_to_volts(loop, p + r * turn) for r in range(loop.every)]  # these repeat
    total = np.zeros((p.size, len(READINGS)), dtype=complex)
    for k in [k for number in range(1, aliases + 1) for k in (number, -number)]:
        q = p + k * turn
        up = upward_asymptote(cable, q) if k > 0 else np.conj(upward_asymptote(cable, np.conj(q)))
        wave = delivered(loop, q, commands[k % loop.every]) / (payload_stiffness(cable, q) - up)
        total += _readings(wave, -up * wave / cable.tip_tension, q, loop.ages)
    if not loop.drives:
        # What is left falls as 1/q^2 for slope and velocity: the sum of 1/k^2 beyond them, twice.
        rest = (1.0 - np.exp(-p * loop.outer_period)) / loop.outer_period * 2.0 * polygamma(1, aliases + 1) / turn**2
        per_force = np.array([0.0, cable.tip_impedance / cable.tip_tension, 1.0, 0.0]) / cable.payload_mass
        total += rest[:, None] * per_force * np.exp(-p[:, None] * np.array(loop.ages))
    return total


def _readings(y: np.ndarray, slope: np.ndarray, p: np.ndarray, ages: tuple[float, ...]) -> np.ndarray:
    """The four readings of a displacement and a slope at p, each at its age, shape (len(p), 4)."""
    return np.stack([y, slope, p * y, p * slope], axis=1) * np.exp(-p[:, None] * np.array(ages))


def demands_to_volts(loop: SampledLoop, p: np.ndarray) -> list[np.ndarray]:
    """Volts per demand of every drive at p, sample by sample: the same at every alias of the period."""
    z = np.exp(p * loop.period)
    return [drive.closed(loop.period).response(z)[:, 0, 0] for drive in loop.drives]


def delivered(loop: SampledLoop, p: np.ndarray, volts: list[np.ndarray]) -> np.ndarray:
    """Spectrum of the thrust at p per sample of the commanded thrust, over H: hold, motor loops, motors."""
    z = np.exp(p * loop.period)
    repeat = sum(z**-k for k in range(loop.every))
    hold = repeat * (1.0 - 1.0 / z) / (p * loop.outer_period)
    if not loop.drives:
        return hold
    return hold * sum(v * _thrust_per_volt(drive, p) for v, drive in zip(volts, loop.drives, strict=True))


def _thrust_per_volt(drive: Drive, p: np.ndarray) -> np.ndarray:
    (a, b), (c, d) = drive.rates
    return drive.weight * b * drive.volts[1, 0] / ((p - a) * (p - d) - b * c)
