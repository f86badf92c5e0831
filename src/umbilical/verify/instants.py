"""Nothing that happens between two steps is stepped over: pulses and faults act at their instant.

Before the first wave comes back from the vessel, 14 s here, the ROV on its cable is a mass on a dashpot: under
constant tension ``m V' + (Z + k) V = P(t)`` with ``Z = sqrt(rho T)``, whatever the length.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.run import Run
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, close, small
from umbilical.verify.engine import STEADY_TENSION, open_loop

CASES = Cases()
MASS, IMPEDANCE, STEP = 500.0, 100.0, 1e-3
LOOK = 5
"""Steps after the instant at which the velocity is read; a whole step late it would be off by a fifth."""
DASHPOT = ("P/Z (1 - exp(-Z t/m))", "mass on a semi-infinite string")
LIMIT = (1e-2, "what the end of the grid does to 5 ms of impedance; one step late misses by 2e-1")
PULSES = ((0.05, 1e-3), (0.05003, 1e-4), (0.0505, 1e-6), (0.0499, 2e-4), (0.0, 1e-4), (0.05, 1e-7))
"""Starts and widths, s: on steps, between them, across one, at the very start."""
FAULTS = np.array([0.05 - 1e-4, np.nextafter(0.05, 0.0), 0.05, np.nextafter(0.05, 1.0), 0.05 + 1e-4])
"""Starts, s: just before a step, a hair before, on it, a hair after, just after."""


def _pushed(start: float, width: float) -> Run:
    """A pulse of 1 N s, however short."""
    pulse = [{"kind": "pulse", "value": 1.0 / width, "start": start, "end": start + width}]
    scenario = open_loop(duration=0.08, output__interval=STEP, environment__payload_force=pulse)
    return engine.finished(scenario.replace(STEADY_TENSION))


def stuck(start: float, **more: Any) -> Run:
    """Two motors without drive or disturbance, the second stuck at 100 rad2/s2 from ``start``: 80 N."""
    quiet = {f"motors.{k}.{name}_disturbance": [] for k in (1, 2) for name in ("torque", "voltage")}
    fault = {"kind": "stuck", "motor": 2, "start": start, "value": 100.0} | more
    changes = {
        "faults": [fault], "control.law": {"kind": "none"}, "environment.payload_force": [], "duration": 0.1,
        "output.interval": STEP, "winch": {"law": "constant", "length": 500.0},
    }  # fmt: skip
    return engine.finished(load("paper", quiet | changes | STEADY_TENSION))


def velocity_after(force: float, since: Any) -> Any:
    """V, m/s, a time after a force has set in: ``P/Z (1 - exp(-Z t/m))``."""
    return force / IMPEDANCE * -np.expm1(-IMPEDANCE * since / MASS)


@CASES.add("pulses shorter than a step", *DASHPOT)
def _pulses() -> Checks:
    """Each pulse leaves its momentum, and nothing moves before it."""
    found, exact, early = [], [], 0.0
    for start, width in PULSES:
        velocity = _pushed(start, width)["tip_velocity"].values
        read = int(np.ceil((start + width) / STEP - 1e-9)) + LOOK
        found.append(velocity[read])
        exact.append(np.exp(-IMPEDANCE * (read * STEP - start - width / 2.0) / MASS) / MASS)
        early = max(early, float(np.abs(velocity[: int(np.floor(start / STEP + 1e-9)) + 1]).max()))
    yield close("velocity after 1 N s, m/s, the worst of six", found, exact, *LIMIT)
    yield small("velocity before it, m/s", early, 0.0, "nothing has happened yet")


@CASES.add("a fault on, before and after a step", *DASHPOT)
def _faults() -> Checks:
    """80 N from the fault on: exactly on, before and after a step."""
    runs = [stuck(start) for start in FAULTS.tolist()]
    found, since = [run["tip_velocity"].values[50 + LOOK] for run in runs], 0.05 + LOOK * STEP - FAULTS
    yield close("velocity 5 ms later, m/s, the worst of five", found, velocity_after(80.0, since), *LIMIT)
    first = [np.argmax(run["thrust"].values != 0.0) for run in runs]
    late, why = (
        np.count_nonzero(np.not_equal(first, [50, 50, 50, 50, 51])),
        "which sample is first is no matter of digits",
    )
    yield small("samples of the thrust that come late or early", late, 0.0, why)


@CASES.add("a fault that ends inside a step", *DASHPOT)
def _recovery() -> Checks:
    """80 N from 20 ms to 40.5 ms, in the middle of a step."""
    velocity = stuck(0.02, end=0.0405)["tip_velocity"].values[45]
    exact = velocity_after(80.0, 0.045 - 0.02) - velocity_after(80.0, 0.045 - 0.0405)
    yield close("velocity at 45 ms, m/s", velocity, exact, 2e-3, "as before; its end one step late misses by 5e-2")
