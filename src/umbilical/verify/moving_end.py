"""Free response of a cable whose length changes, under constant tension, against the method of characteristics.

T = 5000 N, rho = 2 kg/m, m = 500 kg, damper of 40 N s/m at the ROV, 250 m at the start, at rest in
``exp(-((s - 125)/20)^2)`` m with s the distance from the ROV.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, same_history
from umbilical.verify.engine import STEADY_TENSION, gentle, open_loop
from umbilical.verify.references.characteristics import HeldEnd, MovingEnd

CASES = Cases()
TENSION, START, CENTER, WIDTH, UNTIL = 5000.0, 250.0, 125.0, 20.0, 50.0
PUSHED, SHAKEN = 0.5, 0.4
"""Frequencies w, rad/s, of force and vessel: (1 - cos w t)^2 each, which starts so gently that no wave has a kink."""


class Setting(NamedTuple):
    """A steady winch, m/s, the ROV, and the size of bump, m, force, N, and vessel's motion, m.

    Tension follows from the mass: T = m g. The winch does not accelerate: the mass of the cable would pull.
    """

    speed: float
    mass: float = 500.0
    damping: float = 40.0
    bump: float = 1.0
    push: float = 0.0
    shake: float = 0.0

    def length(self, t: np.ndarray) -> np.ndarray:
        """l(t), m."""
        return START + self.speed * t

    def start(self, s: np.ndarray) -> np.ndarray:
        """Displacement at the start, m."""
        return self.bump * np.exp(-(((s - CENTER) / WIDTH) ** 2))

    def impulse(self, t: np.ndarray) -> np.ndarray:
        """What the force has done until t, N s."""
        w = PUSHED
        return self.push * (1.5 * t - 2.0 * np.sin(w * t) / w + 0.25 * np.sin(2.0 * w * t) / w)

    def vessel(self, t: np.ndarray) -> np.ndarray:
        """e(t), m."""
        return self.shake * (1.0 - np.cos(SHAKEN * t)) ** 2

    def scenario(self) -> Any:
        """What the engine runs."""
        return open_loop(
            winch={"law": "speed", "start_length": START, "speed": self.speed}, cable__damping=0.0,
            payload={"mass": self.mass, "damping": self.damping}, environment__gravity=TENSION / self.mass,
            initial={"shape": "gaussian", "amplitude": self.bump, "distance": CENTER, "width": WIDTH},
            environment__payload_force=gentle(self.push, PUSHED), duration=UNTIL, output__interval=0.01 * UNTIL,
            environment__vessel_motion=gentle(self.shake, SHAKEN),
        ).replace(STEADY_TENSION)  # fmt: skip


def reference(setting: Setting, **resolution: int) -> MovingEnd:
    """The solution along characteristics, some seconds longer than the run, for what is still under way."""
    s = setting
    cable = (TENSION, 2.0, s.mass, s.damping, s.length, s.start, 1.2 * UNTIL, s.impulse, s.vessel)
    return MovingEnd(*cable, **resolution)


def _differences(f: Callable[[float], np.ndarray]) -> np.ndarray:
    """f'(0), of fourth order, good to 1e-7."""
    return (8.0 * (f(1.0) - f(-1.0)) - (f(2.0) - f(-2.0))) / 12.0


def _same_fields(setting: Setting, solution: Callable[[np.ndarray, float], np.ndarray]) -> Checks:
    """Everywhere, each over the peak of the reference there.

    The slope and the velocity too: a flux wrong between elements only leaves them wrong inside, and y nearly right.
    """
    found, lag, way = engine.finished(setting.scenario()), 1e-3, 0.05  # s, m
    t = found["time"].values
    instants = list(zip(t.tolist(), np.multiply.outer(setting.length(t), 1.0 - found["sigma"].values), strict=True))
    expected = {
        ("displacement", "y, m"): [solution(s, t) for t, s in instants],
        ("slope", "y_x"): [_differences(lambda k, s=s, t=t: solution(s - k * way, t)) / way for t, s in instants],
        ("velocity", "Dy/Dt, m/s"): [
            _differences(lambda k, s=s, t=t: solution(s, t + k * lag)) / lag for t, s in instants
        ],
    }  # fmt: skip
    limit = (1e-3, "asked for; v of the wrong sign misses by 1, half the ROV's inertia by 1e-1")
    if not setting.bump:
        limit = (1e-5, "long waves only: what is left is the reference's differences")
    for (name, quantity), wanted in expected.items():
        yield same_history(f"{quantity}, over {UNTIL:g} s", found[name].values, wanted, *limit)
    if isinstance(solution, MovingEnd):
        tip = [row[-1] for row in expected["displacement", "y, m"]]
        yield same_history(f"y(l,t), m, over {UNTIL:g} s", found["displacement"].values[:, -1], tip, *limit)


WAYS = {
    "fixed": Setting(0.0),
    "paying out at 5 m/s": Setting(5.0),
    "hauling in at 4 m/s": Setting(-4.0),
    "pushed and shaken, paying out": Setting(5.0, bump=0.0, push=20.0, shake=0.1),
    "pushed and shaken, hauling in": Setting(-4.0, bump=0.0, push=20.0, shake=0.1),
}


@CASES.add("moving end, {}", "m V' + (Z + k) V = P + 2 Z h' along characteristics, to 1e-10",
           "d'Alembert; delay equation of the tip", WAYS)  # fmt: skip
def _compared(setting: Setting) -> Checks:
    return _same_fields(setting, reference(setting))


@CASES.add("moving end, ROV held, {:+g} m/s", "R = 2 ln(1 + b c t/l0)/ln((1 + b)/(1 - b))",
           "Moore 1970; Balazs 1961", (5.0, -4.0), quick=False)  # fmt: skip
def _held(speed: float) -> Checks:
    """The ROV held by its own mass of 1e9 kg."""
    setting = Setting(speed, mass=1e9, damping=0.0)
    return _same_fields(setting, HeldEnd(50.0, START, speed, setting.start))
