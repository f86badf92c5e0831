"""Maps: large enough, no run made twice, and on a coarse grid that says what the default grid says."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import pytest

from umbilical.engine.simulate import simulate
from umbilical.library import load
from umbilical.papers.rao2022.experiments import ARMS, BELIEVED, OBSERVERS, preset
from umbilical.papers.rao2022.ledger import Evidence
from umbilical.papers.rao2022.map_runs import EARLY, FACTORS, GRID, Point, gain_point, make_point, run_points
from umbilical.papers.rao2022.maps import GAIN_CASES, PRESET_RATES, SLICES
from umbilical.papers.rao2022.regions import diverged, reversal, same_on_grids
from umbilical.scenario import Scenario

DEFAULT: dict[str, Any] = {}


def test_maps_are_fifteen_by_fifteen_and_show_the_preset() -> None:
    for one in SLICES:
        assert len(one.x.values) >= 15
        assert len(one.y.values) >= 15
        assert any(np.isclose(one.x.values, one.x.paper))
        assert any(np.isclose(one.y.values, one.y.paper))


def test_ratios_are_taken_to_the_numbers_of_the_presets() -> None:
    adaptive = load("paper-dead-adaptive").to_dict()
    assert tuple(motor["thrust_coefficient"] for motor in adaptive["motors"]) == FACTORS
    assert tuple(adaptive["control"]["allocation"]["rates"]) == PRESET_RATES
    at_presets = [
        (place, point) for one in SLICES for place, point in one.points() if place[-2:] == (one.y.paper, one.x.paper)
    ]
    points = {point for place, point in at_presets if place[2] in ARMS}
    for point in _observed(points):
        assert _values(load(point.preset, dict(point.changes))) == _values(load(point.preset))


def _values(scenario: Scenario) -> dict[str, Any]:
    """Everything but what is believed, which may say the truth again, and the marks."""
    data = scenario.to_dict()
    data["control"].pop("nominal")
    return {key: value for key, value in data.items() if key != "assumed"}


def _observed(points: set[Point]) -> list[Point]:
    """Those with the observer on: at the place of the paper they are the presets themselves."""
    return [point for point in points if dict(point.changes)["control.disturbance_observer.enabled"]]


def test_equal_runs_are_made_once() -> None:
    """Fault control knows no factors, and without it nothing adapts."""
    counts = {one.name: len({point for _, point in one.points()}) for one in SLICES}
    assert counts == {"map-time": 900, "map-factors": 2 * (225 + 2 * 15), "map-rates": 2 * (225 + 1 + 13 * 15)}


def test_fault_control_knows_no_factors() -> None:
    """Why one run serves a row of map-factors: another belief changes nothing, to the last bit."""
    base = load(preset("stuck", "with"), {**GRID, "duration": 15.0})
    believing = base.replace({BELIEVED: (4.8, 3.2)})
    assert simulate(base).metrics == simulate(believing).metrics


def samples() -> list[Point]:
    """The corners, the middle and the preset of each map that stay."""
    chosen = [
        one.setting(arm, x, y)
        for one in SLICES[:2]
        for arm in ARMS
        for x, y in ((one.x.values[2], one.y.values[12]), (one.x.paper, one.y.paper))
    ]
    return [make_point(name, observer, changes) for (name, changes), observer in product(chosen, OBSERVERS)]


def test_coarse_peaks_are_those_of_the_default_grid() -> None:
    points = samples()
    coarse, fine = (run_points(points, grid=grid) for grid in (GRID, DEFAULT))
    peaks = np.array([[found[point].peak for found in (coarse, fine)] for point in points])
    good = np.isfinite(peaks[:, 1])
    assert good.sum() > 10
    assert peaks[good, 0] == pytest.approx(peaks[good, 1], rel=0.01)
    assert (np.isnan(peaks[:, 0]) == np.isnan(peaks[:, 1])).all()


def test_the_comparison_of_grids_can_fail() -> None:
    """A gain that is 2 % off moves a peak by more than the grids may differ."""
    changes = [{}, {"control.law.damping_gain": 1.02e4}]
    peaks = [
        outcome.peak for outcome in run_points(make_point(preset("dead", "without"), "on", c) for c in changes).values()
    ]
    assert peaks[0] != pytest.approx(peaks[1], rel=0.01)


def test_edges_of_stability_are_no_matter_of_the_grid(evidence: Evidence) -> None:
    """All eight on 8, 16 and 64 elements; what is no edge is not taken for one."""
    assert len(evidence.edges) == 8
    assert all(edge.same for edge in evidence.edges.values())
    assert not same_on_grids(3.0, ("none", "without", "on"))


def test_a_dead_motor_moves_the_edge_by_what_it_no_longer_gives(evidence: Evidence) -> None:
    """Without it three fifths of the gain are left, so the edge lies at five thirds."""
    for arm, observer in product(ARMS, OBSERVERS):
        gains = [evidence.edges[case, arm, observer].gain for case in GAIN_CASES]
        assert gains[1] / gains[0] == pytest.approx(sum(FACTORS) / FACTORS[0], rel=0.03)


def test_a_dead_motor_that_runs_away_was_dead(evidence: Evidence) -> None:
    """The fault of the scan comes before anything diverges, else its crosses would be those of the healthy loop."""
    dead = evidence.gain.sel(case="dead")
    lost = np.isnan(dead["peak"])
    assert bool(lost.any())
    assert float(dead["end_time"].where(lost).min()) > EARLY["faults.1.start"]


def test_runaway_is_told_from_a_large_peak() -> None:
    found = run_points([gain_point("on", "none", "without", gain) for gain in (1.0, 8.0)])
    stays, lost = found.values()
    assert np.isfinite(stays.peak)
    assert stays.end == 50.0
    assert np.isnan(lost.peak)
    assert lost.end < 10.0


def made_up(with_scale: float):
    """A scan of the gain in which peaks fall as 1/gain, and a map of it in which one cell diverged."""
    import xarray

    gains = np.geomspace(0.25, 8.0, 21)
    peaks = np.ones((2, 2, 2, 21)) / gains
    peaks[:, :, 1] *= with_scale
    peaks[0, 0, 1, -1] = np.nan
    coordinates = {"observer": ["on", "off"], "case": ["none", "dead"], "arm": list(ARMS), "gain": gains}
    return xarray.Dataset({"peak": (tuple(coordinates), peaks)}, coordinates)


def test_diverged_cells_are_counted() -> None:
    assert diverged(made_up(1.0), "with") == (1, 84)
    assert diverged(made_up(1.0), "without") == (0, 84)


def test_where_one_arm_overtakes_the_other() -> None:
    """Peaks of 1.5/gain against 1/gain: 1 at a gain of 1.5; and 1.5/0.5 = 3 for factors believed 3 times too large."""
    found = {number.name: number.value for number in reversal(made_up(1.5)).numbers}
    assert found["start_gain"] == pytest.approx(1.5, rel=1e-3)
    assert found["belief_ratio"] == pytest.approx(3.0, rel=1e-3)
    assert found["same_start"] == pytest.approx(1.5, rel=1e-3)
