"""Pictures of the rope."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical import Run, load, plots, simulate


@pytest.fixture(scope="module")
def run() -> Run:
    return simulate(load("observation-300m", {"duration": 1.0}))


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
