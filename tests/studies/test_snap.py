"""`snap`: slack and snaps over seeds of the sea."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import gumbel_r

from umbilical import load
from umbilical.errors import ScenarioError
from umbilical.studies import snap as module
from umbilical.studies.snap import snap

ROUGH = {
    "duration": 60.0, "winch.length": 1000.0, "environment.sea.systems.1.significant_height": 7.0,
    "environment.sea.systems.1.peak_period": 9.0, "environment.vessel_ramp": 10.0, "rope.elements": 4,
    "environment.sea.systems.1.components": 20, "control.period": 0.05, "grid.step": 0.05,
}  # fmt: skip


def test_a_rough_sea_snaps_and_threads_change_nothing() -> None:
    scenario = load("work-class-3000m", ROUGH)
    one, two = snap(scenario, 6), snap(scenario, 6, workers=2)
    assert one.completed.all()
    assert one.snaps.sum() > 0
    assert one.largest_snap.max() > one.static_tension
    assert one.slack.low < one.slack.value <= one.slack.high
    assert one.rule_of_thumb > one.static_tension
    np.testing.assert_array_equal(one.largest_tension, two.largest_tension)
    assert len(set(one.largest_tension.tolist())) == 6


def test_a_calm_sea_does_not() -> None:
    calm = snap(load("work-class-3000m", ROUGH | {"environment.sea.systems.1.significant_height": 0.2}), 2)
    assert calm.snaps.sum() == 0
    assert calm.extreme is None
    assert "no snap" in calm.summary()


def test_the_fit_finds_the_distribution_it_was_drawn_from() -> None:
    """Of 20 samples of 40 maxima the 95 % interval covers the true level in 16 or more."""
    exact = gumbel_r.ppf(0.99, 1e5, 5e3)
    samples = np.asarray(gumbel_r.rvs(1e5, 5e3, size=(20, 40), random_state=3))
    fits = [module._extreme(sample, 0) for sample in samples]
    covered = sum(fit is not None and fit.exceeded.low <= exact <= fit.exceeded.high for fit in fits)
    assert covered >= 16


@pytest.mark.parametrize(
    ("changes", "key"), [({"model": "string"}, "model"), ({"environment.sea": None}, "environment.sea")]
)
def test_what_says_nothing_is_refused(changes: dict[str, object], key: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        snap(load("work-class-3000m", ROUGH).replace(changes), 2)
    assert caught.value.problems[0].key == key


def test_runs_that_do_not_complete_say_why() -> None:
    """A Gumbel distribution, a share and a picture need runs; without them the verdict is that there is none."""
    from dataclasses import replace

    found = snap(load("work-class-3000m", ROUGH), 2)
    none = replace(found, completed=np.zeros(2, dtype=bool), reasons=("at t = 3 s it parted",))
    assert "UNRESOLVED" in none.summary().splitlines()[0]
    assert "it parted" in none.summary()
    assert none.to_dict()["exit_code"] == 7
    with pytest.raises(ValueError, match="no run completed"):
        none.plot()
    assert found.plot().get_xlabel() == "largest tension of a run [kN]"
