"""Free response of a cable whose length changes, under constant tension, against the method of characteristics.

T = 5000 N, rho = 2 kg/m, m = 500 kg, damper of 40 N s/m at the ROV, start at rest from ``exp(-((s - 125)/20)^2)`` m
with s the distance from the ROV.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from umbilical.run import Run
from umbilical.verify import engine
from umbilical.verify.cases import Check, each, history_close
from umbilical.verify.engine import STEADY_TENSION, constant, open_loop, sine
from umbilical.verify.references.characteristics import HeldEnd, MovingEnd

TOLERANCE = 1e-3
SMOOTH = 1e-5
WHY_SMOOTH = "long waves only: what is left is the reference's differences"
WHY = "asked for; v of the wrong sign misses by 1, half the ROV's inertia by 1e-1"


PUSHED, SHAKEN = 0.5, 0.4
"""Frequencies w, rad/s, of force and vessel: (1 - cos w t)^2 each, which starts so gently that no wave has a kink."""


class Setting(NamedTuple):
    """A cable of constant tension with a bump, the law of its length, and the size of force, N, and vessel's motion, m.

    Tension follows from the mass: T = m g. The winch does not accelerate: the mass of the cable would pull.
    """

    length: Callable[[np.ndarray], np.ndarray]
    winch: dict[str, Any]
    tension: float = 5000.0
    mass: float = 500.0
    damping: float = 40.0
    gravity: float = 10.0
    center: float = 125.0
    width: float = 20.0
    until: float = 50.0
    bump: float = 1.0
    push: float = 0.0
    shake: float = 0.0

    def start(self, s: np.ndarray) -> np.ndarray:
        """Displacement at the start, m."""
        return self.bump * np.exp(-(((s - self.center) / self.width) ** 2))

    def impulse(self, t: np.ndarray) -> np.ndarray:
        """What the force has done until t, N s."""
        w = PUSHED
        return self.push * (1.5 * t - 2.0 * np.sin(w * t) / w + 0.25 * np.sin(2.0 * w * t) / w)

    def vessel(self, t: np.ndarray) -> np.ndarray:
        """e(t), m."""
        return self.shake * (1.0 - np.cos(SHAKEN * t)) ** 2


def steady(speed: float, **changes: Any) -> Setting:
    """250 m at a constant winch speed, m/s."""
    return Setting(lambda t: 250.0 + speed * t, {"law": "speed", "start_length": 250.0, "speed": speed}, **changes)


def _gentle(size: float, frequency: float) -> list[dict[str, Any]]:
    """The terms of ``size (1 - cos w t)^2``."""
    quarter = np.pi / 2.0
    terms = [constant(1.5 * size), sine(-2.0 * size, frequency, quarter), sine(0.5 * size, 2.0 * frequency, quarter)]
    return terms if size else []


def _run(setting: Setting, step: float = 1e-3) -> Run:
    """The engine's answer."""
    scenario = open_loop(
        winch=setting.winch, payload={"mass": setting.mass, "damping": setting.damping}, cable__damping=0.0,
        initial={"shape": "gaussian", "amplitude": setting.bump, "distance": setting.center, "width": setting.width},
        environment__gravity=setting.gravity, environment__payload_force=_gentle(setting.push, PUSHED),
        environment__vessel_motion=_gentle(setting.shake, SHAKEN), duration=setting.until, grid__step=step,
        control__period=max(step, 1e-3), output__interval=0.01 * setting.until,
    )  # fmt: skip
    return engine.completed(scenario.replace(STEADY_TENSION))


def reference(setting: Setting, **resolution: int) -> MovingEnd:
    """The solution along characteristics, some seconds longer than the run, for what is still under way."""
    s = setting
    cable = (s.tension, 2.0, s.mass, s.damping, s.length, s.start, 1.2 * s.until, s.impulse, s.vessel)
    return MovingEnd(*cable, **resolution)


def _compared(setting: Setting, exact: Callable[[Setting], Any] = reference, step: float = 1e-3) -> Iterator[Check]:
    """Everywhere and at the ROV, each over the peak of the reference there.

    The slope and the velocity too: a flux wrong between elements only leaves them wrong inside, and y nearly right.
    """
    found, solution = _run(setting, step), exact(setting)
    fields = {name: found[name].values for name in ("displacement", "slope", "velocity")}
    instants = found["time"].values
    distances = np.multiply.outer(setting.length(instants), 1.0 - found["sigma"].values)
    expected = [np.array(rows) for rows in zip(*map(partial(_fields, solution), distances, instants), strict=True)]
    limit = (TOLERANCE, WHY) if setting.bump else (SMOOTH, WHY_SMOOTH)
    span = f"over {setting.until:g} s"
    for quantity, values, theirs in zip(("y, m", "y_x", "Dy/Dt, m/s"), fields.values(), expected, strict=True):
        yield history_close(f"{quantity}, {span}", values, theirs, *limit)
    if exact is reference:
        yield history_close(f"y(l,t), m, {span}", fields["displacement"][:, -1], expected[0][:, -1], *limit)


def _fields(solution: Any, distance: np.ndarray, t: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacement, slope and velocity of a solution, the last two by differences of fourth order, good to 1e-7."""
    lag, way = 1e-3, 0.05  # s, m
    slope = _differences(lambda k: solution(distance - k * way, t)) / way
    return solution(distance, t), slope, _differences(lambda k: solution(distance, t + k * lag)) / lag


def _differences(f: Callable[[float], np.ndarray]) -> np.ndarray:
    """f'(0)."""
    return (8.0 * (f(1.0) - f(-1.0)) - (f(2.0) - f(-2.0))) / 12.0


def _held(speed: float) -> Iterator[Check]:
    """The ROV held by its own mass of 1e9 kg."""
    setting = steady(speed, mass=1e9, gravity=5e-6, damping=0.0)
    return _compared(setting, lambda s: HeldEnd(50.0, 250.0, speed, s.start))


DELAY = "m V' + (Z + k) V = P + 2 Z h' along characteristics, to 1e-10"
SOURCE = "d'Alembert; delay equation of the tip"
WAYS = {
    "fixed": steady(0.0),
    "paying out at 5 m/s": steady(5.0),
    "hauling in at 4 m/s": steady(-4.0),
    "pushed and shaken, paying out": steady(5.0, bump=0.0, push=20.0, shake=0.1),
    "pushed and shaken, hauling in": steady(-4.0, bump=0.0, push=20.0, shake=0.1),
}
PHASE = "R = 2 ln(1 + b c t/l0)/ln((1 + b)/(1 - b))"

CASES = (
    *each("moving end, {}", DELAY, SOURCE, _compared, WAYS),
    *each("moving end, ROV held, {:+g} m/s", PHASE, "Moore 1970; Balazs 1961", _held, (5.0, -4.0), quick=False),
)
