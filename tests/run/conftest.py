"""A small run made by hand: its numbers are arbitrary, its shapes are those of a real one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from umbilical.run import Run, Status, assemble
from umbilical.scenario.scenario import parse_document

SCENARIO = """
name = "small"
duration = 1.0
seed = 7

[cable]
line_density = 2.0
damping = 0.001

[payload]
mass = 500.0
damping = 0.001

[environment]
gravity = 10.0

[winch]
law = "constant"
length = 400.0

[control]
period = 1e-3

[control.law]
kind = "none"
"""


def make_run(motors: int = 2, samples: int = 21, **changes) -> Run:
    rng = np.random.default_rng(1)
    channels = {
        "displacement": rng.normal(size=(samples, 9)),
        "tip_displacement": np.tanh(rng.normal(size=samples)),
        "motor_speed": rng.normal(size=(samples, motors)),
        "kappa": rng.normal(size=(samples, motors + 1)),
    }
    ending = {
        "time": np.linspace(0.0, 1.0, samples),
        "status": Status.COMPLETED,
        "reason": "",
        "end_time": 1.0,
        "metrics": {"tip_peak": 1.25, "effort_rms": 0.1 + 0.2},
        "timing": {"simulate_s": 0.5},
        "notices": ("first, with a line\nbreak", "second: \u03b2 = 5 m/s"),
    }
    return assemble(parse_document(SCENARIO), channels, **(ending | changes))


@pytest.fixture(name="make_run")
def give_make_run() -> Callable[..., Run]:
    return make_run


@pytest.fixture
def run() -> Run:
    return make_run()
