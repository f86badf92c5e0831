"""The motor alone under a given voltage, and laws and observers of the cascade.

Of the motor, eq. (15): steady state, step, reversal, poles, vanishing inductance. Of laws and observers one update each
at states of no meaning, and exact responses of their equations.

In a run that goes well the terms of the inner law that fight errors are small, and a wrong sign among them hardly
shows in any history. At random states every term counts.
"""

from __future__ import annotations

from collections.abc import Callable
from math import exp
from typing import Any

import numpy as np

from umbilical.control.motor import backstepping
from umbilical.control.motor import disturbance as of_motor
from umbilical.control.motor.command_filter import Reference
from umbilical.control.observers import disturbance as of_payload
from umbilical.control.observers import high_gain
from umbilical.control.outer import boundary
from umbilical.library import load
from umbilical.relations.formulas import motor_constants
from umbilical.scenario.control import DisturbanceObserver, HighGainObserver
from umbilical.scenario.hardware import Motor
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, close, same_history
from umbilical.verify.engine import constant
from umbilical.verify.references import observers as exact
from umbilical.verify.references import paper
from umbilical.verify.references.motor import driven_motor, linear_step, steady_state, without_inductance

MOTORS, CASES = Cases(), Cases()
STATES, PERIOD, EPS, GAIN, MOTOR_GAIN = 200, 1e-3, 0.005, 5.0, 100.0
AT_STATES = (1e-12, "round-off; a wrong sign of any term misses by 1e-6 at least")
DISCRETE = (1e-9, "the discrete form is exact: round-off; a gain off by two misses by 1")
FIRST_ORDER = "first order in the period of 1 ms; a gain off by two misses by 1"
EQUATIONS = "eqs. (22), (52)-(60), written a second time in numpy"
Array = np.ndarray
MOTOR = {
    "inertia": 0.5, "viscous_friction": 0.015, "torque_constant": 4.0, "load_coefficient": 1.0, "resistance": 0.08,
    "inductance": 0.002, "back_emf_constant": 0.5, "thrust_coefficient": 1.0,
}  # fmt: skip
VOLTAGE = 75.015
LIMIT = (1e-6, "asked for; a tenth more inertia misses by 1e-2")
INTEGRATED = "DOP853 at 1e-12"


def _drive(voltage: float, duration: float, *more: Any, step: float = 1e-3, **changes: float) -> np.ndarray:
    """Instants, speed and current of a motor whose drive gets a voltage, V, ``more`` terms, and nothing else."""
    signal = [constant(voltage), *more]
    run = engine.finished(load("paper", {
        "control.law": {"kind": "none"}, "control.period": step, "grid": {"elements": 4, "step": step},
        "environment.payload_force": [], "motors": [MOTOR | changes | {"voltage_disturbance": signal}],
        "duration": duration, "output.interval": step,
    }))  # fmt: skip
    return np.array([run["time"].values, run["motor_speed"].values[:, 0], run["motor_current"].values[:, 0]])


def _same_motor(found: Any, exact: Any, *limit: Any) -> Checks:
    for k, quantity in enumerate(("speed over 0.3 s, rad/s", "current over 0.3 s, A")):
        yield same_history(quantity, found[k], exact[k], *limit)


@MOTORS.add("motor, steady state", "sgn(G)(-b + sqrt(b^2 + 4 K_Q |G|))/(2 K_Q)", "eq. (15) at rest")
def _held_voltage() -> Checks:
    """75.015 V hold 50 rad/s: K_t i = B w + K_Q w^2 = 2500.75 N m, U = R i + K_b w."""
    why = "round-off, once e^-70 is left of the start; a tenth more resistance misses by 1e-2"
    for voltage in (VOLTAGE, -VOLTAGE):
        (_, *found), exact = _drive(voltage, 1.0)[:, -1], steady_state(MOTOR, voltage)
        for quantity, unit, ours, theirs in zip(("speed", "current"), ("rad/s", "A"), found, exact, strict=True):
            yield close(f"{quantity} at {voltage:g} V, {unit}", ours, theirs, 1e-9, why)


@MOTORS.add("motor, step from rest", INTEGRATED, "eq. (15)")
def _step_from_rest() -> Checks:
    """75.015 V on a motor at rest."""
    t, *found = _drive(VOLTAGE, 0.3)
    yield from _same_motor(found, driven_motor(MOTOR, VOLTAGE, (0.0, 0.0), t), *LIMIT)


@MOTORS.add("motor, reversal through zero", INTEGRATED, "eq. (15)")
def _reversal() -> Checks:
    """|w| w is only once differentiable at 0, which costs digits; the jump is an instant between two steps."""
    jump = 0.1003
    t, *found = _drive(50.0, 0.3, {"kind": "step", "value": -100.0, "time": jump})
    before = driven_motor(MOTOR, 50.0, (0.0, 0.0), np.append(t[t < jump], jump))
    after = driven_motor(MOTOR, -50.0, (before[0, -1], before[1, -1]), np.append(jump, t[t > jump]))
    exact = np.concatenate([before[:, :-1], after[:, 1:]], axis=1)
    yield from _same_motor(found, exact, 3e-6, "|w|w has a kink at 0; the jump one step late misses by 1e-2")


@MOTORS.add("motor, poles", "exponentials of its poles", "eq. (15) linearised")
def _poles() -> Checks:
    """Without a propeller, and around 50 rad/s, the motor is linear."""
    t, found, _ = _drive(1.0, 0.2, load_coefficient=0.0)
    exact = linear_step(MOTOR | {"load_coefficient": 0.0}, 0.0, 1.0, t)
    yield same_history("speed without a propeller, rad/s", found, exact, *LIMIT)
    change, begin = 1e-3, 0.5
    perturbed, steady = _drive(VOLTAGE, 0.6, {"kind": "step", "value": change, "time": begin}), _drive(VOLTAGE, 0.6)
    late = steady[0] >= begin
    found, t = (perturbed - steady)[1, late], steady[0, late]
    exact = linear_step(MOTOR, 50.0, change, t - t[0])
    yield same_history("change of speed after 1 mV, rad/s", found, exact, 1e-4, "what is not linear in 1 mV")


@MOTORS.add("motor, L -> 0", "a tanh", "eq. (15) without i'")
def _vanishing_inductance() -> Checks:
    """The distance to the limit falls with L."""
    (t, coarse, _), (_, fine, _) = (_drive(VOLTAGE, 0.02, step=2.5e-4, inductance=x) for x in (4e-5, 2e-5))
    exact = without_inductance(MOTOR, VOLTAGE, t)
    far, near = (np.abs(speed - exact).max() for speed in (coarse, fine))
    yield close("distance at 40 uH over that at 20 uH", far / near, 2.0, 0.15, "what the next order in L leaves")
    # Until some L/R of 0.5 ms have passed the current is still rising, which no power of L tells.
    limit, later = 2.0 * fine - coarse, t > 0.005
    why = "the next order in L; a tenth more inertia misses by 1e-1"
    yield same_history("speed extrapolated to L = 0, rad/s", limit[later], exact[later], 2e-3, why)


@CASES.add("law of a motor at random states", "(52), (59), (60)", EQUATIONS)
def _inner() -> Checks:
    """V_b for errors of a tenth of a width to a hundred widths, with nothing observed."""
    scenario, random = load("paper"), np.random.default_rng(2022)
    constants, loop = motor_constants(scenario.motors[0]), scenario.control.motor_loop
    gains = backstepping.Backstepping(*(getattr(loop, name) for name in backstepping.Backstepping._fields))
    speed = random.uniform(-20.0, 20.0, STATES)
    errors = 10.0 ** random.uniform(-2.0, 1.0, STATES) * random.choice([-1.0, 1.0], STATES)
    reference = np.array([speed - errors, random.normal(0.0, 30.0, STATES), random.normal(0.0, 3e3, STATES)])
    z2 = paper.K_T / paper.J * random.uniform(-60.0, 60.0, STATES)
    found = [backstepping.backstepping_drive(constants, gains, w, z, Reference.one(*r))
             for w, z, r in zip(speed, z2, reference.T, strict=True)]  # fmt: skip
    # The reference has as many motors as there are states; the thrust, which only drives the filter, is of no matter.
    wanted = paper.motor_loops(0.0, speed, z2 * paper.J / paper.K_T, reference, -paper.G_O * z2)[0] * paper.F23
    yield same_history("V_b, rad/s3, at 200 states", found, wanted, *AT_STATES)


@CASES.add("law at the ROV at random states", "(22)", EQUATIONS)
def _outer() -> Checks:
    """The commanded thrust, from what the observers hold."""
    random = np.random.default_rng(22)
    found, wanted = [], []
    for _ in range(STATES):
        x1, z1, tension = random.normal(0.0, 0.1), random.normal(0.0, 1e-2), random.uniform(3e3, 6e3)
        observers = np.append(random.normal(0.0, [0.1, 5e-4, 1e-2, 5e-5]), random.normal(0.0, 100.0))
        velocity, rate = observers[1] / paper.EPS, observers[3] / paper.EPS
        known = tension * z1 + paper.TIP_DAMPING * velocity
        estimate = observers[4] + paper.K_S * paper.MASS * velocity
        error = velocity + paper.BETA * z1
        found.append(boundary.boundary_thrust(paper.K_A, paper.BETA, paper.MASS, error, rate, known, estimate))
        wanted.append(paper.commanded_thrust(x1, z1, tension, observers)[0])
    yield same_history("commanded thrust, N, at 200 states", found, wanted, *AT_STATES)


def estimated_derivative(samples: Array, damping: float = 2.0) -> Array:
    """Estimates of a signal's derivative at every sample but the first."""
    observer = high_gain.make_high_gain(HighGainObserver(time_constant=EPS, damping=damping), PERIOD)
    memory, out = high_gain.HighGainMemory.one(), []
    high_gain.start_high_gain(memory, samples[0])
    for sample in samples[1:]:
        high_gain.advance_high_gain(observer, memory, sample)
        out.append(high_gain.derivative_estimate(observer, memory))
    return np.array(out)


def _payload_disturbance(velocity: Array, error: float = 0.0, force: float = 0.0, mass: float = 500.0) -> Array:
    """Estimates of D at the samples of Dy/Dt, while u_a and the known force are constant."""
    observer = of_payload.make_disturbance(DisturbanceObserver(gain=GAIN, coupling=2.0), PERIOD)
    memory, out = of_payload.DisturbanceMemory.one(), []
    of_payload.start_disturbance(observer, memory, mass, velocity[0])
    for k, w in enumerate(velocity):
        if k:
            of_payload.advance_disturbance(observer, memory, mass, w, error, force)
        out.append(of_payload.disturbance_estimate(observer, memory, mass, w))
    return np.array(out)


def _motor_disturbance(scaled_current: Array, speed: float = 0.0, drive: float = 0.0) -> Array:
    """Estimates of f23 d2 at the samples of z2, while the speed and V are held."""
    constants, gain = motor_constants(Motor.model_validate(MOTOR)), MOTOR_GAIN
    ups = [of_motor.start_motor_disturbance(gain, scaled_current[0])]
    for z2 in scaled_current[1:]:
        decay = exp(-gain * PERIOD)
        ups.append(of_motor.advance_motor_disturbance(constants, gain, decay, ups[-1], speed, z2, drive))
    return np.array(ups) + gain * scaled_current


def _same_transfer(
    quantity: str, unit: str, estimate: Callable[[Array], Array], frequencies: tuple[float, ...],
    ideal: Callable[[float], complex], *limit: Any, count: int = 8000, phase: bool = True,
) -> Checks:  # fmt: skip
    """Gain and phase from the samples of a sine to an estimate, once the start has died away."""
    found, t = [], np.arange(count + 1) * PERIOD
    for w in frequencies:
        waves = np.exp(1j * w * t[-1000:])
        columns = np.stack([np.imag(waves), np.real(waves)], axis=1)
        real, imaginary = np.linalg.lstsq(columns, estimate(np.sin(w * t))[-1000:], rcond=None)[0]
        found.append(complex(real, imaginary))
    wanted = [ideal(w) for w in frequencies]
    yield close(f"{quantity}, the worst, {unit}", np.abs(found), np.abs(wanted), *limit)
    if phase:
        yield close("its phase, rad, the worst", np.angle(found), np.angle(wanted), *limit)


@CASES.add("high-gain observer", "s/(eps^2 s^2 + lam eps s + 1)", "eqs. (17), (19)")
def _high_gain_responses() -> Checks:
    """A unit step, and sines from slow to beyond the observer's own frequency of 200 rad/s."""
    t = np.arange(1, 60) * PERIOD
    for damping in (2.0, 1.0):
        found = estimated_derivative(np.append(0.0, np.ones(t.size)), damping)
        wanted = exact.high_gain_step(EPS, damping, t)
        yield same_history(f"unit step, lam = {damping:g}, 1/s", found, wanted, *DISCRETE)

    def ideal(w: float) -> complex:
        return exact.high_gain_transfer(EPS, 2.0, w, PERIOD)

    what, why = "transfer at 5, 50, 200 rad/s", "the tail of the sum over images"
    yield from _same_transfer(what, "rad/s", estimated_derivative, (5.0, 50.0, 200.0), ideal, 1e-4, why, count=2000)


@CASES.add("disturbance observer of the ROV", "k_s/(s + k_s)", "eq. (21)")
def _payload_responses() -> Checks:
    """A ROV held still, one pushed by a constant D, and one pushed by a sine."""
    t = np.arange(1000) * PERIOD
    still, pushed = _payload_disturbance(np.zeros(t.size), 0.3, 20.0), _payload_disturbance(0.2 * t)
    yield same_history("held still, D^, N", still, 20.6 * exact.first_order(GAIN, t), *DISCRETE)
    yield same_history("pushed by 100 N, D^, N", pushed, 100.0 * exact.first_order(GAIN, t), 5e-3, FIRST_ORDER)

    def ideal(w: float) -> complex:
        """Under D = m w cos(w t) the ROV moves with sin(w t): from the velocity to D^ it is m s k/(s + k)."""
        return 500.0j * w * exact.first_order_transfer(GAIN, w)

    what = "transfer at 1, 5, 20 rad/s"
    yield from _same_transfer(what, "N s/m", _payload_disturbance, (1.0, 5.0, 20.0), ideal, 2e-2, FIRST_ORDER)


@CASES.add("disturbance observer of a motor", "g_o/(s + g_o)", "eq. (61)")
def _motor_responses() -> Checks:
    """A motor whose current does not move although a voltage of 0.2 V is missing, and one whose current swings."""
    c, t = motor_constants(Motor.model_validate(MOTOR)), np.arange(200) * PERIOD
    wanted = c.f23 * 0.2
    found = _motor_disturbance(np.full(t.size, 200.0), 10.0, -(c.f21 * 10.0 + c.f22 * 200.0 + wanted))
    yield same_history("d2 = 0.2 V, d^, rad/s3", found, wanted * exact.first_order(MOTOR_GAIN, t), *DISCRETE)

    def ideal(w: float) -> complex:
        """z2' = f22 z2 + f23 d2 with z2 = sin(w t): f23 d2 = (s - f22) z2."""
        return (1j * w - c.f22) * exact.first_order_transfer(MOTOR_GAIN, w)

    what, why = "transfer at 5, 20 rad/s", "first order in the period, g_o h = 0.1; a gain off by two misses by 1"
    yield from _same_transfer(what, "rad/s3", _motor_disturbance, (5.0, 20.0), ideal, 5e-2, why, phase=False)


@CASES.add("adaptive law in the loop", "(27), solved for held theta u_a", "eq. (27)")
def _adaptation() -> Checks:
    """kappa of a run, from the commands and the boundary errors of that run, by the law written out again.

    ``kappa' = -Gamma (theta u_a + s_k kappa)``, theta = [alpha_c, 1, 1], both held over the period that ends. With the
    other sign of the law the loop would run away at 0.7 s, and nothing could be compared.
    """
    rates, leak, start = np.array([0.1, 100.0, 50.0]), 0.2, np.array([0.25, 0.0, 0.5])
    run = engine.finished(load("paper-adaptive", {
        "control.allocation": {"method": "adaptive", "rates": [*rates], "leak": leak, "initial": [*start]},
        "duration": 0.5, "output.interval": PERIOD, "grid.elements": 8,
    }))  # fmt: skip
    wanted = [start]  # the first update starts, and advances nothing
    for alpha, u_a in zip(run["thrust_command"].values[1:], run["boundary_error"].values[1:], strict=True):
        steady = -np.array([alpha, 1.0, 1.0]) * u_a / leak
        wanted.append(steady + (wanted[-1] - steady) * np.exp(-rates * leak * PERIOD))
    why = "each step is exact for what is held: round-off; the other sign misses by 1"
    for j, (found, exactly) in enumerate(zip((run["kappa"].values - start).T, (wanted - start).T, strict=True)):
        yield same_history(f"kappa_{j} less its start, over 0.5 s", found, exactly, 1e-9, why)
