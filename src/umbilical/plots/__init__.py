"""Pictures of runs: each ``plot_*`` draws on an Axes, yours or a new one, and returns it.

Labels and units come from the data. matplotlib is imported when something is drawn, and pyplot never: nothing here
opens a window, changes a global setting, or keeps a figure alive.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper").replace({"duration": 1.0}))
    >>> umbilical.plot_tip(run).get_ylabel()
    '$x_1$ [m]'
"""

from umbilical.plots.cable import plot_cable, plot_positions
from umbilical.plots.certificate import plot_certificate
from umbilical.plots.channels import (
    plot_all_motors,
    plot_all_observers,
    plot_energy,
    plot_motors,
    plot_observers,
    plot_overview,
    plot_tip,
    plot_winch,
)  # fmt: skip
from umbilical.plots.convergence import plot_convergence
from umbilical.plots.design import plot_design
from umbilical.plots.figure import as_figure, save_figure
from umbilical.plots.margins import plot_margins
from umbilical.plots.operability import plot_lowering, plot_operability
from umbilical.plots.rope import plot_shape, plot_tension, plot_tensions, plot_watch
from umbilical.plots.snap import plot_snaps
from umbilical.plots.study import STUDY_PLOTS, plot_comparison, plot_distribution, plot_sensitivity, plot_study
from umbilical.plots.study_map import plot_map
from umbilical.plots.tuning import plot_tuning
from umbilical.plots.weather import plot_weather

PLOTS = {
    "overview": plot_overview,
    "tip": plot_tip,
    "positions": plot_positions,
    "cable": plot_cable,
    "winch": plot_winch,
    "motors": plot_all_motors,
    "observers": plot_all_observers,
    "energy": plot_energy,
}
"""Every picture by the name the command line gives it; each takes a run and returns an Axes or a Figure."""

ROPE_PLOTS = {"shape": plot_shape, "tension": plot_tension, "snaps": plot_tensions, "watch": plot_watch}
"""Likewise what only a run of the rope has."""

__all__ = [
    "PLOTS", "ROPE_PLOTS", "STUDY_PLOTS", "as_figure", "plot_all_motors", "plot_all_observers", "plot_cable",
    "plot_certificate", "plot_comparison", "plot_convergence", "plot_design", "plot_distribution", "plot_energy",
    "plot_lowering", "plot_map", "plot_margins", "plot_motors", "plot_observers", "plot_operability", "plot_overview",
    "plot_positions", "plot_sensitivity", "plot_shape", "plot_snaps", "plot_study", "plot_tension", "plot_tensions",
    "plot_tip", "plot_tuning", "plot_watch", "plot_weather", "plot_winch", "save_figure",
]  # fmt: skip
