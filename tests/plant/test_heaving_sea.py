"""Heave of a sea in the string's tension: the same as sines, told, refused where the cable goes slack."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from umbilical.errors import ScenarioError
from umbilical.library.admit import admit
from umbilical.plant.seaway import sheave

SEA: dict[str, Any] = {
    "systems": [{"significant_height": 2.5, "peak_period": 8.0, "heading": 2.0, "components": 20}],
    "vessel": {"kind": "box", "length": 93.0, "breadth": 20.0, "draught": 6.6, "block_coefficient": 0.75},
    "heave": True,
}
SHORT = {"environment.vessel_ramp": 10.0, "duration": 20.0, "grid.elements": 8}


def test_a_sea_is_the_sum_of_its_sines() -> None:
    waves = umbilical.load("ringdown", {"environment.sea": SEA, **SHORT})
    assert "does not stretch" in " ".join(map(str, admit(waves)))
    along, _, up = sheave(waves.environment)

    def sines(term: Any) -> list[dict[str, Any]]:
        rows = zip(term.amplitudes, term.frequencies, term.phases, strict=True)
        return [{"kind": "sine", "amplitude": a, "frequency": w, "phase": p + np.pi / 2.0} for a, w, p in rows]

    same = {
        "environment.sea": None,
        "environment.vessel_motion": sines(along[0]),
        "environment.vessel_heave": sines(up[0]),
    }
    runs = [umbilical.simulate(scenario) for scenario in (waves, waves.replace(same))]
    for name in ("vessel_slope", "tip_displacement", "energy"):
        found, expected = (run[name].values for run in runs)
        assert abs(found - expected).max() <= 1e-8 * abs(expected).max(), name


def test_slack_is_refused_with_its_instant_and_points_to_the_rope() -> None:
    with pytest.raises(ScenarioError, match=r"N at the ROV at .* s") as refused:
        umbilical.load("ringdown", {"environment.sea": SEA, **SHORT, "payload.wet_weight": 20.0})
    problem = next(p for p in refused.value.problems if p.key == "environment.sea")
    assert 'model = "rope"' in problem.fix


def test_the_rope_heaves_with_or_without_the_key() -> None:
    heaving, silent = (
        umbilical.simulate(umbilical.load("ringdown", {"environment.sea": sea, **SHORT, "model": "rope"}))
        for sea in (SEA, SEA | {"heave": False})
    )
    np.testing.assert_array_equal(heaving["top_tension"], silent["top_tension"])
