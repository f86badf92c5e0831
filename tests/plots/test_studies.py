"""Pictures of studies: what is in a cell, on a scale, in a legend."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.studies import small_study
from umbilical import plots
from umbilical.plots.study_map import numbers_drawn
from umbilical.studies.results import StudyResult
from umbilical.studies.rows import STATUSES
from umbilical.studies.sweep import sweep

GRID = {"kind": "grid", "low": 0.9, "high": 1.1, "count": 2}


@pytest.fixture
def mapped() -> StudyResult:
    """Two numbers and two motors, all combined, in two arms."""
    grid = {"key": "payload.mass", "relative": True, "distribution": GRID}
    start = {"kind": "grid", "low": 0.05, "high": 0.15, "count": 2}
    return sweep(
        small_study(
            design="grid",
            factors=[grid],
            campaigns=[{"name": "fault", "kinds": ["dead"], "motors": [1, 2], "start": start}],
        )
    )


def cells(ax: Any) -> np.ndarray:
    """Values of a map's cells, upwards then to the right."""
    return np.ma.filled(ax.collections[0].get_array(), np.nan)


def test_a_map_shows_means_and_what_was_lost(mapped):
    mapped.data["status"][:1] = STATUSES.index("DIVERGED")
    values = mapped.values("tip_peak", "proposed")
    ax = plots.plot_map(mapped, arm="proposed")
    masses, starts = (np.unique(mapped[name].values) for name in ("payload.mass", "fault.start"))
    chosen = (mapped["payload.mass"].values == masses[0]) & (mapped["fault.start"].values == starts[0])
    assert cells(ax)[0, 0] == pytest.approx(values[chosen & np.isfinite(values)].mean())
    assert [text.get_text() for text in ax.texts] == ["50 %\nlost"]
    assert ax.collections[0].get_clim()[1] == pytest.approx(np.nanmax(cells(ax)))
    assert ax.figure.axes[1].get_ylabel().startswith("mean of")


def test_a_part_of_the_study_is_another_map_and_of_one_member_no_mean(mapped):
    one, other = (plots.plot_map(mapped, "tip_end", arm="PD", where={"fault.motor": k}) for k in (1, 2))
    assert not np.array_equal(cells(one), cells(other))
    assert not one.figure.axes[1].get_ylabel().startswith("mean of")


def test_a_ratio_is_of_the_same_draws(mapped):
    ax = plots.plot_map(mapped, arm="proposed", over="proposed")
    assert (cells(ax) == 1.0).all()
    ratio = plots.plot_map(mapped, arm="proposed", over="PD", where={"fault.motor": 1})
    low, high = ratio.collections[0].get_clim()
    assert low * high == pytest.approx(1.0)


def test_the_overview_has_a_row_for_each_motor_and_a_ratio(mapped):
    titles = [ax.get_title(loc="left") for ax in plots.plot_study(mapped).axes if ax.get_title(loc="left")]
    assert len(titles) == 6
    assert sum("fault.motor = 2" in title for title in titles) == 3
    assert sum("over PD" in title for title in titles) == 2


def test_names_are_axes_when_asked_for_and_not_otherwise(mapped):
    assert numbers_drawn(mapped) == ["payload.mass", "fault.start"]
    ax = plots.plot_map(mapped, x="fault.motor", y="fault.kind")
    assert [label.get_text() for label in ax.get_xticklabels()] == ["1", "2"]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["dead"]


def test_a_legend_tells_how_sure_a_median_is_and_who_is_worst():
    result = sweep(small_study())
    words = str(plots.plot_distribution(result).get_legend_handles_labels()[1][0])
    assert words.startswith("PD\n  median ")
    assert " to " in words
    assert "worst #" in words


def test_a_ratio_to_a_run_that_diverged_is_below_all_others():
    result = sweep(small_study())
    result.data["status"][:3, 0] = STATUSES.index("DIVERGED")
    line = plots.plot_comparison(result).lines[0]
    assert np.asarray(line.get_ydata())[0] == pytest.approx(4 / 12)


def test_influences_are_shown_of_every_arm_or_of_one(mapped):
    assert len(plots.plot_sensitivity(mapped, "tip_end").containers) == 2
    assert len(plots.plot_sensitivity(mapped, "tip_end", "PD").containers) == 1
