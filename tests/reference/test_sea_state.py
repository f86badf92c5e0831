"""A sea state on the rope against the frequency domain, and what it takes."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

import umbilical
from umbilical.screening import load_operation, respond
from umbilical.sea import Spectrum


@pytest.mark.slow
def test_the_rope_in_a_sea_has_the_statistics_of_the_frequency_domain() -> None:
    run = umbilical.simulate(umbilical.load("work-class-3000m", {"duration": 2400.0}))
    late = run["time"].values > 200.0
    exact = respond(load_operation("work-class"), Spectrum(2.5, 8.0), depth=3000.0, heading=np.radians(135.0))
    for name, expected in (("top_tension", exact.top), ("end_tension", exact.end)):
        assert run[name].values[late].std() == pytest.approx(float(expected.rms), rel=0.05), name
    assert run["body_position"].values[late, 2].std() == pytest.approx(float(exact.body.rms), rel=0.05)


@pytest.mark.slow
def test_a_long_sea_state_takes_the_memory_of_its_samples_and_next_to_no_more() -> None:
    """Some 40 bytes a step are the instants of the run's clock; what acts in a step would be some hundreds."""
    peaks, period = [], 0.01
    for duration in (1500.0, 4500.0):
        scenario = umbilical.load("work-class-3000m", {"duration": duration, "output.interval": duration / 400.0})
        tracemalloc.start()
        umbilical.simulate(scenario)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] - peaks[0] < 64.0 * 3000.0 / period
