"""The motor of eq. (15) alone under a given voltage: steady state, step, reversal, poles, vanishing inductance."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.run import Run
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, close, history_close
from umbilical.verify.engine import constant
from umbilical.verify.references.motor import driven_motor, linear_step, steady_state, without_inductance

MOTOR = {
    "inertia": 0.5, "viscous_friction": 0.015, "torque_constant": 4.0, "load_coefficient": 1.0, "resistance": 0.08,
    "inductance": 0.002, "back_emf_constant": 0.5, "thrust_coefficient": 1.0,
}  # fmt: skip
VOLTAGE = 75.015
STEP = 1e-6
WHY = "asked for; a tenth more inertia misses by 1e-2"


def _drive(signal: list[dict[str, Any]], duration: float, step: float = 1e-3, **changes: float) -> Run:
    """A motor whose drive gets ``signal``, V, and nothing else."""
    overrides = {
        "control.law": {"kind": "none"}, "control.period": step, "grid": {"elements": 4, "step": step},
        "environment.payload_force": [], "motors": [MOTOR | changes | {"voltage_disturbance": signal}],
        "duration": duration, "output.interval": step,
    }  # fmt: skip
    return engine.completed(load("paper", overrides))


def _held_voltage() -> Iterator[Check]:
    """75.015 V hold 50 rad/s: K_t i = B w + K_Q w^2 = 2500.75 N m, U = R i + K_b w."""
    for sign in (1.0, -1.0):
        run = _drive([constant(sign * VOLTAGE)], 1.0)
        speed, current = steady_state(MOTOR, sign * VOLTAGE)
        why = "round-off, once e^-70 is left of the start; a tenth more resistance misses by 1e-2"
        yield close(f"speed at {sign * VOLTAGE:g} V, rad/s", run["motor_speed"].values[-1, 0], speed, 1e-9, why)
        yield close(f"current at {sign * VOLTAGE:g} V, A", run["motor_current"].values[-1, 0], current, 1e-9, why)


def _step_from_rest() -> Iterator[Check]:
    """75.015 V on a motor at rest."""
    run = _drive([constant(VOLTAGE)], 0.3)
    speed, current = driven_motor(MOTOR, VOLTAGE, (0.0, 0.0), run["time"].values)
    yield history_close("speed over 0.3 s, rad/s", run["motor_speed"].values[:, 0], speed, STEP, WHY)
    yield history_close("current over 0.3 s, A", run["motor_current"].values[:, 0], current, STEP, WHY)


def _reversal() -> Iterator[Check]:
    """|w| w is only once differentiable at 0, which costs digits; the jump is an instant between two steps."""
    jump = 0.1003
    run = _drive([constant(50.0), {"kind": "step", "value": -100.0, "time": jump}], 0.3)
    t = run["time"].values
    before = driven_motor(MOTOR, 50.0, (0.0, 0.0), np.append(t[t < jump], jump))
    after = driven_motor(MOTOR, -50.0, (before[0, -1], before[1, -1]), np.append(jump, t[t > jump]))
    exact = np.concatenate([before[:, :-1], after[:, 1:]], axis=1)
    why = "|w|w has a kink at 0; the jump one step late misses by 1e-2"
    yield history_close("speed over 0.3 s, rad/s", run["motor_speed"].values[:, 0], exact[0], 3.0 * STEP, why)
    yield history_close("current over 0.3 s, A", run["motor_current"].values[:, 0], exact[1], 3.0 * STEP, why)


def _poles() -> Iterator[Check]:
    """Without a propeller, and around 50 rad/s, the motor is linear."""
    run = _drive([constant(1.0)], 0.2, load_coefficient=0.0)
    exact = linear_step(MOTOR | {"load_coefficient": 0.0}, 0.0, 1.0, run["time"].values)
    yield history_close("speed without a propeller, rad/s", run["motor_speed"].values[:, 0], exact, STEP, WHY)
    change, begin = 1e-3, 0.5
    jumping = [constant(VOLTAGE), {"kind": "step", "value": change, "time": begin}]
    perturbed, steady = _drive(jumping, 0.6), _drive([constant(VOLTAGE)], 0.6)
    t = perturbed["time"].values
    late = t >= begin
    found = (perturbed["motor_speed"].values - steady["motor_speed"].values)[late, 0]
    exact = linear_step(MOTOR, 50.0, change, t[late] - t[late][0])
    yield history_close("change of speed after 1 mV, rad/s", found, exact, 1e-4, "what is not linear in 1 mV")


def _vanishing_inductance() -> Iterator[Check]:
    """The distance to the limit falls with L."""
    t, found = np.zeros(0), []
    for inductance in (4e-5, 2e-5):
        run = _drive([constant(VOLTAGE)], 0.02, step=2.5e-4, inductance=inductance)
        t = run["time"].values
        found.append(run["motor_speed"].values[:, 0])
    exact = without_inductance(MOTOR, VOLTAGE, t)
    far, near = (np.abs(speed - exact).max() for speed in found)
    yield close("distance at 40 uH over that at 20 uH", far / near, 2.0, 0.15, "what the next order in L leaves")
    # Until some L/R of 0.5 ms have passed the current is still rising, which no power of L tells.
    limit, later = 2.0 * found[1] - found[0], t > 0.005
    why = "the next order in L; a tenth more inertia misses by 1e-1"
    yield history_close("speed extrapolated to L = 0, rad/s", limit[later], exact[later], 2e-3, why)


INTEGRATED = "DOP853 at 1e-12"
CASES = (
    Case("motor, steady state", "sgn(G)(-b + sqrt(b^2 + 4 K_Q |G|))/(2 K_Q)", "eq. (15) at rest", _held_voltage),
    Case("motor, step from rest", INTEGRATED, "eq. (15)", _step_from_rest),
    Case("motor, reversal through zero", INTEGRATED, "eq. (15)", _reversal),
    Case("motor, poles", "exponentials of its poles", "eq. (15) linearised", _poles),
    Case("motor, L -> 0", "a tanh", "eq. (15) without i'", _vanishing_inductance),
)
