"""The whole cascade, from the sensors to the voltages, against one continuous-time integration of the same system.

What is compared: the paper's scenario for 7 s, the winch paying out, under a smooth force on the ROV. One side is the
engine, with its own cable, steps and a controller that samples and holds; the other the continuous law on another
discretisation of the cable, integrated by scipy to nine digits. Both grids are far finer than the distance between
them, so what is left is sampling and holding: it must vanish at first order in the period, and its first order taken
out, the two must agree.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np

from umbilical.analysis.convergence import Curve
from umbilical.library import load
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, history_close, order_reached
from umbilical.verify.engine import constant, sine
from umbilical.verify.orders import PERIOD_ORDER
from umbilical.verify.references import cascade as monolithic

UNTIL = 7.0
PERIODS = (1e-3, 5e-4, 2.5e-4, 1.25e-4)
THRUST = np.array([1.2, 0.8])
BELL = {"kind": "bell", "center": 25.0, "width": 8.0, "exponent": 2.0}


def _force(t: float) -> float:
    """d(t) = 40 (1 - cos 0.7 t)^2, N: it starts so gently that the wave it sends has no front."""
    return float(40.0 * (1.0 - np.cos(0.7 * t)) ** 2)


def _histories(period: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """y(l,t), m, the delivered thrust, N, and the voltages, V, of the engine."""
    quarter = np.pi / 2.0
    changes = {
        "duration": UNTIL, "control.period": period, "grid.step": period,
        "environment.payload_force": [constant(60.0), sine(-80.0, 0.7, quarter), sine(20.0, 1.4, quarter)],
        "motors.1.torque_disturbance": [BELL | {"amplitude": 1.0}],
        "motors.1.voltage_disturbance": [BELL | {"amplitude": 0.2}],
    }  # fmt: skip
    run = engine.completed(load("paper", changes))
    return run["tip_displacement"].values, run["thrust"].values, run["motor_voltage"].values.T


@cache
def reference(degree: int = 24) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same of the continuous law, every 0.05 s."""
    found = monolithic.solve(_force, np.linspace(0.0, UNTIL, 141), degree)
    return found.tip, THRUST @ (np.abs(found.speeds) * found.speeds), found.voltages


def compared() -> Iterator[Check]:
    """Distance at four periods, and what is left when its first order is taken out."""
    exact = reference()
    found = [_histories(period) for period in PERIODS]
    rows = (("y(l,t)", "m", 5e-4), ("thrust", "N", 1e-5), ("voltages", "V", 2e-5))
    for place, (name, unit, tolerance) in enumerate(rows):
        off = tuple(float(np.abs(f[place] - exact[place]).max()) for f in found)
        curve = Curve(f"{name} to the continuous law", "the period, s", PERIODS, off, PERIOD_ORDER)
        yield order_reached(curve, "stated; above it while the second order in the period still counts")
        limit = 2.0 * found[-1][place] - found[-2][place]
        why = "the second order in the period; an observer's gain off by two misses by 1e-1"
        yield history_close(f"{name}, {unit}, in the limit of short periods", limit, exact[place], tolerance, why)


CASES = (
    Case("whole cascade, 7 s of the paper's scenario", "continuous law, Legendre cable, DOP853 at 1e-8",
         "eqs. (6)-(64) in one integration", compared, quick=False),
)  # fmt: skip
