"""One motor alone under a given voltage, in the engine and by a high-order integration of eq. (15)."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

import umbilical
from tests.support.scenarios import run
from umbilical import Run

MOTOR = {
    "inertia": 0.5,
    "viscous_friction": 0.015,
    "torque_constant": 4.0,
    "load_coefficient": 1.0,
    "resistance": 0.08,
    "inductance": 0.002,
    "back_emf_constant": 0.5,
    "thrust_coefficient": 1.0,
}


def drive(signal: list[dict[str, Any]], duration: float, step: float = 1e-3, **changes: float) -> Run:
    """A motor whose drive gets ``signal``, V, and nothing else."""
    overrides = {
        "control.law": {"kind": "none"},
        "control.period": step,
        "grid.step": step,
        "grid.elements": 4,
        "environment.payload_force": [],
        "motors": [MOTOR | changes | {"voltage_disturbance": signal}],
        "duration": duration,
        "output.interval": step,
    }
    return run(umbilical.load("paper", overrides))


def integrate(voltage: float, start: tuple[float, float], t: np.ndarray, **changes: float) -> np.ndarray:
    """Speed and current, shape (2, t), from ``start`` under a constant voltage, by DOP853 at 1e-12."""
    m = MOTOR | changes

    def rates(_: float, state: np.ndarray) -> tuple[float, float]:
        w, i = state
        torque = m["torque_constant"] * i - m["viscous_friction"] * w - m["load_coefficient"] * abs(w) * w
        return torque / m["inertia"], (voltage - m["resistance"] * i - m["back_emf_constant"] * w) / m["inductance"]

    done = solve_ivp(rates, (t[0], t[-1]), start, "DOP853", t_eval=t, rtol=1e-12, atol=1e-12, max_step=1e-3)
    assert done.success
    assert np.isfinite(done.y).all()
    return done.y
