"""Nothing that happens between two steps is stepped over: pulses and faults act at their instant.

Before the first wave comes back from the vessel, 14 s here, the ROV on its cable is a mass on a dashpot: under
constant tension ``m V' + (Z + k) V = P(t)`` with ``Z = sqrt(rho T)``, whatever the length.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.run import Run
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, each_close, small
from umbilical.verify.engine import STEADY_TENSION, open_loop

MASS, IMPEDANCE, STEP = 500.0, 100.0, 1e-3
LOOK = 5
"""Steps after the instant at which the velocity is read; a whole step late it would be off by a fifth."""
TOLERANCE = 1e-2
WHY = "what the end of the grid does to 5 ms of impedance; one step late misses by 2e-1"
PULSES = ((0.05, 1e-3), (0.05003, 1e-4), (0.0505, 1e-6), (0.0499, 2e-4), (0.0, 1e-4), (0.05, 1e-7))
"""Starts and widths, s: on steps, between them, across one, at the very start."""
JUST = 1e-4
FAULTS = {
    "just before a step": 0.05 - JUST,
    "a hair before": float(np.nextafter(0.05, 0.0)),
    "on it": 0.05,
    "a hair after": float(np.nextafter(0.05, 1.0)),
    "just after": 0.05 + JUST,
}


def _pushed(start: float, width: float) -> Run:
    """A pulse of 1 N s, however short."""
    pulse = [{"kind": "pulse", "value": 1.0 / width, "start": start, "end": start + width}]
    scenario = open_loop(duration=0.08, output__interval=STEP, environment__payload_force=pulse)
    return engine.completed(scenario.replace(STEADY_TENSION))


def stuck(start: float, **more: Any) -> Run:
    """Two motors without drive or disturbance, the second stuck at 100 rad2/s2 from ``start``: 80 N."""
    quiet = {f"motors.{k}.{name}_disturbance": [] for k in (1, 2) for name in ("torque", "voltage")}
    fault = {"kind": "stuck", "motor": 2, "start": start, "value": 100.0} | more
    changes = {
        "faults": [fault], "control.law": {"kind": "none"}, "environment.payload_force": [], "duration": 0.1,
        "output.interval": STEP, "winch": {"law": "constant", "length": 500.0},
    }  # fmt: skip
    return engine.completed(load("paper", quiet | changes | STEADY_TENSION))


def velocity_after(force: float, since: np.ndarray) -> np.ndarray:
    """V, m/s, a time after a force has set in: ``P/Z (1 - exp(-Z t/m))``."""
    return force / IMPEDANCE * -np.expm1(-IMPEDANCE * since / MASS)


def _pulses() -> Iterator[Check]:
    """Each pulse leaves its momentum, and nothing moves before it."""
    found, early = [], 0.0
    for start, width in PULSES:
        velocity = _pushed(start, width)["tip_velocity"].values
        found.append(velocity[int(np.ceil((start + width) / STEP - 1e-9)) + LOOK])
        early = max(early, float(np.abs(velocity[: int(np.floor(start / STEP + 1e-9)) + 1]).max()))
    after = np.array([(np.ceil((s + w) / STEP - 1e-9) + LOOK) * STEP - s - w / 2.0 for s, w in PULSES])
    exact = np.exp(-IMPEDANCE * after / MASS) / MASS
    yield each_close("velocity after 1 N s, m/s, the worst of six", found, exact, TOLERANCE, WHY)
    yield small("velocity before it, m/s", early, 0.0, "nothing has happened yet")


def _faults() -> Iterator[Check]:
    """80 N from the fault on: exactly on, before and after a step."""
    runs = {name: stuck(start) for name, start in FAULTS.items()}
    found = [run["tip_velocity"].values[50 + LOOK] for run in runs.values()]
    since = np.array([0.05 + LOOK * STEP - start for start in FAULTS.values()])
    yield each_close("velocity 5 ms later, m/s, the worst of five", found, velocity_after(80.0, since), TOLERANCE, WHY)
    first = {name: int(np.argmax(run["thrust"].values != 0.0)) for name, run in runs.items()}
    late = sum(first[name] != (51 if name == "just after" else 50) for name in FAULTS)
    why = "which sample is first is no matter of digits"
    yield small("samples of the thrust that come late or early", float(late), 0.0, why)


def _recovery() -> Iterator[Check]:
    """80 N from 20 ms to 40.5 ms, in the middle of a step."""
    velocity = stuck(0.02, end=0.0405)["tip_velocity"].values[45]
    exact = velocity_after(80.0, np.array(0.045 - 0.02)) - velocity_after(80.0, np.array(0.045 - 0.0405))
    why = "as before; its end one step late misses by 5e-2"
    yield each_close("velocity at 45 ms, m/s", [velocity], [exact], 2e-3, why)


DASHPOT = "P/Z (1 - exp(-Z t/m))"
SOURCE = "mass on a semi-infinite string"
CASES = (
    Case("pulses shorter than a step", DASHPOT, SOURCE, _pulses),
    Case("a fault on, before and after a step", DASHPOT, SOURCE, _faults),
    Case("a fault that ends inside a step", DASHPOT, SOURCE, _recovery),
)
