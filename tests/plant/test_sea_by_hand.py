"""The rope and the string in water, a few steps as plain Python as well as compiled."""

from __future__ import annotations

import numpy as np
import pytest

from tests.plant.test_water import at_sea
from umbilical import load, simulate

pytestmark = pytest.mark.nojit


@pytest.mark.parametrize("preset", ["work-class-3000m", "observation-300m", "work-class-payout", "paper-adaptive"])
def test_the_rope_starts_at_rest_and_stays_finite(preset: str) -> None:
    run = simulate(load(preset, {"duration": 0.05, "model": "rope", "rope.elements": 3}))
    assert run.status.name == "COMPLETED"
    assert np.isfinite(run["position"].values).all()
    assert (run["top_tension"].values > 0.0).all()


@pytest.mark.parametrize("start", [{}, {"initial.shape": "equilibrium"}])
def test_the_string_in_a_current_is_pushed_along_by_it(start: dict[str, str]) -> None:
    run = simulate(at_sea(**{"duration": 0.05, "grid.elements": 4}, **start))
    assert run.status.name == "COMPLETED"
    assert run["tip_displacement"].values[-1] - run["tip_displacement"].values[0] > -1e-9
