"""Free response with a moving end under constant tension, against the method of characteristics.

T = 5000 N, rho = 2 kg/m, m = 500 kg, g = 10 m/s2, damper of 40 N s/m at the ROV, start at rest from
``exp(-((s - 125)/20)^2)`` m with s the distance from the ROV.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.characteristics import MovingEnd
from tests.support.scenarios import STEADY_TENSION, open_loop, run
from umbilical import Run

TOLERANCE = 1e-3
SPEEDS = {"fixed": 0.0, "paying out": 5.0, "hauling in": -4.0}


def reference(speed: float, until: float = 50.0, **resolution: int) -> MovingEnd:
    return MovingEnd(
        5000.0, 2.0, 500.0, 40.0, lambda t: 250.0 + speed * t, lambda s: np.exp(-(((s - 125.0) / 20.0) ** 2)), until,
        **resolution,
    )  # fmt: skip


def released(speed: float, step: float = 1e-3) -> Run:
    scenario = open_loop(
        winch={"law": "speed", "start_length": 250.0, "speed": speed},
        initial={"shape": "gaussian", "amplitude": 1.0, "distance": 125.0, "width": 20.0},
        payload__damping=40.0,
        cable__damping=0.0,
        grid__step=step,
    )
    return run(scenario.replace(STEADY_TENSION | {"output.interval": 0.5}))


@pytest.mark.parametrize("speed", SPEEDS.values(), ids=SPEEDS)
def test_reference_is_solved_to_ten_digits(speed: float) -> None:
    instants = np.linspace(0.0, 50.0, 301)
    coarse, fine = reference(speed), reference(speed, pieces=5, degree=48)
    assert np.abs(coarse.tip(instants) - fine.tip(instants)).max() < 1e-10
    assert np.abs(coarse.tip(instants)).max() > 0.05, "the pulse has reached the ROV"


@pytest.mark.parametrize("speed", SPEEDS.values(), ids=SPEEDS)
def test_reference_keeps_the_vessel_end_still(speed: float) -> None:
    solution = reference(speed)
    ends = [solution(np.array([250.0 + speed * t]), t)[0] for t in np.linspace(0.0, 44.0, 45)]
    assert np.abs(ends).max() < 1e-10


def distance(result: Run, solution: MovingEnd, speed: float) -> tuple[float, float]:
    """Largest distance anywhere, and at the ROV, each over the peak of the reference there."""
    sigma, instants = result["sigma"].values, result["time"].values
    lengths = 250.0 + speed * instants
    exact = np.array([solution(length * (1.0 - sigma), t) for length, t in zip(lengths, instants, strict=True)])
    off = np.abs(result["displacement"].values - exact)
    return float(off.max() / np.abs(exact).max()), float(off[:, -1].max() / np.abs(exact[:, -1]).max())


@pytest.mark.parametrize("speed", SPEEDS.values(), ids=SPEEDS)
def test_free_response_at_the_default_grid(speed: float) -> None:
    everywhere, tip = distance(released(speed), reference(speed, until=60.0), speed)
    assert tip < TOLERANCE
    assert everywhere < TOLERANCE
