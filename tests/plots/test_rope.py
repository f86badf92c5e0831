"""Pictures of the rope."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from umbilical import Run, load, open_run, plots, simulate


@pytest.fixture(scope="module")
def run() -> Run:
    return simulate(load("observation-300m", {"duration": 1.0}))


@pytest.fixture(scope="module")
def snapped() -> Run:
    """A sheave that heaves by 2 m every 8 s above 1000 m of cable on four elements."""
    return simulate(load("work-class-3000m", {
        "duration": 60.0, "winch.length": 1000.0, "environment.sea": None, "rope.elements": 4, "control.period": 0.05,
        "environment.vessel_heave": [{"kind": "sine", "amplitude": 2.0, "frequency": 0.785}], "grid.step": 0.05,
        "environment.vessel_ramp": 10.0,
    }))  # fmt: skip


def test_the_shape_has_two_views_down_to_the_body(run: Run) -> None:
    figure = plots.plot_shape(run)
    assert [ax.get_xlabel() for ax in figure.axes] == ["$x$ [m]", "$y$ [m]"]
    for ax in figure.axes:
        assert min(np.min(np.asarray(line.get_ydata())) for line in ax.lines) == run["position"].values[:, 2].min()
    assert max(abs(limit) for limit in figure.axes[1].get_xlim()) > 1.0  # round-off is no shape


def test_the_tension_along_the_cable(run: Run) -> None:
    ax = plots.plot_tension(run)
    assert ax.get_xlabel().endswith("[N]")
    assert np.asarray(ax.lines[0].get_xdata())[0] == pytest.approx(run["top_tension"].values.mean())


@pytest.mark.parametrize("name", plots.ROPE_PLOTS)
def test_a_string_has_no_shape_in_space(name: str) -> None:
    string = simulate(load("crosscheck-none", {"duration": 0.1}))
    with pytest.raises(ValueError, match='model = "rope"'):
        plots.ROPE_PLOTS[name](string)


def test_snaps_are_marked_and_slack_is_shaded(snapped: Run) -> None:
    ax = plots.plot_tensions(snapped)
    texts = [text.get_text() for text in ax.figure.legends[0].get_texts()] if ax.figure.legends else []
    texts += [text.get_text() for text in legend.get_texts()] if (legend := ax.get_legend()) else []
    assert f"{snapped.snaps.shape[0]} snaps" in texts
    assert "slack somewhere" in texts
    assert "slack on up to" in plots.plot_tension(snapped).get_title(loc="left")


def test_the_snaps_of_a_run_are_those_it_counted_and_survive_its_file(snapped: Run, tmp_path: Path) -> None:
    assert snapped.snaps.shape == (snapped.metrics["snaps"], 2)
    assert snapped.snaps[:, 1].max() == snapped.metrics["largest_snap"]
    assert (np.diff(snapped.snaps[:, 0]) > 0.0).all()
    again = open_run(snapped.save(tmp_path / "snapped.nc"))
    np.testing.assert_array_equal(again.snaps, snapped.snaps)
    assert "largest snaps: " in again.summary()
    assert again.to_dict()["snaps"] == snapped.snaps.tolist()


def test_a_run_without_slack_has_no_snaps(run: Run) -> None:
    assert run.snaps.shape == (0, 2)
    assert "snaps" not in run.to_dict()


def test_the_body_stays_in_its_watch_circle(snapped: Run) -> None:
    ax = plots.plot_watch(snapped)
    body, circle = ax.lines[0], ax.lines[3]
    x, y = (np.asarray(part) for part in body.get_data())
    radius = np.ptp(np.asarray(circle.get_xdata())) / 2.0
    assert np.hypot(x - x[0], y - y[0]).max() <= radius * (1.0 + 1e-9)
