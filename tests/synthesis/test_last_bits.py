"""A design does not hang on the last bits: other rounding errors, another processor, another BLAS, the same gains."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable

import numpy as np
import pytest

import umbilical
from umbilical.synthesis import search
from umbilical.synthesis.score import Demands, Scorer
from umbilical.synthesis.search import DesignTask, Values, inner_knobs, outer_knobs, refine

RINGDOWN = umbilical.load("ringdown")
NEAR = {
    "control.law.slope_gain": 11.3, "control.law.damping_gain": 545.0,
    "control.velocity_observer.time_constant": 0.00224, "control.velocity_observer.damping": 1.23,
    "control.slope_observer.time_constant": 0.821, "control.slope_observer.damping": 1.3,
    "control.disturbance_observer.gain": 79.0, "control.motor_loop.filter_frequency": 873.0,
    "control.motor_loop.speed_gain": 250.0, "control.motor_loop.current_gain": 316.0,
}  # fmt: skip
GAINS, RESULTS = 0.01, 0.02
"""Relative tolerances that docs/design.md states, of gains and of what a simulation gives with them."""
SHORT_DESIGN = """
import json, umbilical
from umbilical.synthesis import iterate
from umbilical.synthesis.design import design
iterate.GENERATIONS = 4
short = {"grid.elements": 8, "duration": 4.0}
found = design(umbilical.load("ringdown", short), "both", inner=True)
trial = found.after.trial
print(json.dumps([found.values, [found.after.score.reflection, trial.late_mid_peak, trial.voltage_peak]]))
"""


@pytest.fixture
def with_other_bits(monkeypatch: pytest.MonkeyPatch) -> Callable[[int], Values]:
    """Gains of a short local search whose scores all have errors of their own, as large as double poles make them."""
    monkeypatch.setattr(search, "LOCAL_STEPS", 60)
    monkeypatch.setattr("umbilical.synthesis.score.POINTS", 120)
    exact = Scorer.score

    def found(seed: int, error: float = 1e-9) -> Values:
        draw = np.random.default_rng(seed)

        def score(scorer, loop):
            s = exact(scorer, loop)
            errors = 1.0 + error * draw.standard_normal(s.trips.size + 2)
            return s._replace(
                reflection=s.reflection * errors[0], compliance=s.compliance * errors[1], trips=s.trips * errors[2:]
            )

        monkeypatch.setattr(Scorer, "score", score)
        knobs = outer_knobs(RINGDOWN, 50.0) + inner_knobs(RINGDOWN)
        return refine(DesignTask(RINGDOWN, knobs, "both", Demands().beyond(1.0), 400.0, 50.0), NEAR)

    return found


def test_rounding_errors_leave_the_gains_as_they_are(with_other_bits):
    one, two = with_other_bits(1), with_other_bits(2)
    assert one.keys() == two.keys()
    assert list(one.values()) == pytest.approx(list(two.values()), rel=GAINS)
    assert list(one.values()) != pytest.approx(list(NEAR.values()), rel=GAINS)  # the search went somewhere


def test_errors_that_no_processor_makes_are_noticed(with_other_bits):
    """Negative control: the scores do decide."""
    assert with_other_bits(1, 1e-2) != with_other_bits(2, 1e-2)


@pytest.mark.slow
@pytest.mark.parametrize(
    "processor",
    [{"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": "", "OPENBLAS_CORETYPE": "Prescott"}],
    ids=["generic, Prescott"],
)
def test_another_processor_and_another_blas_find_the_same_gains(processor):
    kinds = ({}, processor)
    done = [
        subprocess.run([sys.executable, "-c", SHORT_DESIGN], env=os.environ | kind, capture_output=True, check=True)
        for kind in kinds
    ]
    (gains, results), (others, others_results) = (json.loads(process.stdout) for process in done)
    assert gains == pytest.approx(others, rel=GAINS)
    assert results == pytest.approx(others_results, rel=RESULTS)
