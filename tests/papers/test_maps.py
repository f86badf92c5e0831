"""Maps: large enough, no run made twice, and on a coarse grid that says what the default grid says."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest

from umbilical.engine.simulate import simulate
from umbilical.library import load
from umbilical.papers.rao2022.experiments import ARMS, BELIEVED, OBSERVER, OBSERVERS, preset
from umbilical.papers.rao2022.ledger import Evidence
from umbilical.papers.rao2022.maps import EARLY, FACTORS, GAIN_CASES, GRID, PRESET_RATES, SCANS
from umbilical.papers.rao2022.regions import diverged, reversal, runs_away, same_on_grids
from umbilical.run import Status
from umbilical.scenario import Scenario
from umbilical.studies.members import Draws
from umbilical.studies.study import Study

TWO_NUMBERS = [one for one in SCANS.values() if one.y]


def test_maps_are_fifteen_by_fifteen_and_show_the_preset() -> None:
    for one in TWO_NUMBERS:
        for axis in (one.x, one.y):
            assert axis
            assert len(axis.values) >= 15
            assert any(np.isclose(axis.values, axis.paper))


def test_ratios_are_taken_to_the_numbers_of_the_presets() -> None:
    """At the place of the presets a run with the observer on is the preset itself, on the grid of the maps."""
    adaptive = load("paper-dead-adaptive").to_dict()
    assert tuple(motor["thrust_coefficient"] for motor in adaptive["motors"]) == FACTORS
    assert tuple(adaptive["control"]["allocation"]["rates"]) == PRESET_RATES
    for one, arm in product(TWO_NUMBERS, ARMS):
        study = one.study(one.cases[0], arm)
        draws, here = Draws(study), {OBSERVER: True, **({one.y.key: one.y.paper} if one.y else {})}
        members = map(draws.member, range(1, len(draws) + 1))
        member = next(m for m in members if draws.values(m).items() <= here.items())
        found = draws.scenario(member, [a.name for a in study.arms].index(f"{one.x.paper:g}"))
        assert _values(found) == _values(load(preset(one.cases[0], arm), GRID))


def _values(scenario: Scenario) -> dict[str, Any]:
    """Everything but what is believed, which may say the truth again, and the marks."""
    data = scenario.to_dict()
    data["control"].pop("nominal")
    return {key: value for key, value in data.items() if key not in ("assumed", "name", "seed")}


def test_along_an_axis_that_means_nothing_there_is_one_run() -> None:
    """Fault control knows no factors, and without it nothing adapts."""
    runs = {(n, arm): runs_of(one.study(one.cases[0], arm)) for n, one in SCANS.items() for arm in one.arms}
    assert {place for place, count in runs.items() if count == 2 * 225} == {
        *product(["map-time"], ARMS),
        ("map-factors", "without"),
        *product(["map-rates"], ("with", "boxed")),
    }
    assert (runs["map-factors", "with"], runs["map-rates", "without"], runs["gain", "with"]) == (30, 2, 34)


def runs_of(study: Study) -> int:
    return len(Draws(study)) * len(study.arms)


def test_fault_control_knows_no_factors() -> None:
    """Why one run serves a row of map-factors: another belief changes nothing, to the last bit."""
    base = load(preset("stuck", "with"), {**GRID, "duration": 15.0})
    believing = base.replace({BELIEVED: (4.8, 3.2)})
    assert simulate(base).metrics == simulate(believing).metrics


def test_a_run_that_is_refused_is_no_divergence() -> None:
    one = SCANS["map-time"]
    assert one.y
    with pytest.raises(RuntimeError, match="map-time partial without: faults"):
        replace(one, x=replace(one.x, values=(10.0,)), y=replace(one.y, values=(1.5,))).run(lambda share: None)


@pytest.mark.parametrize("case", ["partial", "stuck"])
def test_coarse_peaks_are_those_of_the_default_grid(case: str) -> None:
    """At two places of a map, in both arms, with the observer and without."""
    for arm, observer, changes in product(ARMS, (True, False), PLACES[case]):
        coarse, fine = (peak(preset(case, arm), {OBSERVER: observer, **changes, **grid}) for grid in (GRID, {}))
        assert coarse == pytest.approx(fine, rel=0.01, nan_ok=True)


PLACES: dict[str, list[dict[str, Any]]] = {
    "partial": [{}, {"faults.1.start": 7.0, "faults.1.effectiveness": 12 / 14}],
    "stuck": [{}, {"faults.1.value": 500.0}],
}


def peak(name: str, changes: dict[str, Any]) -> float:
    """Of the ROV after the fault, m; not a number where the run diverges."""
    run = simulate(load(name, changes))
    return run.metrics["tip_peak_after_fault"] if run.status is Status.COMPLETED else float("nan")


def test_the_comparison_of_grids_can_fail() -> None:
    """A gain that is 2 % off moves a peak by more than the grids may differ."""
    peaks = [peak(preset("dead", "without"), {**GRID, "control.law.damping_gain": gain}) for gain in (1e4, 1.02e4)]
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
    assert [runs_away(("none", "without", "on"), gain) for gain in (1.0, 8.0)] == [False, True]


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
    found = reversal(made_up(1.5))
    assert found["start_gain"] == pytest.approx(1.5, rel=1e-3)
    assert found["belief_ratio"] == pytest.approx(3.0, rel=1e-3)
    assert found["same_start"] == pytest.approx(1.5, rel=1e-3)
