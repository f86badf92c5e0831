"""Loads along the cable: the motion they start, and the work they do, element by element."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.scenarios import open_loop, run

pytestmark = pytest.mark.nojit

POSITIONS, SHARES = [0.0, 0.25, 0.5, 0.75, 1.0], [0.0, 1.0, 3.0, -2.0, 0.0]  # kinks where elements meet
LOAD = 0.5  # N/m


def test_a_load_along_the_cable_moves_it_where_it_acts_and_its_work_is_booked() -> None:
    profile = {"shape": "table", "positions": POSITIONS, "values": SHARES}
    load = [{"profile": profile, "signal": [{"kind": "constant", "value": LOAD}]}]
    scenario = open_loop(
        duration=0.03, grid={"elements": 4, "step": 1e-3}, output__interval=1e-3, environment__cable_load=load
    )
    result = run(scenario)
    sigma, early = result["sigma"].values, 2e-3
    expected = LOAD * np.interp(sigma, POSITIONS, SHARES) / scenario.cable.line_density * early
    away = np.min(np.abs(sigma[:, None] - np.array(POSITIONS)), axis=1) > 0.05  # waves from a kink come 0.2 m far
    np.testing.assert_allclose(result["velocity"].values[2, away], expected[away], rtol=1e-3)
    energy, work = result["energy"].values, result["work_cable_load"].values
    assert work[-1] > 0.5 * energy[-1] > 0.0
    assert np.abs(result["energy_residual"].values).max() < 1e-3 * work[-1]
