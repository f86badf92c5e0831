"""The two laws of the cascade, one update each, at states of no meaning: (22) at the ROV and (52)-(60) in a motor.

In a run that goes well the terms of the inner law that fight errors are small, and a wrong sign among them hardly
shows in any history. At random states every term counts.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.control.motor import backstepping
from umbilical.control.motor.command_filter import Reference
from umbilical.control.outer import boundary
from umbilical.library import load
from umbilical.relations.formulas import motor_constants
from umbilical.verify.cases import Case, Check, history_close
from umbilical.verify.references import paper

STATES = 200
ROUND_OFF = 1e-12
WHY = "round-off; a wrong sign of any term misses by 1e-6 at least"


def _inner() -> Iterator[Check]:
    """V_b for errors of a tenth of a width to a hundred widths, with nothing observed."""
    scenario, random = load("paper"), np.random.default_rng(2022)
    constants, loop = motor_constants(scenario.motors[0]), scenario.control.motor_loop
    gains = backstepping.Backstepping(*(getattr(loop, name) for name in backstepping.Backstepping._fields))
    speed = random.uniform(-20.0, 20.0, STATES)
    errors = 10.0 ** random.uniform(-2.0, 1.0, STATES) * random.choice([-1.0, 1.0], STATES)
    reference = np.array([speed - errors, random.normal(0.0, 30.0, STATES), random.normal(0.0, 3e3, STATES)])
    scaled_current = paper.K_T / paper.J * random.uniform(-60.0, 60.0, STATES)
    found, wanted = [], []
    for w, z2, r in zip(speed, scaled_current, reference.T, strict=True):
        both = np.repeat(r[:, None], 2, axis=1)  # the reference has two motors
        current = np.full(2, z2 * paper.J / paper.K_T)
        voltage = paper.motor_loops(0.0, np.full(2, w), current, both, -paper.G_O * np.full(2, z2))[0]
        found.append(backstepping.backstepping_drive(constants, gains, w, z2, Reference.one(*r)))
        wanted.append(voltage[0] * paper.F23)
    yield history_close("V_b, rad/s3, at 200 states", found, wanted, ROUND_OFF, WHY)


def _outer() -> Iterator[Check]:
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
    yield history_close("commanded thrust, N, at 200 states", found, wanted, ROUND_OFF, WHY)


SOURCE = "eqs. (22), (52)-(60), written a second time in numpy"
CASES = (
    Case("law of a motor at random states", "(52), (59), (60)", SOURCE, _inner),
    Case("law at the ROV at random states", "(22)", SOURCE, _outer),
)
