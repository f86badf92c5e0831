"""Convergence plots: one panel for each case and kind of refinement, each with its stated slope."""

from __future__ import annotations

import numpy as np

from umbilical.analysis.convergence import Curve
from umbilical.plots import plot_convergence, save_figure

CURVES = [
    Curve("case one: y", "the element, m", (4.0, 2.0, 1.0), (1.6e-3, 1e-4, 6e-6), 4.0),
    Curve("case one: Dy/Dt", "the element, m", (4.0, 2.0, 1.0), (1.6e-2, 1e-3, 6e-5), 4.0),
    Curve("case one: y", "the step, s", (2e-3, 1e-3), (4e-6, 1e-6), 2.0),
    Curve("case two: y", "the step, s", (2e-3, 1e-3), (4e-6, 1e-6), 2.0),
]


def test_a_panel_for_each_case_and_kind_of_refinement() -> None:
    panels = plot_convergence(CURVES).axes
    assert [ax.get_title(loc="left") for ax in panels] == ["case one", "case one", "case two"]
    assert [ax.get_xlabel() for ax in panels] == ["element [m]", "step [s]", "step [s]"]
    assert panels[0].get_legend_handles_labels()[1] == ["y: 4", "Dy/Dt: 4"]


def test_the_slope_is_the_stated_one() -> None:
    coarse, fine = np.asarray(plot_convergence(CURVES[2:3]).axes[0].lines[1].get_ydata())
    assert coarse / fine == 4.0


def test_no_curves_are_an_empty_picture(tmp_path) -> None:
    assert save_figure(plot_convergence([]), tmp_path / "none.svg").exists()
